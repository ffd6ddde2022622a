"""Moves scans of a corridor onto their map, heading and roughly the place being known: along each axis by the faces across it."""
import numpy

import corridor_map

REACH = 4  # cells in which a point looks for its wall, to each side
FAR = 0.2  # m: a wall farther from the point is another
FEWEST = 8  # points that tell a shift
ROUNDS = 4
SPAN = 3  # points to each side that tell how a face runs
ACROSS = 0.35  # sine of the angle to the other axis up to which a face counts as lying across
NOISE, NOISE_SQUARE = 0.005, 0.0005  # m, 1/m: of a range, as config/sensors/rplidar_a3.yaml has them


class MatchedGrid:
    """A grid to which scans are added where they fit what is there."""

    def __init__(self):
        self.grid, self.offset = corridor_map.Grid(), numpy.zeros(2)  # m, from the places that are told

    def add(self, origin, ends):
        self.offset = self.offset + shift(self.grid, origin + self.offset, ends + self.offset)
        self.grid.add(origin + self.offset, ends + self.offset)


def shift(grid, origin, ends):
    """[m] By which the points, in the order of their beams, fit the map best, 0 where nothing tells."""
    step = numpy.roll(ends, -SPAN, axis=0) - numpy.roll(ends, SPAN, axis=0)
    length = numpy.linalg.norm(step, axis=1)
    occupied, out = grid.occupied(), numpy.zeros(2)
    for axis in (0, 1):
        faces = ends[(length > 0) & (length < 0.5) & (numpy.abs(step[:, axis]) < ACROSS * length)]
        ranges = numpy.linalg.norm(faces - origin, axis=1)
        out[axis] = _along(grid, occupied, faces, axis, (NOISE + NOISE_SQUARE * ranges ** 2) ** -2)
    return out


def _along(grid, occupied, points, axis, weights):
    means, moved = grid.means(axis), points.copy()
    for _ in range(ROUNDS):
        off = _to_walls(means, occupied, moved, axis)
        near = numpy.abs(off) < FAR
        if near.sum() < FEWEST:
            break
        moved[:, axis] += numpy.average(off[near], weights=weights[near])
    return moved[0, axis] - points[0, axis] if len(points) else 0.0


def _to_walls(means, occupied, points, axis):
    """[m] From each point along the axis to the hits' mean of the nearest cell that is occupied; inf without."""
    cells = numpy.floor((points - corridor_map.LOW) / corridor_map.CELL).astype(int)
    nearest = numpy.full(len(points), numpy.inf)
    for step in range(-REACH, REACH + 1):
        at = cells.copy()
        at[:, axis] += step
        inside = ((at >= 0) & (at < occupied.shape)).all(axis=1)
        x, y = numpy.where(inside[:, None], at, 0).T
        off = numpy.where(inside & occupied[x, y], means[x, y] - points[:, axis], numpy.inf)
        nearest = numpy.where(numpy.abs(off) < numpy.abs(nearest), off, nearest)
    return nearest
