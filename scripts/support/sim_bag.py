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
KEPT = 5  # pictures that wait for their cloud


class Frame(typing.NamedTuple):
    """Of one cloud. What is true is in the LiDAR's true frame at the cloud's stamp."""
    stamp: object
    inputs: dict  # {topic: message} for the stages
    points: numpy.ndarray  # POINT, of every return: x y z as measured
    bodies: dict  # {id: Body}
    detections: object  # ImageDetectionArray: what the picture truly shows; None without picture
    labels: object  # rows x columns: id of each pixel's body, -1 none; None where the bag has none


class Body(typing.NamedTuple):
    name: str
    label: str
    T_lidar_box: numpy.ndarray  # 4 x 4, of the middle of its box
    size: numpy.ndarray  # m, of the box
    ground: float  # m, height of the box's middle over the world's z = 0


class Picture(typing.NamedTuple):
    info: object
    image: object
    detections: object
    labels: object


def frames(bag_file, pictures, shift=0):
    """Frames in their order. With `pictures` the images are among the inputs. All stamps are `shift` whole seconds
    later than in the bag."""
    reader = _Reader(shift)
    topics = {"/tf_static", "/truth/tf_static", "/truth/pose", "/truth/bodies", "/lidar/points", "/truth/lidar/points",
              "/camera/camera_info", "/truth/camera/detections", "/truth/camera/labels"}
    with rosbag.Bag(str(bag_file)) as bag:
        for topic, message, _ in bag.read_messages(topics=sorted(topics | ({"/camera/image_raw"} if pictures else set()))):
            frame = reader.take(topic, message)
            if frame:
                yield frame


def static_transforms(bag_file):
    with rosbag.Bag(str(bag_file)) as bag:
        return next(message for _, message, _ in bag.read_messages(topics=["/tf_static"]))


class _Reader:
    def __init__(self, shift):
        self.shift, self.mount = genpy.Duration(shift), None
        self.poses, self.points = [], {}
        self.bodies = collections.deque(maxlen=KEPT)
        self.pictures = collections.defaultdict(dict)  # {stamp: {topic: message}}

    def take(self, topic, message):
        """The frame that this message completes, else None."""
        if topic.endswith("tf_static"):  # the true one, where there is one, comes last
            self.mount = next(poses.matrix(t.transform.translation, t.transform.rotation)
                              for t in message.transforms if t.child_frame_id == "lidar")
            return None
        message.header.stamp += self.shift
        if topic == "/truth/pose":
            self.poses.append((message.header.stamp.to_sec(), message.pose.pose))
        elif topic == "/truth/bodies":
            self.bodies.append(message)
        elif topic == "/truth/lidar/points":
            self.points[message.header.stamp] = numpy.frombuffer(message.data, POINT)
        elif topic == "/lidar/points":
            return self._frame(message)
        else:
            self.pictures[message.header.stamp][topic] = message
            while len(self.pictures) > KEPT:
                del self.pictures[min(self.pictures)]
        return None

    def _frame(self, cloud):
        stamp = cloud.header.stamp
        near = min(self.pictures, key=lambda other: abs((other - stamp).to_sec()), default=None)
        picture = self.pictures[near] if near and abs((near - stamp).to_sec()) <= FARTHEST else {}
        inputs = {topic: picture[topic] for topic in ("/camera/camera_info", "/camera/image_raw") if topic in picture}
        labels = picture.get("/truth/camera/labels")
        return Frame(stamp, {**inputs, "/lidar/points": cloud}, self.points.pop(stamp), self._bodies(stamp.to_sec()),
                     picture.get("/truth/camera/detections"), labels and _ids(labels))

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


def _ids(labels):
    return numpy.frombuffer(labels.data, numpy.uint16).reshape(labels.height, labels.width).astype(int) - 1
