"""world_urdf: the robot of a world as URDF has its sensors where the world's file and /tf_static say."""
import math
import subprocess
import xml.etree.ElementTree as xml

import numpy
import pytest
import rosbag
import yaml

from conftest import ROOT, rosrun
from ros_session import RosSession

WORLDS = sorted(file.stem for file in (ROOT / "config/worlds").glob("*.yaml"))


def numbers(text):
    return [float(word) for word in text.split()]


def matrix(xyz, rpy):
    """As URDF says: turned about the fixed axes x, y and z in turn, then moved."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a), math.cos(a)) for a in rpy)
    turn = numpy.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]]) @ numpy.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]]) \
        @ numpy.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    out = numpy.eye(4)
    out[:3, :3], out[:3, 3] = turn, xyz
    return out


def of_message(transform):
    q, t = transform.rotation, transform.translation
    x, y, z, w = q.x, q.y, q.z, q.w
    out = numpy.eye(4)
    out[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                   [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                   [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    out[:3, 3] = t.x, t.y, t.z
    return out


def urdf(world):
    done = rosrun("world_urdf", world)
    assert done.returncode == 0, done.stderr
    return done.stdout


def joints(text):
    """{(parent, child): where}"""
    found = {}
    for joint in xml.fromstring(text).iter("joint"):
        assert joint.get("type") == "fixed"
        origin = joint.find("origin")
        found[joint.find("parent").get("link"), joint.find("child").get("link")] = matrix(
            numbers(origin.get("xyz")), numbers(origin.get("rpy")))
    return found


def static_transforms(bag_file):
    """{(parent, child): where} of the one message on /tf_static."""
    with rosbag.Bag(str(bag_file)) as bag:
        (message,) = (m for _, m, _ in bag.read_messages(topics="/tf_static"))
    return {(t.header.frame_id, t.child_frame_id): of_message(t.transform) for t in message.transforms}


def same(a, b):
    assert set(a) == set(b)
    for name in a:
        assert numpy.allclose(a[name], b[name], atol=1e-9), name


@pytest.mark.parametrize("world", WORLDS)
def test_joints_are_the_mounts_of_the_file(world):
    robot = yaml.safe_load((ROOT / "config/worlds" / f"{world}.yaml").read_text())["robot"]
    told = joints(urdf(world))
    for mount in robot["mounts"]:
        kind = yaml.safe_load((ROOT / "config/sensors" / f"{mount['model']}.yaml").read_text())["kind"]
        if "odometry" in kind:
            continue
        pose = [*mount.get("pose", [0, 0, 0]), 0, 0, 0][:6]
        assert numpy.allclose(told.pop(("base", mount["name"])), matrix(pose[:3], numpy.radians(pose[3:])), atol=1e-9)
        if "camera" in kind:
            optical = told.pop((mount["name"], mount["name"] + "_optical"))
            assert numpy.allclose(optical[:3, :3], [[0, 0, 1], [-1, 0, 0], [0, -1, 0]], atol=1e-9)  # REP 103
    assert told == {}


@pytest.mark.parametrize("world", ["usv_harbour", "quad_lab"])
def test_joints_are_those_of_tf_static(world, tmp_path):
    assert rosrun("make_bag", world, tmp_path / "a.bag", "--seconds", "0.05").returncode == 0
    same(joints(urdf(world)), static_transforms(tmp_path / "a.bag"))


@pytest.mark.parametrize("world", WORLDS)
def test_others_can_read_it(world, tmp_path):
    (tmp_path / "robot.urdf").write_text(urdf(world))
    done = subprocess.run(["check_urdf", tmp_path / "robot.urdf"], capture_output=True, text=True)
    assert done.returncode == 0 and "root Link: base" in done.stdout, done.stdout + done.stderr


def test_a_world_that_is_not_there_is_named():
    done = rosrun("world_urdf", "nowhere")
    assert done.returncode != 0 and "no world nowhere" in done.stderr and done.stdout == ""


@pytest.mark.parametrize("publisher", ["robot_state_publisher", "sim"])
def test_live_tf_static_is_the_urdf(publisher, tmp_path):
    with RosSession(tmp_path) as session:
        stages = session.launch("field_fusion", "sim.launch", "world:=quad_lab", "rviz:=false",
                                f"robot_state_publisher:={str(publisher != 'sim').lower()}")
        recorder = session.start("rosbag", "record", "--limit=1", "-O", str(tmp_path / "a.bag"), "/tf_static")
        session.require(lambda: recorder.poll() is not None, 120, "no /tf_static", stages)
        (speaker,) = dict(session.system_state()[0])["/tf_static"]
        described = session.master.getParam("/test", "/robot_description")[2]
    same(joints(urdf("quad_lab")), static_transforms(tmp_path / "a.bag"))
    assert described == urdf("quad_lab")
    assert ("robot_state_publisher" in speaker) == (publisher == "robot_state_publisher")
