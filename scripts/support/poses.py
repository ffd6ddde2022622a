"""Rigid motions as 4 x 4 matrices T_target_source."""
import math

import numpy


def vector(message):
    return numpy.array([message.x, message.y, message.z])


def length(message):
    return float(numpy.linalg.norm(vector(message)))


def matrix(position, q):
    """Of a position and a unit quaternion, messages."""
    x, y, z, w = q.x, q.y, q.z, q.w
    T = numpy.eye(4)
    T[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    T[:3, 3] = vector(position)
    return T


def of_message(pose):
    return matrix(pose.position, pose.orientation)


def planar(x, y, yaw):
    T = numpy.eye(4)
    c, s = math.cos(yaw), math.sin(yaw)
    T[:2, :2], T[:2, 3] = [[c, -s], [s, c]], (x, y)
    return T


def level(T):
    """The same without height, pitch and roll."""
    return planar(*flat(T))


def between(a, b, share):
    """Near a, on the way to b that turns by less than 90 degrees: exact for share 0 and 1."""
    T = a + share * (b - a)
    u, _, v = numpy.linalg.svd(T[:3, :3])  # the nearest rotation
    T[:3, :3] = u @ v
    return T


def apply(T, points):
    """n x 3."""
    return points @ T[:3, :3].T + T[:3, 3]


def apply_flat(T, points):
    """n x 2: of points at height 0, as seen from above."""
    return apply(T, numpy.c_[points, numpy.zeros(len(points))])[:, :2]


def flat(T):
    """x, y and yaw of a pose in space, as the robot's transforms tell them to a stage in the plane."""
    return (*T[:2, 3], yaw(T))


def yaw(T):
    """[rad]"""
    return math.atan2(T[1, 0], T[0, 0])


def polar(p):
    """(slant range [m], azimuth [rad], elevation [rad])."""
    return float(numpy.linalg.norm(p)), math.atan2(p[1], p[0]), math.atan2(p[2], math.hypot(p[0], p[1]))


def chart(found, truth):
    """(turn [rad], shift [m]) x with truth = found * motion(x), as the calibrations' covariances are of."""
    step = numpy.linalg.inv(found) @ truth
    axis = numpy.array([step[2, 1] - step[1, 2], step[0, 2] - step[2, 0], step[1, 0] - step[0, 1]]) / 2
    sine = numpy.linalg.norm(axis)
    angle = math.atan2(sine, (numpy.trace(step[:3, :3]) - 1) / 2)
    return numpy.concatenate([axis * (angle / sine if sine > 0 else 1.0), step[:3, 3]])
