"""kitti_poses: the way of a LiDAR through scenes where it is known."""
import math
import os
import pathlib

import lane_score
import numpy
import pytest
from tools_test import CALIBRATION, rosrun

DATA = os.environ.get("FIELD_FUSION_DATA")


def street(seed=1):
    """Points on a road between walls with recesses, some of the surfaces tilted; metres."""
    draw = numpy.random.default_rng(seed)
    road = numpy.c_[draw.uniform(-20, 60, 30000), draw.uniform(-8, 8, 30000), numpy.full(30000, -1.7)]
    walls = []
    for x in range(-20, 60, 4):
        for side in (-1, 1):
            y = side * draw.uniform(5, 8)
            along, up = draw.uniform(0, 4, 600), draw.uniform(-1.7, 2, 600)
            walls += [numpy.c_[x + along, numpy.full(600, y), up],  # a front and the side of it
                      numpy.c_[numpy.full(300, float(x)), side * draw.uniform(abs(y), 9, 300), draw.uniform(-1.7, 2, 300)]]
    return numpy.concatenate([road, *walls])


def pose(x, y, yaw):
    T = numpy.eye(4)
    T[:2, :2] = [[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]]
    T[:2, 3] = x, y
    return T


def write(folder, poses, points, noise=0.01):
    """What a LiDAR sees of the points at each pose, up to 40 m away."""
    (folder / "velodyne").mkdir(parents=True)
    (folder / "calib.txt").write_text(CALIBRATION)
    draw = numpy.random.default_rng(2)
    for number, T in enumerate(poses):
        seen = (points - T[:3, 3]) @ T[:3, :3] + draw.normal(0, noise, points.shape)
        seen = seen[numpy.hypot(seen[:, 0], seen[:, 1]) < 40.0]
        numpy.c_[seen, numpy.zeros(len(seen))].astype("<f4").tofile(folder / f"velodyne/{number:06}.bin")


def found(folder):
    done = rosrun("kitti_poses", folder, folder / "poses.csv")
    assert done.returncode == 0, done.stderr
    return list(lane_score.read_poses(folder / "poses.csv").values())


def assert_close(T, truth, metres, degrees):
    off = numpy.linalg.inv(truth) @ T
    assert numpy.linalg.norm(off[:3, 3]) < metres
    assert math.degrees(math.acos(min(1.0, (numpy.trace(off[:3, :3]) - 1) / 2))) < degrees


def test_way_through_a_street_is_found(tmp_path):
    truth = [pose(0, 0, 0), pose(1.5, 0.02, 0.03), pose(3.0, 0.1, 0.06), pose(4.4, 0.25, 0.09)]
    write(tmp_path / "drive", truth, street())
    poses = found(tmp_path / "drive")
    assert len(poses) == 4 and (poses[0] == numpy.eye(4)).all()
    for T, true in zip(poses, truth):
        assert_close(T, true, 0.1, 0.3)


def test_clouds_that_do_not_fit_are_named(tmp_path):
    draw = numpy.random.default_rng(3)
    write(tmp_path / "drive", [pose(0, 0, 0)], draw.uniform(-3, 3, (2000, 3)))
    numpy.full((500, 4), 35.0, "<f4").tofile(tmp_path / "drive/velodyne/000001.bin")
    done = rosrun("kitti_poses", tmp_path / "drive", tmp_path / "poses.csv")
    assert done.returncode != 0 and "000001.bin" in done.stderr


@pytest.mark.skipif(not DATA, reason="FIELD_FUSION_DATA is not set")
def test_real_clouds_of_known_motion(tmp_path):
    folder = pathlib.Path(DATA) / "registration"
    (tmp_path / "velodyne").mkdir()
    (tmp_path / "calib.txt").write_text(CALIBRATION)
    for number, name in enumerate(("target", "source")):
        head, _, body = (folder / f"small_gicp_{name}.ply").read_bytes().partition(b"end_header\n")
        count = int(head.split(b"element vertex ")[1].split()[0])
        numpy.frombuffer(body, "<f4", 4 * count).tofile(tmp_path / f"velodyne/{number}.bin")
    assert_close(found(tmp_path)[1], numpy.loadtxt(folder / "T_target_source.txt"), 0.03, 0.5)
