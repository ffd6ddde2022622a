"""A map of the quadruped against the bodies that truly stand there."""
import typing

import genpy
import numpy
import rosbag

import grids
import poses

NEAR = 1.0  # [cells] round a body's box within which a cell shows it


class Body(typing.NamedTuple):
    name: str
    label: str  # empty: part of the surroundings
    T_world_box: numpy.ndarray  # 4 x 4
    size: numpy.ndarray  # m

    def distance(self, points):
        """[m] of points n x 2 in the world from the box as seen from above; 0 inside."""
        local = numpy.abs(poses.apply_flat(numpy.linalg.inv(self.T_world_box), points))
        return numpy.linalg.norm(numpy.maximum(local - self.size[:2] / 2, 0.0), axis=1)


def bodies(bag_file):
    """Those of the start; nothing moves in these worlds."""
    with rosbag.Bag(str(bag_file)) as bag:
        first = next(message for _, message, _ in bag.read_messages(topics=["/truth/bodies"]))
    return [Body(b.name, b.label, poses.of_message(b.pose), poses.vector(b.size)) for b in first.bodies]


def world_of_map(bag_file, path):
    """T_world_map: where the robot truly was at the first pose of the path, with that pose."""
    start = path.poses[0]
    with rosbag.Bag(str(bag_file)) as bag:
        truth = min((m for _, m, _ in bag.read_messages(topics=["/truth/pose"], end_time=start.header.stamp + genpy.Duration(1))),
                    key=lambda m: abs((m.header.stamp - start.header.stamp).to_sec()))
    return poses.level(poses.of_message(truth.pose.pose)) @ numpy.linalg.inv(poses.of_message(start.pose))


def occupied(grid, T_world_map):
    """n x 2: middles of the occupied cells, in the world."""
    return poses.apply_flat(T_world_map, grids.middles(grid, grids.cells(grid) >= grids.OCCUPIED))


def shown(points, body, others, near):
    """Whether one of the points is nearer than `near` to the body and to no other."""
    own = body.distance(points)
    rest = numpy.min([other.distance(points) for other in others], axis=0)
    return bool(numpy.any((own <= near) & (own < rest)))


def found(points, all_bodies, resolution):
    """Names of the labelled bodies that the points show."""
    return [body.name for body in all_bodies if body.label
            and shown(points, body, [other for other in all_bodies if other is not body], NEAR * resolution)]
