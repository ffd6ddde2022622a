"""The length of a corridor along x, read from an occupancy grid as the quadruped paper does: at three places, and their mean."""
import math

import numpy

import grids

STRIPS = {"top": 0.6, "middle": 0.0, "bottom": -0.6}  # m, y of the three places where the paper measures
STRIP_WIDTH = 0.4  # m
END = 14.0  # m from the middle: what is occupied beyond is an end wall


class Map:
    """`grid`: nav_msgs/OccupancyGrid. `start`: where the map's origin lies in the corridor, whose middle is 0 [m]."""

    def __init__(self, grid, start):
        info = grid.info
        self.cells = grids.cells(grid)
        self.side = info.resolution
        self.low = numpy.array([info.origin.position.x, info.origin.position.y]) + start

    def lengths(self):
        """[m] {strip: from one end wall to the other}, NaN where a wall is not in the map."""
        return {name: self._wall(middle, 1) - self._wall(middle, -1) for name, middle in STRIPS.items()}

    def extent(self):
        """[m] (left, right, bottom, top)"""
        high = self.low + self.side * numpy.array(self.cells.shape[::-1])
        return self.low[0], high[0], self.low[1], high[1]

    def _wall(self, middle, side):
        """x of an end wall in a strip: of the line through its face there, where the strip has its middle. The face are the innermost
        cells: what was seen from afar lies scattered behind."""
        rows, columns = numpy.nonzero(self.cells >= grids.OCCUPIED)
        x, y = (self.low[axis] + self.side * (index + 0.5) for axis, index in ((0, columns), (1, rows)))
        of_wall = (side * x > END) & (numpy.abs(y - middle) <= STRIP_WIDTH / 2)
        face = {}
        for row, at_x, at_y in zip(rows[of_wall], x[of_wall], y[of_wall]):
            if row not in face or side * at_x < side * face[row][0]:
                face[row] = at_x, at_y
        if len(face) < 3:
            return math.nan
        x, y = numpy.array(list(face.values())).T
        return float(numpy.polyval(numpy.polyfit(y - middle, x, 1), 0.0))


def mean_length(lengths):
    return sum(lengths.values()) / len(lengths)
