"""Names that usv.launch is given reach every stage that they are for."""
import pytest
import roslaunch.config

from conftest import ROOT


def remaps(*arguments):
    """{node: {from: to}} of usv.launch with these arguments."""
    file = str(ROOT / "launch/usv.launch")
    loaded = roslaunch.config.load_config_default([(file, ["rviz:=false", *arguments])], None, verbose=False)
    return {node.name: dict(node.remap_args) for node in loaded.nodes}


@pytest.mark.parametrize("name, stages", [
    ("detections", ("detect", "match")), ("image", ("detect",)), ("camera_info", ("detect",)), ("ground_plane", ("detect",)),
    ("points", ("filter",)),
])
def test_a_name_reaches_all_stages_that_use_it(name, stages):
    found = remaps("model:=detector.onnx", f"{name}:=/somewhere/else")
    assert {stage: found[stage].get(name) for stage in stages} == dict.fromkeys(stages, "/somewhere/else")


def test_without_a_model_there_is_no_detector():
    assert "detect" not in remaps() and "detect" in remaps("model:=detector.onnx")
