"""A bag of make_bag, cloud by cloud, with what is true at each."""
import bisect
import collections
import typing

import genpy
import numpy
import rosbag

import poses

POINT = numpy.dtype([("x", "f4"), ("y", "f4"), ("z", "f4"), ("body", "i4"), ("range", "f4")])  # of truth/.../points
FARTHEST = 0.05  # s between a cloud and the picture that goes with it
KEPT = 10  # pictures that wait for their cloud
IMAGE = "/camera/image_raw"
PARTS = ("/camera/camera_info", IMAGE, "/truth/camera/detections", "/truth/camera/labels")  # of a picture
SENSED = ("/tf_static", "/truth/tf_static", "/truth/pose", "/truth/bodies", "/lidar/points", "/truth/lidar/points")


class Frame(typing.NamedTuple):
    """Of one cloud. What is true is in the LiDAR's true frame at the cloud's stamp."""
    stamp: object
    cloud: object  # PointCloud2
    pictures: list  # that came since the cloud before, in their order
    picture: object  # the nearest in time; None without
    points: numpy.ndarray  # POINT, of every return: x y z as measured
    bodies: dict  # {id: Body}


class Picture(typing.NamedTuple):
    stamp: object
    info: object
    image: object  # None where images were not asked for
    detections: object  # ImageDetectionArray: what it truly shows
    labels: object  # Image: id + 1 of each pixel's body; None where the bag has none

    def ids(self):
        """Rows x columns: id of each pixel's body, -1 none."""
        return numpy.frombuffer(self.labels.data, numpy.uint16).reshape(self.labels.height, self.labels.width).astype(int) - 1


class Body(typing.NamedTuple):
    name: str
    label: str
    T_lidar_box: numpy.ndarray  # 4 x 4, of the middle of its box
    size: numpy.ndarray  # m, of the box
    ground: float  # m, height of the box's middle over the world's z = 0


def frames(bag_file, images, shift=0):
    """Frames in their order, each when the first picture not before its cloud is in: it may be the nearest, and stages wait
    for it. Pictures have an image where `images` are asked for. All stamps are `shift` whole seconds later than in the bag."""
    with rosbag.Bag(str(bag_file)) as bag:
        there = bag.get_type_and_topic_info().topics.keys()
        wanted = {topic for topic in PARTS if topic in there and (images or topic != IMAGE)}
        reader = _Reader(shift, wanted)
        for topic, message, _ in bag.read_messages(topics=[*SENSED, *sorted(wanted)]):
            reader.take(topic, message)
            yield from reader.complete()
        yield from reader.rest()


def static_transforms(bag_file):
    with rosbag.Bag(str(bag_file)) as bag:
        return next(message for _, message, _ in bag.read_messages(topics=["/tf_static"]))


def true_transform(bag_file, target, source):
    """T_target_source by where the mounts truly are."""
    return _transform(bag_file, "/truth/tf_static", target, source)


def nominal_transform(bag_file, target, source):
    """T_target_source by where the mounts are said to be."""
    return _transform(bag_file, "/tf_static", target, source)


def _transform(bag_file, topic, target, source):
    with rosbag.Bag(str(bag_file)) as bag:
        return chained([t for _, message, _ in bag.read_messages(topics=[topic]) for t in message.transforms], target, source)


def chained(transforms, target, source):
    """T_target_source: all frames hang on the base by a chain."""
    parents = {t.child_frame_id: (t.header.frame_id, poses.matrix(t.transform.translation, t.transform.rotation))
               for t in transforms}

    def in_base(frame):
        T = numpy.eye(4)
        while frame in parents:
            frame, T_parent_frame = parents[frame]
            T = T_parent_frame @ T
        return T

    return numpy.linalg.inv(in_base(target)) @ in_base(source)


class _Reader:
    def __init__(self, shift, wanted):
        self.shift, self.wanted, self.mount = genpy.Duration(shift), wanted, None
        self.poses, self.points, self.fresh, self.parts = [], {}, [], {}
        self.bodies, self.pictures = collections.deque(maxlen=KEPT), collections.deque(maxlen=KEPT)
        self.clouds = collections.deque()  # without a frame

    def complete(self):
        while self.clouds and (not self.wanted or (self.pictures and self.pictures[-1].stamp >= self.clouds[0].header.stamp)):
            yield self._frame(self.clouds.popleft())

    def rest(self):
        while self.clouds:
            yield self._frame(self.clouds.popleft())

    def take(self, topic, message):
        if topic.endswith("tf_static"):  # the true one comes last
            self.mount = next(poses.matrix(t.transform.translation, t.transform.rotation)
                              for t in message.transforms if t.child_frame_id == "lidar")
            return
        message.header.stamp += self.shift
        if topic == "/truth/pose":
            self.poses.append((message.header.stamp.to_sec(), message.pose.pose))
        elif topic == "/truth/bodies":
            self.bodies.append(message)
        elif topic == "/truth/lidar/points":
            self.points[message.header.stamp] = numpy.frombuffer(message.data, POINT)
        elif topic == "/lidar/points":
            self.clouds.append(message)
        else:
            self.parts[topic] = message
            if self.wanted <= self.parts.keys():
                self._picture(message.header.stamp)

    def _picture(self, stamp):
        picture = Picture(stamp, *map(self.parts.get, PARTS))
        self.parts = {}
        self.fresh.append(picture)
        self.pictures.append(picture)

    def _frame(self, cloud):
        stamp = cloud.header.stamp
        off = lambda picture: abs((picture.stamp - stamp).to_sec())
        near = min(self.pictures, key=off, default=None)
        fresh, self.fresh = self.fresh, []
        return Frame(stamp, cloud, fresh, near if near and off(near) <= FARTHEST else None, self.points.pop(stamp),
                     self._bodies(stamp.to_sec()))

    def _bodies(self, time):
        T_lidar_world = numpy.linalg.inv(self._base(time) @ self.mount)
        message = min(self.bodies, key=lambda other: abs(other.header.stamp.to_sec() - time))
        since = time - message.header.stamp.to_sec()
        out = {}
        for body in message.bodies:
            T_world_box = poses.of_message(body.pose)
            T_world_box[:3, 3] += since * poses.vector(body.velocity)
            out[body.id] = Body(body.name, body.label, T_lidar_world @ T_world_box, poses.vector(body.size),
                                T_world_box[2, 3])
        return out

    def _base(self, time):
        """T_world_base, between two of the poses in proportion."""
        place = bisect.bisect_left([t for t, _ in self.poses], time - 1e-6)
        if place == 0 or abs(self.poses[place][0] - time) < 1e-6:
            return poses.of_message(self.poses[place][1])
        (t0, before), (t1, after) = self.poses[place - 1:place + 1]
        return poses.between(poses.of_message(before), poses.of_message(after), (time - t0) / (t1 - t0))

