"""calibrate_camera_imu: the place and clock of a simulated inertial unit found from a bag, and what is said of bags that tell nothing."""
import collections
import math
import re
import sys

import numpy
import pytest
import rosbag
import rospy
import yaml

from conftest import ROOT, rosrun

sys.path.insert(0, str(ROOT / "scripts/support"))
import calibration_motion  # noqa: E402
import calibration_world  # noqa: E402

SECONDS = 6  # of a recording; with fewer than 5 it is too short
FEW, HALF = ("--every", "8"), ("--every", "2")  # pictures, where no more are needed to see what is wrong


def recorded(folder, name, change=lambda world: None, seconds=SECONDS):
    world = calibration_motion.world(name, 3)
    change(world)
    (folder / "worlds").mkdir(exist_ok=True)
    if not (folder / "sensors").exists():
        (folder / "sensors").symlink_to(ROOT / "config/sensors")
    file = folder / f"worlds/{name}.yaml"
    file.write_text(yaml.safe_dump(world))
    done = rosrun("make_bag", file, folder / f"{name}.bag", "--seconds", seconds, *calibration_motion.MOUNTS)
    assert done.returncode == 0, done.stderr
    return folder / f"{name}.bag"


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    return recorded(tmp_path_factory.mktemp("camera_imu"), "hands")


def calibrate(bag, *more):
    return rosrun("calibrate_camera_imu", bag, "--board", calibration_world.BOARD, *more)


def changed(bag, file, change):
    """The bag with `change(topic, number, message)` of each message; without those of which it is None."""
    numbers = collections.Counter()
    with rosbag.Bag(str(bag)) as whole, rosbag.Bag(str(file), "w") as out:
        for topic, message, stamp in whole.read_messages(topics=["/camera/image_raw", "/camera/camera_info", "/imu/data"]):
            message = change(topic, numbers[topic], message)
            numbers[topic] += 1
            if message:
                out.write(topic, message, stamp)
    return file


def test_place_and_clock_are_found_within_what_is_stated(bag, tmp_path):
    done = calibrate(bag, "--out", tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    result = yaml.safe_load((tmp_path / "calibration.yaml").read_text())
    assert (result["camera_frame"], result["imu_frame"]) == ("camera_optical", "imu")
    off = calibration_motion.error(result, bag)
    deviations = numpy.sqrt(numpy.diag(numpy.array(result["covariance"])))
    assert numpy.all(numpy.abs(off) < 5 * deviations), (off, deviations)
    assert numpy.linalg.norm(result["gravity"]) == pytest.approx(9.80665) and abs(result["gravity"][1]) > 9.7  # along the board's columns
    found = numpy.array(result["T_camera_imu"])
    numbers = re.search(r'args="([^"]+) imu camera_optical"', (tmp_path / "static_transform.launch").read_text())[1].split()
    assert numpy.allclose([float(n) for n in numbers[:3]], numpy.linalg.inv(found)[:3, 3], atol=1e-6)


def test_a_clock_that_is_set_back_is_found(bag, tmp_path):
    def late(topic, number, message):
        if topic == "/imu/data":
            message.header.stamp -= rospy.Duration.from_sec(0.15)
        return message

    assert calibrate(bag, "--out", tmp_path / "as_is", *HALF).returncode == 0
    assert calibrate(changed(bag, tmp_path / "late.bag", late), "--out", tmp_path / "late", *HALF).returncode == 0
    offsets = [yaml.safe_load((tmp_path / name / "calibration.yaml").read_text())["time_offset"] for name in ("as_is", "late")]
    assert offsets[1] - offsets[0] == pytest.approx(-0.15, abs=1e-4)


def broken(topic, number, message):
    if topic == "/imu/data" and number == 500:
        message.angular_velocity.x = math.nan
    return message


def gap(topic, number, message):
    return None if topic == "/imu/data" and 500 < number < 600 else message


def in_degrees(topic, number, message):
    if topic == "/imu/data":
        w = message.angular_velocity
        w.x, w.y, w.z = map(math.degrees, (w.x, w.y, w.z))
    return message


def short(topic, number, message):
    return None if topic == "/camera/image_raw" and number > 30 else message


@pytest.mark.parametrize("change, words, more", [
    (broken, "a reading of the inertial unit is not finite", FEW), (gap, "in the readings of the inertial unit", FEW),
    (short, "too short", FEW), (in_degrees, "do not fit", HALF),
    (lambda topic, number, m: m if topic != "/imu/data" else None, "--imu is needed; there is none", FEW),
])
def test_a_bad_recording_is_refused_with_the_reason(bag, tmp_path, change, words, more):
    done = calibrate(changed(bag, tmp_path / "bad.bag", change), "--out", tmp_path / "out", *more)
    assert done.returncode == 1 and words in done.stderr, done.stdout + done.stderr
    assert not (tmp_path / "out").exists()


def test_another_board_is_in_no_picture(bag, tmp_path):
    done = rosrun("calibrate_camera_imu", bag, "--board", "9x7x0.1", "--out", tmp_path / "out", *FEW)
    assert done.returncode == 1 and "no picture shows the whole board 9x7x0.1" in done.stderr


def test_a_board_that_is_never_whole_is_in_no_picture(tmp_path):
    def half(world):
        world["bodies"][-1]["pose"][1] = 2.2  # of its 1 m half lies out of view
        world["robot"]["motion"]["shake"] = [{"frequency": 1.0, "roll_deg": 2}]

    done = calibrate(recorded(tmp_path, "half", half, seconds=2), "--out", tmp_path / "out", *FEW)
    assert done.returncode == 1 and "no picture shows the whole board" in done.stderr


def test_turning_about_one_axis_is_refused(tmp_path):
    def nodding(world):
        world["robot"]["motion"]["shake"] = [{"frequency": 0.7, "pitch_deg": 12, "x": 0.1, "y": 0.1}]

    done = calibrate(recorded(tmp_path, "nodding", nodding), "--out", tmp_path / "out", *HALF)
    assert done.returncode == 1 and "turns about one axis alone" in done.stderr
