"""Lengths on an occupancy grid as a person measures them: lines through the faces of bodies, their corners, round bodies.

A face is where a row of cells, come from the side that is seen free, is first occupied: its beams end there, and behind lies
what was seen from afar. Specks are not looked at. Where a dimension runs along a face, its end is the corner with the face round it, or where that was
never seen, the last cell of the face."""
import math
import typing

import numpy
from scipy import ndimage

import grids
import poses

REACH = 0.4  # m, how far from where an end should be a face is looked for, at most half of the length
HALF_STRIP = 0.15  # m, of a face on either side of the dimension
ALIKE = 1.5  # times as many free places on one side of a face as on the other: then it is seen from there
SPECK = 4  # cells that touch: fewer are no part of a body
FEWEST = 3  # rows that make a line, cells of a round body
OFF = 1.5  # cells by which a row may leave its line
STEEP = 0.4  # of a face against its dimension (22 degrees)
GAP = 2.5  # cells from one of a face to the next
NEAR = 3  # cells from the last of a face within which the face round the corner is


class Map:
    """`grid`: nav_msgs/OccupancyGrid. `T_world_map`: 4 x 4."""

    def __init__(self, grid, T_world_map):
        self.side, cells = grid.info.resolution, grids.cells(grid)
        places = lambda which: poses.apply_flat(T_world_map, grids.middles(grid, which))
        self.occupied = places(without_specks(cells >= grids.OCCUPIED))
        self.free = places((cells >= 0) & (cells < grids.OCCUPIED))


def without_specks(cells):
    """The same without groups of fewer than SPECK that touch, at sides or corners."""
    groups, count = ndimage.label(cells, numpy.ones((3, 3)))
    return numpy.isin(groups, 1 + numpy.flatnonzero(ndimage.sum_labels(cells, groups, range(1, count + 1)) >= SPECK)) if count else cells


def between_faces(drawn, begin, end):
    """[m] from one face to the other, each across the way from `begin` to `end` (points of the world): of a room or a gap its inner
    faces, of a body its outer ones. NaN where one is not there."""
    return _along(drawn, begin, end, lambda view, at: view.face_across(at))


def along_face(drawn, begin, end):
    """[m] of a face that reaches from `begin` to `end`, from corner to corner; NaN where there is none."""
    view = _View(drawn, begin, end)
    face = view.face_along()
    return math.nan if face is None else view.corner(face, 1) - view.corner(face, -1)


def between_middles(drawn, begin, end):
    """[m] between the middles of two upright cylinders."""
    return _along(drawn, begin, end, lambda view, at: view.middle(at))


def _along(drawn, begin, end, place):
    view = _View(drawn, begin, end)
    return place(view, view.length) - place(view, 0.0)


class Face(typing.NamedTuple):
    """Of a body along a dimension: y = offset + slope x."""
    offset: float
    slope: float
    places: numpy.ndarray  # x that are on it
    inwards: int  # 1 where the body is to the left, else -1

    def y(self, x):
        return self.offset + self.slope * x


class _View:
    """Cells with x along a dimension, from 0 to its nominal `length`, and y to the left of it."""

    def __init__(self, drawn, begin, end):
        begin, way = numpy.array(begin[:2], float), numpy.subtract(end[:2], begin[:2])
        self.length, self.side = float(numpy.linalg.norm(way)), drawn.side
        along = way / self.length
        axes = numpy.c_[along, [-along[1], along[0]]]
        self.occupied, self.free = (drawn.occupied - begin) @ axes, (drawn.free - begin) @ axes
        self.reach = min(REACH, self.length / 2)

    def face_across(self, at):
        """x where the face near `at`, 0 or the length, crosses the dimension."""
        way = (1 if at > 0.0 else -1) * (1 if self.is_gap() else -1)
        fitted = line(_first(_window(self.occupied, at, self.reach, -HALF_STRIP, HALF_STRIP), way, self.side), self.side, way)
        return math.nan if fitted is None else fitted[0]

    def is_gap(self):
        """Whether most of what lies between the ends is free, and faces are seen from there; else they are those of a body."""
        half = self.length / 2
        free = len(_window(self.free, half, half, -HALF_STRIP, HALF_STRIP))
        return free > self.length * HALF_STRIP / self.side ** 2

    def face_along(self):
        """Seen from the side on which more is free; of sides that are alike, from that from which more of the face lies in a line."""
        half, best = self.length / 2, None
        occupied, free = (_window(points, half, half + self.reach, -self.reach, self.reach)[:, ::-1] for points in (self.occupied, self.free))
        for inwards in _ways(free[numpy.abs(free[:, 1] - half) < half, 0], 0.0):
            rows = _first(occupied, inwards, self.side)
            inner = rows[numpy.abs(rows[:, 1] - half) < 0.8 * half]
            if len(inner) < FEWEST:
                continue
            fitted = line(inner, self.side, inwards)
            places = rows[numpy.abs(rows[:, 0] - fitted[0] - fitted[1] * rows[:, 1]) <= OFF * self.side, 1]
            if best is None or len(places) > len(best.places):
                best = Face(*fitted, places, inwards)
        return best

    def corner(self, face, way):
        """x of an end of the face: of the dimension's end (`way` 1) or begin (-1)."""
        last = way * _end_of_run(way * face.places, way * self.length / 2, GAP * self.side)
        depth = face.inwards * (self.occupied[:, 1] - face.y(self.occupied[:, 0]))
        beside = (depth > self.side) & (depth < self.side + 2 * HALF_STRIP) & (numpy.abs(self.occupied[:, 0] - last) < NEAR * self.side)
        rows = _first(self.occupied[beside], -way, self.side)
        if len(rows) < FEWEST:
            return last
        offset, slope = line(rows, self.side, -way)
        return offset + slope * face.y(last)

    def middle(self, at):
        return circle(_window(self.occupied, at, self.reach, -self.reach, self.reach))[0]


def _ways(free, at):
    """From which side of `at` one comes to a face: 1, from below; -1, from above; that of more free places, both where they are alike."""
    below, above = numpy.sum(free < at), numpy.sum(free > at)
    return [1] if below > ALIKE * above else [-1] if above > ALIKE * below else [1, -1]


def _first(cells, way, side):
    """n x 2 of cells: in each row of y the first along x (`way` 1) or against it (-1)."""
    first = {}
    for x, y in cells:
        row = math.floor(y / side)
        if row not in first or way * x < way * first[row][0]:
            first[row] = x, y
    return numpy.array(list(first.values())).reshape(-1, 2)


def _window(points, at, reach, low, high):
    return points[(numpy.abs(points[:, 0] - at) <= reach) & (points[:, 1] >= low) & (points[:, 1] <= high)]


def _end_of_run(places, start, gap):
    """The last of `places` that is reached from `start` upwards without a gap; `start` itself if there is none."""
    end = start
    for place in numpy.sort(places):
        if place >= start:
            if place - end > gap:
                break
            end = place
    return end


def line(points, cell, way):
    """(a, b) of x = a + b y, a face that one comes to along x (`way` 1) or against it (-1). None of no points.

    Least squares of what is near the median line (Theil and Sen). Where that is too steep for a face, most are off it, or there are
    too few for it, little of the face is in the map, and the rest is what was seen past it: then it is where the first row is met."""
    if not len(points):
        return None
    x, y = points.T
    fitted = _median_line(x, y) if len(points) >= FEWEST else None
    if fitted is not None:
        near = numpy.abs(x - fitted[0] - fitted[1] * y) <= OFF * cell
        if abs(fitted[1]) <= STEEP and 2 * numpy.sum(near) >= len(points):
            return fitted if numpy.ptp(y[near]) < 1e-9 else tuple(numpy.polyfit(y[near], x[near], 1)[::-1])
    first = numpy.min(way * x)
    return way * float(numpy.mean(way * x[way * x - first <= OFF * cell])), 0.0


def _median_line(x, y):
    i, j = numpy.triu_indices(len(x), 1)
    apart = numpy.abs(y[j] - y[i]) > 1e-9
    if not apart.any():
        return None
    slope = numpy.median((x[j] - x[i])[apart] / (y[j] - y[i])[apart])
    return numpy.median(x - slope * y), slope


def circle(points, rounds=20):
    """(x, y, radius) of least squares of distances: algebraic (Kasa 1976), then Gauss-Newton. NaN of points in a row."""
    centre = points.mean(axis=0) if len(points) else 0.0
    local = points - centre
    if len(points) < FEWEST or numpy.linalg.matrix_rank(local, tol=1e-9) < 2:
        return math.nan, math.nan, math.nan
    a, b, c = numpy.linalg.lstsq(numpy.c_[2 * local, numpy.ones(len(local))], (local ** 2).sum(axis=1), rcond=None)[0]
    guess = numpy.array([a, b, math.sqrt(max(c + a * a + b * b, 1e-12))])
    for _ in range(rounds):
        away = local - guess[:2]
        far = numpy.maximum(numpy.linalg.norm(away, axis=1), 1e-9)
        guess += numpy.linalg.lstsq(numpy.c_[away / far[:, None], numpy.ones(len(far))], far - guess[2], rcond=None)[0]
    return (*(guess[:2] + centre), guess[2])
