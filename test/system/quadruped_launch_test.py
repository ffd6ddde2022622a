"""quadruped.launch goes on, and says what is wrong, when the camera falls silent and when the robot is carried."""
import pytest
import rosbag

import poses
import sim_world
from conftest import ROOT, rosrun
from quad_stages import IMAGE, INFO, ODOM, SCAN
from ros_session import RosSession

SILENT = (3.0, 13.0)  # s since the begin, in which no depth comes
LIFTED, PUT_DOWN = 17.0, 23.0  # s: what comes between is left out, and the legs tell nothing of it
SECONDS, BEGIN = 28.0, 1000.0  # s; what the simulator begins with
PLAYED = SECONDS - (PUT_DOWN - LIFTED)
OK, WARN = 0, 1


def walk(folder):
    """A bag of the eight obstacles with few depth images."""
    world = sim_world.with_mounts(sim_world.shipped("quad_obstacles"), {"depth": {"rate": 5.0}})
    file, bag = sim_world.write(world, folder), folder / "walk.bag"
    done = rosrun("make_bag", file, bag, "--seconds", SECONDS, "--mounts", "scan", "depth", "odom", "--no-truth")
    assert done.returncode == 0, done.stderr
    return bag


def with_mishaps(walked, bag):
    """Writes the same walk with both."""
    with rosbag.Bag(str(walked)) as source:
        messages = list(source.read_messages())
    since = lambda time: time.to_sec() - BEGIN
    known = {message.header.stamp: poses.vector(message.pose.pose.position) for topic, message, _ in messages if topic == ODOM}
    stood = max(stamp for stamp in known if since(stamp) <= LIFTED)
    stands = min(stamp for stamp in known if since(stamp) >= PUT_DOWN)
    way = known[stands] - known[stood]
    with rosbag.Bag(str(bag), "w") as out:
        for topic, message, time in messages:
            silent = topic in (IMAGE, INFO) and SILENT[0] < since(time) < SILENT[1]
            if silent or LIFTED < since(time) < PUT_DOWN + 0.2:  # until no scan began before
                continue
            if since(time) >= PUT_DOWN:
                put_back(topic, message, way, stands - stood)
                time -= stands - stood
            out.write(topic, message, time)


def put_back(topic, message, way, earlier):
    """As the legs tell it, which did not walk this way."""
    moved = [(transform.header, transform.transform.translation) for transform in message.transforms] if topic == "/tf" else [
        (message.header, message.pose.pose.position if topic == ODOM else None)]
    for header, position in moved:
        header.stamp -= earlier
        if position:
            position.x, position.y, position.z = poses.vector(position) - way


@pytest.fixture(scope="module")
def heard(tmp_path_factory):
    """[(s since the begin that it is stamped with, topic, message)] of what the stages tell while the walk with its mishaps is played."""
    folder = tmp_path_factory.mktemp("quadruped")
    bag, kept = folder / "mishaps.bag", folder / "heard.bag"
    with_mishaps(walk(folder), bag)
    with RosSession(folder) as session:
        session.start("rosparam", "set", "/use_sim_time", "true").wait(20)
        recorder = session.start("rosbag", "record", "-O", str(kept), "/diagnostics", "/fused_map", "/projected_map")
        launch = session.launch(ROOT / "launch/quadruped.launch", "rviz:=false", f"scan:={SCAN}", f"odom:={ODOM}",
                                f"image:={IMAGE}", f"camera_info:={INFO}", f"bag:={bag}", "bag_args:=--delay 6")
        launch.wait(120)  # it ends with the recording
        session.end(recorder)
    with rosbag.Bag(str(kept)) as of:
        return [(message.header.stamp.to_sec() - BEGIN, topic, message) for topic, message, _ in of.read_messages()]


def states(heard, stage, begin, end):
    """[(level, words)] of what a stage told in a span of s."""
    return [(status.level, status.message) for at, topic, message in heard if topic == "/diagnostics" and begin < at < end
            for status in message.status if status.name == f"{stage}: stage"]


def stamps(heard, topic, begin, end):
    """s since the begin of maps from a span of s."""
    return [at for at, name, _ in heard if name == topic and begin < at < end]


def test_a_silent_camera_is_told_and_the_map_goes_on_without_it(heard):
    silent = SILENT[0] + 2.5, SILENT[1]  # what was missing before is told for a while
    for stage, topic in (("voxel_map", "image"), ("map_fusion", "projected_map")):
        told = states(heard, stage, *silent)
        assert len(told) > 5 and all(level == WARN and f"nothing new on {topic}" in words for level, words in told)
    assert not stamps(heard, "/projected_map", *silent) and len(stamps(heard, "/fused_map", *silent)) > 3
    assert {level for level, _ in states(heard, "grid_slam", SILENT[1] - 5.0, SILENT[1])} == {OK}


def test_when_the_camera_is_back_all_is_well(heard):
    for stage in ("voxel_map", "map_fusion", "grid_slam"):
        assert (OK, "running") in states(heard, stage, SILENT[1] + 0.5, LIFTED)
    assert stamps(heard, "/projected_map", SILENT[1], LIFTED) and stamps(heard, "/fused_map", SILENT[1], LIFTED)


def test_a_robot_that_was_carried_is_told_and_its_stages_go_on(heard):
    end = PLAYED
    assert any(level == WARN and "has the robot been carried?" in words for level, words in states(heard, "grid_slam", LIFTED, end))
    for topic in ("/projected_map", "/fused_map"):
        assert stamps(heard, topic, end - 2.0, end + 0.5)
    for stage in ("deskew_scan", "voxel_map", "map_fusion"):
        assert (OK, "running") in states(heard, stage, end - 4.0, end + 0.5)
