"""docs/topics.md against the stages themselves."""
import re

from conftest import ROOT
from ros_session import RosSession

STAGES = ["deskew_scan", "deskew_cloud", "depth_scan", "scan_merge", "filter", "ground", "cluster", "detect", "match", "markers",
          "costmap", "grid_slam", "voxel_map", "map_fusion"]
OWN = re.compile(r"parameter_(descriptions|updates)$|^/(rosout|diagnostics|tf|tf_static)$")


def documented():
    rows = set()
    for line in (ROOT / "docs/topics.md").read_text().splitlines():
        cells = [c.strip() for c in line.strip("|").split("|")]
        if len(cells) == 4 and cells[1] in ("in", "out"):
            rows.add(tuple(cells))
    return rows


def running(session):
    """(stage, direction, topic, type) of all stages, each in a namespace of its own."""
    publishers, subscribers, _ = session.system_state()
    types = session.topic_types()
    rows = set()
    for direction, topics in (("out", publishers), ("in", subscribers)):
        for topic, nodes in topics:
            for node in nodes:
                stage = node.split("/")[1]
                if stage in STAGES and not OWN.search(topic):
                    rows.add((stage, direction, topic[len(stage) + 2:], types[topic]))
    return rows


def test_every_stage_has_the_topics_that_the_docs_list(tmp_path):
    groups = "".join(
        f'<group ns="{stage}"><include file="$(find field_fusion)/launch/{stage}.launch">'
        + (f'<arg name="model" value="{ROOT}/test/fixtures/stock_head.onnx"/>' if stage == "detect" else "")
        + "</include></group>" for stage in STAGES)
    launch = tmp_path / "all.launch"
    launch.write_text(f"<launch>{groups}</launch>")
    with RosSession() as session:
        session.launch(str(launch))
        # stages subscribe while somebody listens
        outputs = [f"/{stage}/{topic}" for stage, direction, topic, _ in documented() if direction == "out"]
        session.listen(outputs)
        wanted = documented()
        optional = {row for row in wanted if row[3].startswith(("vision_msgs/", "octomap_msgs/"))}  # as the package was built
        assert session.wait(lambda: wanted - optional <= running(session) <= wanted), (
            f"documented but absent: {sorted(wanted - running(session))}; "
            f"there but not documented: {sorted(running(session) - wanted)}")
