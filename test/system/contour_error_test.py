"""Contours that are drawn by rule, against outlines of known distance."""
import math
from types import SimpleNamespace

import numpy
import pytest

import contour_error

CELL = 0.05


def square(half, step=0.01):
    at = numpy.arange(-half, half + step / 2, step)
    return numpy.concatenate([numpy.c_[at, numpy.full(len(at), y)] for y in (-half, half)]
                             + [numpy.c_[numpy.full(len(at), x), at] for x in (-half, half)])


def cells(half):
    """Middles of all cells of a square of `half` [m] a side, which is a whole number of cells."""
    at = numpy.arange(-half + CELL / 2, half, CELL)
    return numpy.stack(numpy.meshgrid(at, at), axis=-1).reshape(-1, 2)


def test_the_contour_of_filled_cells_is_their_edge():
    assert len(contour_error.contour(cells(0.25), CELL)) == 4 * 10 - 4
    assert len(contour_error.contour(cells(0.05), CELL)) == 4, "too small to have anything within"
    assert len(contour_error.contour(numpy.zeros((0, 2)), CELL)) == 0
    line = numpy.c_[numpy.arange(5) * CELL + 0.025, numpy.full(5, 0.025)]
    assert len(contour_error.contour(line, CELL)) == 5


def test_a_filled_body_is_as_far_off_as_the_middles_of_its_edge():
    found = contour_error.score(cells(0.25), square(0.25), square(0.25), CELL)
    assert found == (36, pytest.approx(0.025, abs=6e-4), 1.0)  # places of the outline are 1 cm apart
    larger = contour_error.score(cells(0.25), square(0.15), square(0.15), CELL)
    assert larger.error == pytest.approx(0.075, abs=0.005), "corners are farther off"


def test_only_what_could_be_seen_counts_for_completeness():
    front = cells(0.25)[cells(0.25)[:, 1] < -0.2]
    outline = square(0.25)
    seen = outline[numpy.isclose(outline[:, 1], -0.25)]
    assert contour_error.score(front, outline, seen, CELL).completeness == 1.0
    sides = contour_error.score(front, outline, outline, CELL).completeness
    assert sides == pytest.approx((51 + 2 * 10) / 204, abs=0.02), "the front, and of each side 0.1 m: half a cell and CLOSE cells up"


def test_without_points_or_outline_there_is_no_error():
    none = numpy.zeros((0, 2))
    assert math.isnan(contour_error.score(none, square(0.25), square(0.25), CELL).error)
    assert contour_error.score(none, square(0.25), square(0.25), CELL).completeness == 0.0
    unseen = contour_error.score(cells(0.25), square(0.25), none, CELL)
    assert unseen.error > 0 and math.isnan(unseen.completeness)
    assert math.isnan(contour_error.score(cells(0.25), none, none, CELL).error)


def test_points_belong_to_the_nearest_body_that_is_near():
    at = lambda x: SimpleNamespace(distance=lambda points: numpy.hypot(points[:, 0] - x, points[:, 1]))
    points = numpy.array([[0.1, 0.0], [0.45, 0.0], [0.3, 0.0], [2.0, 0.0]])
    assert contour_error.of_bodies(points, [at(0.0), at(0.5)]).tolist() == [0, 1, 1, -1]
    assert contour_error.of_bodies(numpy.zeros((0, 2)), [at(0.0)]).tolist() == []
