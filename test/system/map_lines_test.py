"""Lengths on maps that are drawn by rule: faces, corners and round bodies of known places, cells of 2.5 cm."""
import math
from types import SimpleNamespace

import numpy
import pytest

import map_lines

SIDE, LOW = 0.025, -3.0  # m
COUNT = 240
BEGIN, END = [-0.4, 0.0, 0.6], [0.4, 0.0, 0.6]


def turn(yaw, x=0.0, y=0.0):
    T = numpy.eye(4)
    c, s = math.cos(yaw), math.sin(yaw)
    T[:2, :2], T[:2, 3] = [[c, -s], [s, c]], (x, y)
    return T


def drawn(surface, T=numpy.eye(4), seen=lambda x, y: True):
    """A map, free but for the cells in which a point of `surface` (n x 2 in the world) lies; unknown where not `seen` (of the world)."""
    index = (numpy.arange(COUNT) + 0.5) * SIDE + LOW
    x, y = numpy.meshgrid(index, index)
    world = numpy.stack([x, y], axis=-1) @ T[:2, :2].T + T[:2, 3]
    cells = numpy.where(numpy.vectorize(seen)(world[..., 0], world[..., 1]), 0, -1)
    local = (surface - T[:2, 3]) @ T[:2, :2]
    at = ((local - LOW) // SIDE).astype(int)
    cells[at[:, 1], at[:, 0]] = 100
    origin = SimpleNamespace(position=SimpleNamespace(x=LOW, y=LOW))
    info = SimpleNamespace(height=COUNT, width=COUNT, resolution=SIDE, origin=origin)
    return map_lines.Map(SimpleNamespace(info=info, data=cells.ravel().tolist()), T)


def segment(a, b):
    return numpy.linspace(a, b, 2000)


def wall(x, low=-1.0, high=1.0, slope=0.0):
    return segment((x + slope * low, low), (x + slope * high, high))


FRONT = segment((-0.4, 0.0), (0.4, 0.0))  # of a box that lies to its left, y > 0
ENDS = [segment((x, 0.0), (x, 0.5)) for x in (-0.4, 0.4)]


def outside(x, y):
    """The box and what lies behind it is not seen."""
    return not (abs(x) < 0.41 and y > -0.01)


@pytest.mark.parametrize("yaw", [0.0, 0.02, 0.4])
def test_between_faces_is_exact_to_a_cell(yaw):
    for shift in (0.0, 0.007, 0.012, 0.019):
        walls = numpy.r_[wall(-0.4 + shift), wall(0.4)]
        at = drawn(walls, turn(yaw, 0.1, -0.05))
        assert map_lines.between_faces(at, BEGIN, END) == pytest.approx(0.8 - shift, abs=SIDE)


def test_a_slanting_face_is_met_where_the_dimension_meets_it():
    at = drawn(numpy.r_[wall(-0.4), wall(0.45, slope=0.3)])
    assert map_lines.between_faces(at, BEGIN, END) == pytest.approx(0.85, abs=SIDE)


def test_a_face_is_on_the_side_that_is_seen_free():
    """Walls of 0.1 m: of a room their inner sides count, of a body the outer ones."""
    thick = numpy.concatenate([wall(sign * (0.4 + off)) for sign in (-1, 1) for off in numpy.arange(0.0, 0.1, 0.01)])
    room = drawn(thick, seen=lambda x, y: abs(x) < 0.5)
    assert map_lines.between_faces(room, BEGIN, END) == pytest.approx(0.8, abs=SIDE)
    body = drawn(thick, seen=lambda x, y: abs(x) > 0.4)
    assert map_lines.between_faces(body, BEGIN, END) == pytest.approx(1.0, abs=SIDE)


def test_single_cells_before_a_face_do_not_move_it():
    stray = numpy.array([[0.3, 0.0], [0.25, 0.1], [-0.28, -0.06]])
    clean, noisy = drawn(numpy.r_[wall(-0.4), wall(0.4)]), drawn(numpy.r_[wall(-0.4), wall(0.4), stray])
    assert map_lines.between_faces(noisy, BEGIN, END) == pytest.approx(map_lines.between_faces(clean, BEGIN, END), abs=1e-9)


def test_of_a_face_that_is_hardly_seen_the_front_counts():
    """The end of a body's front, one cell thick, is all that is seen of its near end, and past it stray rows of what lies behind."""
    front = segment((0.4, -0.06), (1.0, -0.06))
    behind = numpy.concatenate([segment((0.5 + 0.9 * y, y), (0.6 + 0.9 * y, y)) for y in numpy.arange(0.01, 0.12, 0.05)])
    at = drawn(numpy.concatenate([wall(-0.4), front, behind]))
    assert map_lines.between_faces(at, BEGIN, END) == pytest.approx(0.8, abs=SIDE)


def test_specks_are_fewer_than_four_cells_that_touch():
    cells = numpy.zeros((8, 12), bool)
    cells[1, 1:4] = cells[[4, 5, 6, 5], [6, 7, 8, 9]] = True
    kept = cells.copy()
    kept[1, 1:4] = False
    assert (map_lines.without_specks(cells) == kept).all()
    assert not map_lines.without_specks(numpy.zeros((3, 3), bool)).any()


def test_a_face_that_is_not_in_the_map_has_no_length():
    assert math.isnan(map_lines.between_faces(drawn(wall(0.4)), BEGIN, END))
    assert math.isnan(map_lines.between_faces(drawn(numpy.zeros((0, 2))), BEGIN, END))
    assert math.isnan(map_lines.along_face(drawn(wall(0.4, 0.3, 0.4)), BEGIN, END))
    assert math.isnan(map_lines.between_middles(drawn(numpy.array([[0.4, 0.0]])), BEGIN, END)), "a speck"


@pytest.mark.parametrize("yaw", [0.0, 0.02, 0.4])
@pytest.mark.parametrize("ends", [[], ENDS[1:], ENDS])
def test_a_face_reaches_from_corner_to_corner(ends, yaw):
    at = drawn(numpy.concatenate([FRONT, *ends]), turn(yaw, 0.013, 0.008), outside)
    assert map_lines.along_face(at, BEGIN, END) == pytest.approx(0.8, abs=1.5 * SIDE)


def test_a_face_that_is_longer_or_shorter_than_said_is_measured_as_it_is():
    for half in (0.25, 0.55):
        at = drawn(segment((-half, 0.0), (half, 0.0)), seen=lambda x, y: y < 0.0)
        assert map_lines.along_face(at, BEGIN, END) == pytest.approx(2 * half, abs=1.01 * SIDE)  # ends lie on edges of cells


def test_a_face_is_found_where_beams_have_passed_through_the_body():
    """A box all of which is seen free, with single cells within, as raw scans draw it."""
    within = numpy.array([[-0.2, 0.05], [-0.15, 0.05], [0.05, 0.08], [0.3, 0.1]])
    at = drawn(numpy.concatenate([FRONT, within]))
    assert map_lines.along_face(at, BEGIN, END) == pytest.approx(0.8, abs=SIDE)


def test_which_way_round_a_dimension_is_told_does_not_matter():
    at = drawn(numpy.concatenate([FRONT, *ENDS]), turn(0.1), outside)
    assert map_lines.along_face(at, END, BEGIN) == pytest.approx(map_lines.along_face(at, BEGIN, END), abs=SIDE)
    faces = drawn(numpy.r_[wall(-0.41), wall(0.4)])
    assert map_lines.between_faces(faces, END, BEGIN) == pytest.approx(map_lines.between_faces(faces, BEGIN, END), abs=1e-9)


def test_what_lies_behind_a_face_is_not_taken_for_it():
    behind = numpy.array([[0.5, 0.1], [0.6, 0.3], [-0.55, 0.2]])
    at = drawn(numpy.concatenate([FRONT, behind]), seen=outside)
    assert map_lines.along_face(at, BEGIN, END) == pytest.approx(0.8, abs=SIDE)


def arc(x, y, radius, low, high):
    angle = numpy.radians(numpy.linspace(low, high, 2000))
    return numpy.c_[x + radius * numpy.cos(angle), y + radius * numpy.sin(angle)]


@pytest.mark.parametrize("seen", [(0, 360), (20, 160)])
def test_between_the_middles_of_round_bodies(seen):
    at = drawn(numpy.r_[arc(-0.61, 0.0, 0.29, *seen), arc(0.6, 0.0, 0.29, *seen)], turn(0.05))
    assert map_lines.between_middles(at, [-0.6, 0.0], [0.6, 0.0]) == pytest.approx(1.21, abs=SIDE)


def test_a_circle_is_found_from_a_third_of_it():
    x, y, radius = map_lines.circle(arc(3.0, -2.0, 0.3, 10, 130))
    assert (x, y, radius) == pytest.approx((3.0, -2.0, 0.3), abs=1e-6)
    assert all(map(math.isnan, map_lines.circle(segment((0.0, 0.0), (1.0, 1.0)))))
    assert all(map(math.isnan, map_lines.circle(numpy.zeros((0, 2)))))


def test_a_line_leaves_out_what_is_off_it():
    y = numpy.arange(12) * SIDE
    x = 0.3 + 0.2 * y
    x[[3, 8]] += (0.2, -0.3)
    assert map_lines.line(numpy.c_[x, y], SIDE, 1) == pytest.approx((0.3, 0.2), abs=1e-9)
    assert map_lines.line(numpy.zeros((0, 2)), SIDE, 1) is None


def test_where_there_is_no_line_a_face_is_where_it_is_first_met():
    few = numpy.c_[[0.32, 0.3], [0.0, SIDE]]
    assert map_lines.line(few, SIDE, 1) == pytest.approx((0.31, 0.0)) and map_lines.line(few, SIDE, -1) == pytest.approx((0.31, 0.0))
    in_one_row = numpy.c_[[0.1, 0.2, 0.3], [0.0, 0.0, 0.0]]
    assert map_lines.line(in_one_row, SIDE, 1) == (pytest.approx(0.1), 0.0) and map_lines.line(in_one_row, SIDE, -1) == (pytest.approx(0.3), 0.0)
    steep = numpy.c_[0.1 + 2.0 * numpy.arange(5) * SIDE, numpy.arange(5) * SIDE]
    assert map_lines.line(steep, SIDE, 1) == (pytest.approx(0.1), 0.0)
