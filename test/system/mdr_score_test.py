"""How the corridor experiment scores: the grid and the length read from it, places by odometry, points off walls."""
import math
from types import SimpleNamespace

import numpy
import pytest

import corridor_map
import corridor_match
import dead_reckoning
import mdr_corridor
import point_error
import walk_bag


def corridor(west, east):
    """A grid of a corridor whose end walls stand at x = west + slope y and so on, seen from its middle."""
    grid = corridor_map.Grid()
    y = numpy.linspace(-1.0, 1.0, 201)
    for origin in (-10.0, 0.0, 10.0):
        for (x, slope) in (west, east):
            grid.add(numpy.array([origin, 0.0]), numpy.stack([x + slope * y, y], axis=1))
    return grid


def test_the_length_is_that_between_the_end_walls_to_a_part_of_a_cell():
    lengths = corridor((-15.011, 0.0), (14.987, 0.0)).length()
    assert set(lengths) == {"top", "middle", "bottom"}
    for length in lengths.values():
        assert length == pytest.approx(29.998, abs=corridor_map.CELL / 2)


def test_a_slanting_wall_is_longer_at_the_top_and_the_mean_is_that_of_the_middle():
    lengths = corridor((-15.0, 0.0), (15.0, 0.2)).length()
    assert lengths["top"] - lengths["bottom"] == pytest.approx(0.2 * 1.2, abs=0.03)
    assert corridor_map.mean_length(lengths) == pytest.approx(30.0, abs=0.03)


def test_without_an_end_wall_there_is_no_length():
    assert math.isnan(corridor_map.mean_length(corridor((-15.0, 0.0), (12.0, 0.0)).length()))
    assert math.isnan(corridor_map.mean_length(corridor_map.Grid().length()))


def test_cells_on_the_way_are_visited_and_where_the_beam_ends_is_hit():
    grid = corridor_map.Grid()
    grid.add(numpy.array([0.01, 0.01]), numpy.array([[1.01, 0.01], [100.0, 0.0]]))  # the second leaves the map
    zero = numpy.round(-corridor_map.LOW / corridor_map.CELL).astype(int)
    row = slice(zero[0], zero[0] + 21), zero[1]
    assert grid.hits[row].tolist() == [0] * 20 + [1]
    assert grid.visits[row][:20].min() >= 1 and grid.hits.sum() == 1
    assert grid.occupied().sum() == 1
    for _ in range(3):
        grid.add(numpy.array([0.01, 0.01]), numpy.array([[2.01, 0.01]]))
    assert grid.visits[zero[0] + 20, zero[1]] == 5 and not grid.occupied()[zero[0] + 20, zero[1]]  # 1 of 5 is less than a quarter


def room_seen_from(place, off):
    """A scan of a room of 8 x 2 m whose places are told `off` wrong."""
    angles = numpy.linspace(-math.pi, math.pi, 1600, endpoint=False) + 0.001  # no beam along an axis
    ways = numpy.stack([numpy.cos(angles), numpy.sin(angles)], axis=1)
    far = numpy.where(ways > 0, [4.0, 1.0], [-4.0, -1.0]) - place
    ranges = numpy.min(far / ways, axis=1)
    return place + off, place + off + ways * ranges[:, None]


def test_a_scan_is_moved_onto_the_walls_that_are_there():
    matched = corridor_match.MatchedGrid()
    for at, off in ((0.0, 0.0), (0.5, 0.03), (1.0, 0.08), (1.5, -0.02)):
        matched.add(*room_seen_from(numpy.array([at, 0.1]), numpy.array([off, off / 2])))
        assert matched.offset == pytest.approx([-off, -off / 2], abs=0.01)


def test_what_is_too_far_or_nowhere_moves_nothing():
    origin, ends = room_seen_from(numpy.zeros(2), numpy.zeros(2))
    grid = corridor_map.Grid()
    assert corridor_match.shift(grid, origin, ends).tolist() == [0.0, 0.0]
    grid.add(origin, ends)
    assert corridor_match.shift(grid, origin + 0.7, ends + 0.7).tolist() == [0.0, 0.0]
    assert corridor_match.shift(grid, origin, numpy.zeros((0, 2))).tolist() == [0.0, 0.0]


def test_points_of_the_floor_do_not_enter_the_map():
    T = numpy.eye(4)
    T[:3, 3] = 1.0, 2.0, 0.6
    origin, points = corridor_map.level(T, numpy.array([[5.0, 0.0, 0.0], [3.0, 0.0, -0.6]]))
    assert origin.tolist() == [1.0, 2.0] and points.tolist() == [[6.0, 2.0]]


def pose(x, y, yaw):
    vector = lambda *values: SimpleNamespace(**dict(zip("xyz", values)))
    orientation = SimpleNamespace(x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2))
    return SimpleNamespace(pose=SimpleNamespace(pose=SimpleNamespace(position=vector(x, y, 0.0), orientation=orientation)))


def track(*poses):
    """One a second."""
    for i, message in enumerate(poses):
        message.header = SimpleNamespace(stamp=SimpleNamespace(to_sec=lambda i=i: float(i)))
    return walk_bag.Track(poses)


def test_steps_are_the_odometrys_and_the_yaw_is_true():
    # truly ahead along y; the odometry began with another yaw and tells a tenth too much
    truth, odometry = (track(*(pose(*at) for at in way)) for way in (
        [(3, 0, math.pi / 2), (3, 2, math.pi / 2), (3, 4, math.pi / 2)], [(0, 0, 0), (2.2, 0, 0), (4.4, 0, 0)]))
    scans = [SimpleNamespace(begin=t, message=SimpleNamespace(header=SimpleNamespace(stamp=SimpleNamespace(to_sec=lambda t=t: t))))
             for t in (0.0, 0.5, 1.5)]
    T_base_scan = numpy.eye(4)
    T_base_scan[:3, 3] = 0.1, 0.0, 0.5
    places = dead_reckoning.places(SimpleNamespace(scans=scans, odometry=odometry, truth=truth, T_base_scan=T_base_scan))
    assert [p[:3, 3].round(6).tolist() for p in places] == [[3.0, 0.1, 0.5], [3.0, 1.2, 0.5], [3.0, 3.4, 0.5]]
    assert places[2][:3, 0] == pytest.approx([0, 1, 0])


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
    row = lambda kind, length: mdr_corridor.Row(1, kind, dict.fromkeys(corridor_map.STRIPS, length), 30.2, 0, None)
    rows = [row("raw", 29.0), row("vicp", 29.6), row("imu", 30.5), row("mdr", 30.1), row("instant", 30.08)]
    told = "\n".join(mdr_corridor.table(rows))
    assert "mdr errs by 75.0 % less than vicp (paper: 48.4 %)" in told and "29.67 m    0.33 m" in told
    lines = list(mdr_corridor.lines(rows))
    assert lines[0].startswith("figure quadruped/corridor/raw_error 1 m n=1 ")
    assert lines[3].startswith("figure quadruped/corridor/mdr_error 0.1 m n=1 ")
    assert lines[4].startswith("figure quadruped/corridor/mdr_to_instant 0.02 m n=1 ")
