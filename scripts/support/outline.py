"""The true outline of a body over the ground: an upright cylinder for what is round, else its box."""
import numpy

import poses

ROUND = {"cage", "buoy", "bollard", "cone", "ball", "stool"}


def span(body):
    """Heights [m] in the box's frame between which it stands over the ground, or over the water."""
    half = body.size[2] / 2
    return min(half, max(-half, -body.ground)), half


def middle(body):
    """In the LiDAR's frame."""
    return poses.apply(body.T_lidar_box, numpy.array([0.0, 0.0, sum(span(body)) / 2]))


def face_range(body):
    """[m] from the LiDAR to the nearest point of the outline."""
    x, y, z = poses.apply(numpy.linalg.inv(body.T_lidar_box), numpy.zeros(3))
    if body.label in ROUND:
        away = [numpy.hypot(x, y) - body.size[0] / 2]
    else:
        away = [abs(x) - body.size[0] / 2, abs(y) - body.size[1] / 2]
    low, high = span(body)
    return float(numpy.linalg.norm([*numpy.maximum(away, 0.0), max(low - z, 0.0, z - high)]))
