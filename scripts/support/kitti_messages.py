"""What the stages publish, as arrays."""
import math

import numpy

from body_score import Shape
from kitti_labels import box_range
from poses import vector


def fields(cloud, *names):
    """Of a PointCloud2 of float32: one row a point, one column a field."""
    offsets = {field.name: field.offset for field in cloud.fields}
    layout = numpy.dtype({"names": names, "formats": ["<f4"] * len(names), "offsets": [offsets[name] for name in names],
                          "itemsize": cloud.point_step})
    points = numpy.frombuffer(cloud.data, layout, cloud.width * cloud.height)
    return numpy.stack([points[name] for name in names], axis=1)


def xyz(cloud):
    return fields(cloud, *"xyz")


class Clusters:
    """Of a ClusterArray: `points` (n x 3, float32), `places` of their clusters, `arrays` the points of each. Faint
    clusters, which come last, have points only: they are no bodies by themselves."""

    def __init__(self, message):
        self.messages = message.clusters
        self.points = numpy.array([(p.x, p.y, p.z) for p in message.points], numpy.float32).reshape(-1, 3)
        self.arrays = [self.points[c.first_point:c.first_point + c.point_count] for c in self.messages]
        self.places = numpy.full(len(self.points), -1)
        bodies = [cluster for cluster in self.messages if not cluster.faint]
        for place, cluster in enumerate(bodies):
            self.places[cluster.first_point:cluster.first_point + cluster.point_count] = place

        self.shapes = [_shape(cluster) for cluster in bodies]


def _shape(cluster):
    turned, aligned = vector(cluster.box_centre), vector(cluster.centre)
    ahead, left = math.cos(cluster.box_yaw), math.sin(cluster.box_yaw)
    near_side = box_range(turned, vector(cluster.box_size), numpy.array([[ahead, left], [-left, ahead]]))
    if math.isnan(near_side):
        near_side = box_range(aligned, vector(cluster.max) - vector(cluster.min), numpy.eye(2))
    return Shape(turned[:2], aligned[:2], near_side)


def shares_cluster(obstacle, obstacles):
    """Whether its cluster serves several obstacles."""
    return sum(other.cluster_id == obstacle.cluster_id for other in obstacles) > 1


def lidar_points(obstacle, obstacles, clusters):
    """The points of an obstacle; None where the camera alone sees it. Of a cluster that serves several obstacles it
    has those in its box."""
    if obstacle.cluster_id < 0:
        return None
    points = numpy.concatenate([clusters.arrays[place] for place in (obstacle.cluster_id, *obstacle.joined_clusters)])
    if shares_cluster(obstacle, obstacles):
        inside = numpy.abs(points - vector(obstacle.position)) <= vector(obstacle.size) / 2 + 1e-3
        points = points[inside.all(axis=1)]
    return points
