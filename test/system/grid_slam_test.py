"""reproduce grid-slam in short: a room whose walls are known as a CARMEN log, and the first seconds of the office."""
import math
import re

import pytest

from conftest import rosrun


def wall(x, y, angle):
    """[m] from inside the room [-4, 5] x [-3, 2]."""
    dx, dy = math.cos(angle), math.sin(angle)
    return min((((5.0 if dx > 0 else -4.0) - x) / dx) if dx else math.inf, (((2.0 if dy > 0 else -3.0) - y) / dy) if dy else math.inf)


def step(pose, ahead, turn):
    x, y, yaw = pose
    return x + ahead * math.cos(yaw), y + ahead * math.sin(yaw), yaw + turn


@pytest.fixture
def room(tmp_path):
    """A walk round the room; odometry walks 4 % too far and turns 3 % too little. Relations are the truth."""
    truth = odometry = (0.0, -1.0, 0.0)
    lines, poses = [], []
    for k in range(60):
        ranges = " ".join(f"{wall(*truth[:2], truth[2] + math.radians(i - 90)):.4f}" for i in range(180))
        place = "{} {} {}".format(*odometry)
        lines.append(f"FLASER 180 {ranges} {place} {place} {100 + k}.5 room {100 + k}.5")
        poses.append(truth)
        truth, odometry = step(truth, 0.2, 0.14), step(odometry, 0.208, 0.1358)
    (tmp_path / "room.log").write_text("\n".join(lines) + "\n")
    rows = []
    for a in range(0, 55, 5):
        (x, y, yaw), (u, v, heading) = poses[a], poses[a + 5]
        c, s = math.cos(yaw), math.sin(yaw)
        rows.append(f"{100 + a}.5 {105 + a}.5 {c * (u - x) + s * (v - y)} {-s * (u - x) + c * (v - y)} 0 0 0 {heading - yaw}")
    (tmp_path / "room.relations").write_text("\n".join(rows) + "\n")
    return f"room,{tmp_path}/room.log,{tmp_path}/room.relations,0.0"


def test_a_known_room_is_mapped_and_scored(room, tmp_path):
    done = rosrun("reproduce", "grid-slam", "--quick", "--parts", "logs", "--log", room, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stdout + done.stderr
    figures = dict(re.findall(r"^figure (slam/room/\w+) ([0-9.]+) ", done.stdout, re.M))
    assert float(figures["slam/room/translation_mean"]) < 0.02 and float(figures["slam/room/rotation_mean"]) < 0.5
    assert float(figures["slam/room/memory"]) > 1.0
    for name in ("room_map.png", "room_1_poses.txt", "grid_slam_room.csv"):
        assert (tmp_path / "out" / name).stat().st_size > 0


def test_the_office_begins_well():
    done = rosrun("reproduce", "grid-slam", "--quick", "--parts", "office")
    assert done.returncode == 0, done.stdout + done.stderr
    assert float(re.search(r"^figure slam/office/rmse_worst ([0-9.]+) m", done.stdout, re.M)[1]) < 0.10


BAD = {
    ("--log", "a,b"): "a,b is not NAME,LOG,RELATIONS,AHEAD",
    ("--log", "a,/nowhere/a.log,/nowhere/a.relations,0"): "no such file: /nowhere/a.log",
    ("--parts", "office", "--set", "beams=3"): "grid_slam has no parameter beams",
    ("--parts", "office", "--set", "sigma=wide"): "sigma=wide is not NAME=VALUE",
}


@pytest.mark.parametrize("arguments", BAD)
def test_a_wrong_wish_is_answered(arguments):
    done = rosrun("reproduce", "grid-slam", *arguments)
    assert done.returncode != 0 and BAD[arguments] in done.stderr, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
