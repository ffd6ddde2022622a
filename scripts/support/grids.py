"""Cells of a nav_msgs/OccupancyGrid."""
import numpy

OCCUPIED = 50  # percent, from which a cell is


def cells(grid):
    """Rows x columns of percent; -1: unknown."""
    return numpy.array(grid.data, numpy.int8).reshape(grid.info.height, grid.info.width)


def middles(grid, which):
    """n x 2 [m], in the map: of the cells that are true in `which` (rows x columns)."""
    rows, columns = numpy.nonzero(which)
    low = numpy.array([grid.info.origin.position.x, grid.info.origin.position.y])
    return low + grid.info.resolution * (numpy.c_[columns, rows] + 0.5)
