"""How the clusters of a frame fare against its labelled bodies.

A cloud is points (n x 3, LiDAR's frame) and, for each point, the place of its cluster, UNCLUSTERED or GROUND. The
main cluster of a body is the one with the most points in its box. The body is found when its main cluster holds at
least half of the points in the box that are not ground. It is split when another cluster has most of its points in
the box. It is merged when its main cluster is that of another body too, or has 30 % of its points more than 0.5 m
beyond the box.
"""
import dataclasses
import math
import typing

import numpy

from kitti_labels import DONT_CARE, middle_azimuth

UNCLUSTERED, GROUND = -1, -2
FOUND_SHARE, MERGED_SHARE, MARGIN = 0.5, 0.3, 0.5  # -, -, m
STRAY = 0.01  # share of a body's points that may lie before its near side


class Shape(typing.NamedTuple):
    """What is known of a cluster beside its points; horizontal."""
    turned_centre: numpy.ndarray  # m, of the box turned to fit; NaN without one
    aligned_centre: numpy.ndarray  # m, of the axis-aligned box
    near_side: float  # m, from the LiDAR to the nearest of the turned box, without one of the axis-aligned


@dataclasses.dataclass
class Outcome:
    """One body in one frame. Errors are NaN where it was not found; the sign is that of estimate minus truth."""
    body: object
    points: int  # in its box
    main: int = -1
    found: bool = False
    split: bool = False
    merged: bool = False
    range_error: float = math.nan  # m, near side of the turned box, horizontal
    points_range_error: float = math.nan  # m, what 1 % of the points are nearer than, horizontal
    azimuth_error: float = math.nan  # rad, middle of what is seen
    centre_error: float = math.nan  # m, horizontal, of the box turned to fit
    aligned_centre_error: float = math.nan  # m, horizontal, of the axis-aligned box


def near_range(points):
    """[m] horizontal range that 1 % of the points are nearer than: single returns before a body have no say."""
    ranges = numpy.sort(numpy.hypot(points[:, 0], points[:, 1]))
    return ranges[int(STRAY * len(ranges))]


def turn(angle):
    """The same angle between -pi and pi."""
    return math.remainder(angle, math.tau)


def score(bodies, points, places, shapes, fewest):
    """Outcomes of the bodies with at least `fewest` points in their boxes. `shapes[place]` is the Shape
    of a cluster."""
    bodies = [body for body in bodies if body.kind != DONT_CARE]
    inside = [body.contains(points) for body in bodies]
    mains = [_main(places[box]) for box in inside]
    outcomes = []
    for body, box, main in zip(bodies, inside, mains):
        if numpy.count_nonzero(box) < fewest:
            continue
        outcome = Outcome(body, numpy.count_nonzero(box), main)
        outcomes.append(outcome)
        if main < 0:
            continue
        mine = places == main
        outcome.found = numpy.count_nonzero(mine & box) >= FOUND_SHARE * numpy.count_nonzero(places[box] != GROUND)
        outcome.split = any(_mostly(box[places == other]) for other in set(places[box]) - {main, UNCLUSTERED, GROUND})
        beyond = numpy.count_nonzero(~body.contains(points[mine], MARGIN))
        outcome.merged = mains.count(main) > 1 or beyond >= MERGED_SHARE * numpy.count_nonzero(mine)
        if outcome.found:
            _measure(outcome, points[mine], shapes[main])
    return outcomes


def _main(places):
    """The most frequent cluster, the lowest of equals; -1 where there is none."""
    clusters, counts = numpy.unique(places[places >= 0], return_counts=True)
    return int(clusters[counts.argmax()]) if len(clusters) else -1


def _mostly(holds):
    return 2 * numpy.count_nonzero(holds) > len(holds)


def _measure(outcome, points, shape):
    body = outcome.body
    outcome.range_error = shape.near_side - body.nearest_range()
    outcome.points_range_error = near_range(points) - body.nearest_range()
    outcome.azimuth_error = turn(middle_azimuth(points) - body.azimuth())
    outcome.centre_error = math.dist(shape.turned_centre, body.centre[:2])
    outcome.aligned_centre_error = math.dist(shape.aligned_centre, body.centre[:2])


def places_of(cloud, obstacle_points, clustered, cluster_places):
    """The places for `cloud` (n x 3 float32): where each of its points, told by its coordinates, stands among
    `clustered` (m x 3, with their clusters), else whether it is among `obstacle_points`."""
    known = dict.fromkeys(_keys(obstacle_points), UNCLUSTERED)
    known.update(zip(_keys(clustered), cluster_places))
    return numpy.array([known.get(key, GROUND) for key in _keys(cloud)], int)


def _keys(points):
    data = numpy.ascontiguousarray(points, numpy.float32).tobytes()
    return [data[i:i + 12] for i in range(0, len(data), 12)]
