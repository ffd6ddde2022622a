"""How well points or occupied cells draw the outline of a body, as seen from above. All in one frame, n x 2 [m]."""
import math
import typing

import numpy
from scipy.spatial import cKDTree

NEAR = 0.25  # m: what is farther from a body's box belongs to none
CLOSE = 1.5  # cells from the middle of one within which a place of the outline is drawn


class Score(typing.NamedTuple):
    points: int  # of the contour
    error: float  # m, their mean distance to the true outline; NaN of none
    completeness: float  # share of the outline that could be seen which is drawn; NaN where nothing could


def contour(points, cell):
    """Those in a cell beside an empty one: what is within, such as the top of a box that is seen from above, is no contour."""
    if not len(points):
        return points
    place = numpy.floor(points / cell).astype(int)
    full = set(map(tuple, place))
    edge = {(x, y) for x, y in full if not {(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)} <= full}
    return points[[tuple(at) in edge for at in place]]


def of_bodies(points, bodies):
    """[index of the nearest of `bodies` (with `distance(points)`) for each point, -1: none is near]"""
    if not len(points):
        return numpy.zeros(0, int)
    away = numpy.array([body.distance(points) for body in bodies])
    return numpy.where(away.min(axis=0) <= NEAR, away.argmin(axis=0), -1)


def score(points, outline, seen, cell):
    """Of the `points` of one body: against its `outline`, and against what of it some sensor could see."""
    drawn = contour(points, cell)
    error = float(cKDTree(outline).query(drawn)[0].mean()) if len(drawn) and len(outline) else math.nan
    if not len(seen):
        return Score(len(drawn), error, math.nan)
    if not len(points):
        return Score(0, error, 0.0)
    return Score(len(drawn), error, float(numpy.mean(cKDTree(points).query(seen)[0] <= CLOSE * cell)))
