"""Which points of a cloud are ground, by a slow and independent way, to score a fast one.

Seen from above the cloud is cut into cells of 1 m. Ground begins in the cells within 10 m of the LiDAR that hold
points within 0.3 m of the height where the car's wheels stand. It grows outwards from cell to cell: among the points
of a new cell within 0.15 m of the mean height of the ground cells about it, the lowest is that cell's ground. The
cells about it are those next to it; only when nothing grows any more, those up to two and then four cells away, as
the rings of a LiDAR lie apart. So it follows slopes and kerbs, and neither climbs a body nor sinks into mirror images
below the road. A point within 0.1 m of its cell's ground is ground: also the lowest centimetres of walls, hedges and
bodies without a label, so that even the best clusters hold a few.
"""
import numpy

CELL = 1.0  # m
HALF_SIDE = 60.0  # m of the square that is looked at
SEED_RANGE, SEED_STEP = 10.0, 0.3  # m
STEP = 0.15  # m, from cell to cell
THICKNESS = 0.1  # m, about the cell's ground
REACHES = (1, 2, 4)  # cells


def is_ground(points, lidar_height):
    """For points (n x 3) in the LiDAR's frame; `lidar_height` [m] above the ground below it."""
    count = int(2 * HALF_SIDE / CELL)
    cells = numpy.floor((points[:, :2] + HALF_SIDE) / CELL).astype(int)
    inside = ((cells >= 0) & (cells < count)).all(axis=1)
    cell, height = (cells[inside] * [count, 1]).sum(axis=1), points[inside, 2].astype(float)
    near = numpy.hypot(*points[inside, :2].T) < SEED_RANGE

    grid = numpy.full(count * count, numpy.inf)  # height of the ground, inf where it is not known
    _lower(grid, cell, height, near & (numpy.abs(height + lidar_height) < SEED_STEP))
    reach = 0
    while reach < len(REACHES):
        around = _mean_around(grid.reshape(count, count), REACHES[reach]).ravel()
        fits = numpy.isinf(grid[cell]) & (numpy.abs(height - around[cell]) <= STEP)
        _lower(grid, cell, height, fits)
        reach = 0 if fits.any() else reach + 1
    ground = numpy.zeros(len(points), bool)
    ground[inside] = numpy.abs(height - grid[cell]) <= THICKNESS
    return ground


def _lower(grid, cell, height, which):
    numpy.minimum.at(grid, cell[which], height[which])


def _mean_around(grid, reach):
    """Of the known cells in the square of `reach` cells to each side; NaN where none is known."""
    known = numpy.isfinite(grid)
    total, number = (_box_sum(values, reach) for values in (numpy.where(known, grid, 0.0), known.astype(float)))
    return total / numpy.where(number > 0.5, number, numpy.nan)


def _box_sum(values, reach):
    """Sum over that square about each cell, one axis after the other."""
    for axis in (0, 1):
        padding = [(reach + 1, reach) if a == axis else (0, 0) for a in (0, 1)]
        running = numpy.cumsum(numpy.pad(values, padding), axis=axis)
        side, length = 2 * reach + 1, values.shape[axis]
        values = numpy.take(running, range(side, side + length), axis) - numpy.take(running, range(length), axis)
    return values
