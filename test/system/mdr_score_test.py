"""How the corridor experiment scores: the length read from a map, points off walls."""
import math
from types import SimpleNamespace

import numpy
import pytest

import corridor_length
import mdr_corridor
import point_error
import poses
import walk_bag


def drawn(west, east, start=(0.0, 0.0), half=1.0):
    """A map of a corridor whose end walls stand at x = west[0] + west[1] y and so on, one cell thick, in cells of 5 cm."""
    side, low = 0.05, numpy.array([-18.0, -4.0])
    cells = numpy.full((160, 720), -1)
    for row in range(160):
        y = low[1] + side * (row + 0.5)
        if abs(y) > half:
            continue
        for x, slope in (west, east):
            cells[row, int((x + slope * y - low[0]) // side)] = 100
        cells[row, 300:400] = 0
    origin = SimpleNamespace(position=SimpleNamespace(x=low[0] - start[0], y=low[1] - start[1]))
    info = SimpleNamespace(height=160, width=720, resolution=side, origin=origin)
    return corridor_length.Map(SimpleNamespace(info=info, data=cells.ravel().tolist()), numpy.array(start))


def test_the_length_is_that_between_the_end_walls_to_a_cell():
    lengths = drawn((-15.011, 0.0), (14.987, 0.0)).lengths()
    assert set(lengths) == {"top", "middle", "bottom"}
    for length in lengths.values():
        assert length == pytest.approx(29.998, abs=0.05)


def test_a_slanting_wall_is_longer_at_the_top_and_the_mean_is_that_of_the_middle():
    lengths = drawn((-15.0, 0.0), (15.0, 0.2)).lengths()
    assert lengths["top"] - lengths["bottom"] == pytest.approx(0.2 * 1.2, abs=0.03)
    assert corridor_length.mean_length(lengths) == pytest.approx(30.0, abs=0.03)


def test_what_lies_scattered_behind_a_wall_does_not_move_it():
    clean = drawn((-15.0, 0.0), (15.0, 0.0))
    noisy = drawn((-15.0, 0.0), (15.0, 0.0))
    noisy.cells[60:100:2, 664:675] = 100
    assert noisy.lengths() == clean.lengths()


def test_where_the_map_begins_changes_no_length():
    here, there = (drawn((-15.0, 0.01), (15.1, 0.0), start).lengths() for start in ((0.0, 0.0), (-13.0, 0.3)))
    assert here == pytest.approx(there, abs=1e-9)


def test_without_an_end_wall_there_is_no_length():
    assert math.isnan(corridor_length.mean_length(drawn((-15.0, 0.0), (12.0, 0.0)).lengths()))
    assert math.isnan(corridor_length.mean_length(drawn((-15.0, 0.0), (15.0, 0.0), half=0.0).lengths()))


def pose(x, y, yaw):
    vector = lambda *values: SimpleNamespace(**dict(zip("xyz", values)))
    orientation = SimpleNamespace(x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2))
    return SimpleNamespace(pose=SimpleNamespace(pose=SimpleNamespace(position=vector(x, y, 0.0), orientation=orientation)))


def track(*poses):
    """One a second."""
    for i, message in enumerate(poses):
        message.header = SimpleNamespace(stamp=SimpleNamespace(to_sec=lambda i=i: float(i)))
    return walk_bag.Track(poses)


def test_a_pose_in_space_is_told_without_its_pitch_and_roll():
    T = poses.of_message(pose(1.0, -2.0, 0.7).pose.pose)
    tilted = T @ poses.matrix(SimpleNamespace(x=0, y=0, z=0), SimpleNamespace(x=0.0, y=math.sin(0.05), z=0.0, w=math.cos(0.05)))
    assert poses.flat(tilted) == pytest.approx((1.0, -2.0, 0.7))


def walled(ranges, true):
    """A scanner that stands at (1, 0), looks at a wall at x = 4, and has one beam ahead and one 60 degrees to the left."""
    scan = lambda values, **more: SimpleNamespace(ranges=values, angle_min=0.0, angle_increment=math.pi / 3, range_min=0.1, range_max=20.0,
                                                  **more)
    still = track(pose(1, 0, 0), pose(1, 0, 0))
    return (SimpleNamespace(truth=still, T_base_scan_true=numpy.eye(4), bodies={7: "wall", 8: "other"}),
            walk_bag.Scan(scan(ranges), 0.5, scan(true, intensities=[7.0, 7.0, 8.0])))


def test_points_are_off_their_wall_by_what_the_range_errs_across_it():
    walk, scan = walled([3.1, 6.1, 2.0], [3.0, 6.0, 2.0])
    room = point_error.Room({"wall": (1, 0, 4.0)})
    _, points = walk_bag.returns(scan.message)
    assert room.errors(walk, scan, points) == pytest.approx([0.1, 0.05])
    assert room.noise(walk, scan) == pytest.approx([0.1, 0.05])
    assert point_error.rms([room.noise(walk, scan)]) == pytest.approx(math.sqrt((0.01 + 0.0025) / 2))
    assert room.errors(walk, scan, points + [0.3, 1.0, 0.0]) == pytest.approx([0.4, 0.35])


def test_beams_without_return_and_wrong_ones_do_not_count():
    walk, scan = walled([math.inf, 9.0, 2.0], [3.0, 6.0, 2.0])
    room = point_error.Room({"wall": (1, 0, 4.0)})
    seen, points = walk_bag.returns(scan.message)
    assert seen.tolist() == [1, 2]
    assert len(room.errors(walk, scan, points)) == len(room.noise(walk, scan)) == 0
    assert math.isnan(point_error.rms([room.noise(walk, scan)]))


def test_lengths_are_set_beside_the_papers():
    row = lambda kind, length: mdr_corridor.Row(1, kind, dict.fromkeys(corridor_length.STRIPS, length), 0, None)
    rows = [row("raw", 29.0), row("vicp", 29.6), row("imu", 30.5), row("mdr", 30.1), row("instant", 30.08)]
    told = "\n".join(mdr_corridor.table(rows))
    assert "mdr errs by 75.0 % less than vicp (paper: 48.4 %)" in told and "29.67 m    0.33 m" in told
    lines = list(mdr_corridor.lines(rows))
    assert lines[0].startswith("figure quadruped/corridor/raw_error 1 m n=1 ")
    assert lines[3].startswith("figure quadruped/corridor/mdr_error 0.1 m n=1 ")
    assert lines[4].startswith("figure quadruped/corridor/mdr_to_instant 0.02 m n=1 ")
