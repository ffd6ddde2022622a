"""The simplest mapping: a grid of hits and visits at places that are given, and the length of a corridor read from it."""
import math

import numpy

CELL = 0.05  # m
LOW, HIGH = numpy.array([-18.0, -4.0]), numpy.array([18.0, 4.0])  # m, of the map
OCCUPIED = 0.25  # hits / visits, as Gmapping has it
LEVEL = 0.3  # m: what lies farther above or below the scanner is floor, or where a tilted beam went
STRIPS = {"top": 0.6, "middle": 0.0, "bottom": -0.6}  # m, y of the three places where the paper measures
STRIP_WIDTH = 0.4  # m
END = 14.0  # m from the middle: what is occupied beyond is an end wall


def level(T_map_scan, points):
    """The place of the scanner, and of the points that are about as high as it, in the map."""
    in_map = points @ T_map_scan[:3, :3].T + T_map_scan[:3, 3]
    return T_map_scan[:2, 3], in_map[numpy.abs(in_map[:, 2] - T_map_scan[2, 3]) <= LEVEL, :2]


class Grid:
    def __init__(self):
        self.shape = tuple(numpy.round((HIGH - LOW) / CELL).astype(int))  # along x, along y
        self.hits, self.visits = numpy.zeros(self.shape), numpy.zeros(self.shape)
        self.sums = numpy.zeros((2, *self.shape))  # of x and y of the hits

    def add(self, origin, ends):
        """Of beams from one place to the points where they ended, n x 2."""
        hits = self._cells(ends)
        inside = hits >= 0
        for counts, values in ((self.hits, 1.0), (self.visits, 1.0), (self.sums[0], ends[inside, 0]), (self.sums[1], ends[inside, 1])):
            numpy.add.at(counts.reshape(-1), hits[inside], values)
        self._pass(origin, ends, hits)

    def _pass(self, origin, ends, last):
        """Each cell that a beam crosses counts once; the one where it ends has been counted."""
        ways = ends - origin
        steps = numpy.maximum(1, numpy.ceil(2 * numpy.linalg.norm(ways, axis=1) / CELL).astype(int))
        beam = numpy.repeat(numpy.arange(len(ends)), steps)
        place = numpy.arange(len(beam)) - numpy.repeat(numpy.cumsum(steps) - steps, steps)
        cells = self._cells(origin + ways[beam] * ((place + 0.5) / steps[beam])[:, None])
        new = numpy.ones(len(cells), bool)
        new[1:] = (cells[1:] != cells[:-1]) | (beam[1:] != beam[:-1])
        crossed = cells[new & (cells >= 0) & (cells != last[beam])]
        self.visits += numpy.bincount(crossed, minlength=self.visits.size).reshape(self.shape)

    def _cells(self, points):
        """Index of each point's cell, -1 outside the map."""
        at = numpy.floor((points - LOW) / CELL).astype(int)
        inside = ((at >= 0) & (at < self.shape)).all(axis=1)
        return numpy.where(inside, at[:, 0] * self.shape[1] + at[:, 1], -1)

    def occupied(self):
        return (self.hits > 0) & (self.hits >= OCCUPIED * self.visits)

    def means(self, axis):
        """Of the hits in each cell."""
        return self.sums[axis] / numpy.maximum(self.hits, 1)

    def length(self):
        """[m] {strip: from one end wall to the other}, NaN where a wall is not in the map."""
        return {name: self._wall(middle, 1) - self._wall(middle, -1) for name, middle in STRIPS.items()}

    def _wall(self, middle, side):
        """x of an end wall in a strip: of the line through its hits there, where the strip has its middle."""
        x, y = (LOW[axis] + CELL * (numpy.arange(self.shape[axis]) + 0.5) for axis in (0, 1))
        of_wall = self.occupied() & (side * x > END)[:, None] & (numpy.abs(y - middle) <= STRIP_WIDTH / 2)[None, :]
        columns, rows = numpy.nonzero(of_wall)
        if len(set(rows)) < 3:
            return math.nan
        weights = numpy.sqrt(self.hits[columns, rows])  # polyfit squares them
        return float(numpy.polyval(numpy.polyfit(y[rows] - middle, x[columns], 1, w=weights), 0.0))


def mean_length(lengths):
    return sum(lengths.values()) / len(lengths)
