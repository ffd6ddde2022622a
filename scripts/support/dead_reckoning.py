"""Where a walking scanner is by its odometry's steps, the heading being known."""
import math

import numpy

import poses


def places(walk):
    """T_map_scan at the stamp of each scan; the map begins as the world does. Steps, roll and pitch are the odometry's, the
    yaw is true, so that a turn of the odometry does not bend the map."""
    at, last, out = None, None, []
    for scan in walk.scans:
        T_odom_base = walk.odometry.at(scan.message.header.stamp.to_sec())
        T_world_base = walk.truth.at(scan.begin)
        right = _turn(poses.yaw(T_world_base) - poses.yaw(T_odom_base))
        at = T_world_base[:3, 3] if at is None else at + right @ (T_odom_base[:3, 3] - last)
        last = T_odom_base[:3, 3]
        T_map_base = numpy.eye(4)
        T_map_base[:3, :3], T_map_base[:3, 3] = right @ T_odom_base[:3, :3], at
        out.append(T_map_base @ walk.T_base_scan)
    return out


def _turn(yaw):
    c, s = math.cos(yaw), math.sin(yaw)
    return numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
