"""carmen_to_bag and score_relations: what stands in the bag, what the errors are, and what is said of damaged logs."""
import math
import re

import pytest
import rosbag

from conftest import rosrun

POSE = "1.0 2.0 0.5"


def flaser(stamp, laser=POSE, odometry=POSE, ranges="1.0 2.0 3.0"):
    return f"FLASER {len(ranges.split())} {ranges} {laser} {odometry} {stamp} host {stamp}"


LOG = f"# a log\nODOM 0.5 2.0 0.5 0 0 0 99.5 host 99.5\n{flaser(100.25)}\nPARAM nothing 1\n{flaser(101.25)}\n"


def convert(tmp_path, text, *more):
    (tmp_path / "a.log").write_text(text)
    return rosrun("carmen_to_bag", tmp_path / "a.log", tmp_path / "a.bag", *more)


def test_a_log_becomes_scans_odometry_and_transforms(tmp_path):
    done = convert(tmp_path, LOG, "--laser", 0.1, 0, 90)
    assert done.returncode == 0 and "2 scans of 3 beams" in done.stdout, done.stderr
    with rosbag.Bag(str(tmp_path / "a.bag")) as bag:
        messages = [(topic, m, t.to_sec()) for topic, m, t in bag.read_messages()]
    scans = [m for topic, m, _ in messages if topic == "/scan"]
    assert [m.header.stamp.to_sec() for m in scans] == [100.25, 101.25]
    assert list(scans[0].ranges) == [1.0, 2.0, 3.0] and scans[0].header.frame_id == "laser"
    assert scans[0].angle_min == pytest.approx(-math.pi / 2) and scans[0].angle_increment == pytest.approx(math.pi / 2)
    assert scans[0].range_max == 80.0
    odometry = [(t, m.pose.pose.position.x) for topic, m, t in messages if topic == "/odom"]
    assert odometry == [(99.5, 0.5), (100.25, 1.0), (101.25, 1.0)]
    laser = next(m for topic, m, _ in messages if topic == "/tf_static").transforms[0]
    assert (laser.header.frame_id, laser.child_frame_id, laser.transform.translation.x) == ("base", "laser", 0.1)
    assert laser.transform.rotation.z == pytest.approx(math.sqrt(0.5))
    moving = [m.transforms[0] for topic, m, _ in messages if topic == "/tf"]
    assert {(t.header.frame_id, t.child_frame_id) for t in moving} == {("odom", "base")}
    assert moving[1].transform.rotation.z == pytest.approx(math.sin(0.25))


def test_stamps_that_fall_are_told(tmp_path):
    done = convert(tmp_path, flaser(101.0) + "\n" + flaser(100.0) + "\n")
    assert done.returncode == 0 and "1 scans are not stamped after the one before" in done.stdout


BAD = {  # what the log is: what is said
    "ODOM 0 0 0 0 0 0 1 h 1\n": "no scan",
    "FLASER 3 1 2\n": "a.log:1: the line ends before",
    flaser(1.0, ranges="1 x 2"): "a.log:1: a range is 'x'",
    flaser(0.0): "--start SECONDS",
    flaser(1.0) + "\n" + flaser(2.0, laser="5 5 0"): "--laser X Y YAW",
    flaser(1.0, ranges="1.0"): "angle_increment is 0.0",
}


@pytest.mark.parametrize("text", BAD)
def test_a_damaged_log_is_named_and_leaves_no_bag(tmp_path, text):
    done = convert(tmp_path, text)
    assert done.returncode != 0 and BAD[text] in done.stderr, done.stdout + done.stderr
    assert [f.name for f in tmp_path.iterdir()] == ["a.log"]


def score(tmp_path, poses, relations, *more):
    (tmp_path / "poses").write_text(poses)
    (tmp_path / "relations").write_text(relations)
    return rosrun("score_relations", tmp_path / "poses", tmp_path / "relations", *more)


# Two metres ahead and a turn to the left; the truth is 1.9 m and 86 degrees, then 2 m without a turn.
POSES = f"10.0 0 0 0\n11.0 2 0 {math.pi / 2}\n12.0 2 2 {math.pi / 2}\n"
RELATIONS = f"10.0 11.0 1.9 0 0 0 0 {math.radians(86)}\n11.0 12.0 2 0 0 0 0 0\n11.0 99.0 1 0 0 0 0 0\n"


def numbers(done, what):
    return [float(v) for v in re.search(rf"^{what} +([0-9.]+) \+- +([0-9.]+)", done.stdout, re.M).groups()]


def test_errors_are_those_of_the_paper(tmp_path):
    done = score(tmp_path, POSES, RELATIONS)
    assert done.returncode == 0, done.stderr
    assert "2 relations, 1 without a pose" in done.stdout
    assert numbers(done, "translation") == pytest.approx([0.05, 0.05], abs=1e-6)
    assert numbers(done, "translation, squared") == pytest.approx([0.005, 0.005], abs=1e-6)
    assert numbers(done, "rotation") == pytest.approx([2.0, 2.0], abs=1e-5)
    assert numbers(done, "rotation, squared") == pytest.approx([8.0, 8.0], abs=1e-4)


def test_a_corrected_log_is_scored_by_its_scanners_poses(tmp_path):
    log = flaser(10.0, laser="0 0 0") + "\n" + flaser(11.0, laser="1.5 0 0") + "\n"
    done = score(tmp_path, log, "10.0 11.0 1.0 0 0 0 0 0\n", "--csv", tmp_path / "out.csv")
    assert done.returncode == 0 and numbers(done, "translation") == pytest.approx([0.5, 0.0])
    assert (tmp_path / "out.csv").read_text().splitlines()[1].startswith("0.5,0")


@pytest.mark.parametrize("poses, relations, said", [
    ("", "", "is empty"), ("10 0 0\n", RELATIONS, "poses:1"), (POSES, "1 2 3\n", "relations:1"),
    (POSES, "1.0 2.0 1 0 0 0 0 0\n", "no relation of")])
def test_what_cannot_be_scored_is_named(tmp_path, poses, relations, said):
    done = score(tmp_path, poses, relations)
    assert done.returncode != 0 and said in done.stderr, done.stdout + done.stderr
