"""A bag of a robot that walks with a 2-D scanner: its scans, what tells its motion, and the truth."""
import bisect
import typing

import numpy
import rosbag

import poses
from kitti_messages import fields

SCAN, ODOMETRY, IMU = "/scan/scan", "/odom", "/imu/data"
TRUE_SCAN, TRUE_POSE = f"/truth{SCAN}", "/truth/pose"
READ = (SCAN, ODOMETRY, IMU, TRUE_SCAN, TRUE_POSE, "/tf_static", "/truth/tf_static", "/truth/bodies")


class Track:
    """Poses T_frame_base of messages of odometry, between two of them in proportion."""

    def __init__(self, messages):
        self.times = [message.header.stamp.to_sec() for message in messages]
        self.poses = [message.pose.pose for message in messages]

    def covers(self, time):
        return self.times[0] <= time <= self.times[-1]

    def at(self, time):
        after = min(max(bisect.bisect_left(self.times, time), 1), len(self.times) - 1)
        t0, t1 = self.times[after - 1:after + 1]
        a, b = map(poses.of_message, self.poses[after - 1:after + 1])
        return poses.between(a, b, (time - t0) / (t1 - t0))


class Scan(typing.NamedTuple):
    message: object  # LaserScan
    begin: float  # s, when its first beam truly left; the stamp is off by the errors of the scanner's clock
    truth: object  # LaserScan: true ranges, intensities hold the body's id


class Walk(typing.NamedTuple):
    scans: list
    messages: dict  # {topic: messages} of odometry and inertial unit
    static: object  # TFMessage
    odometry: Track  # T_odom_base
    truth: Track  # T_world_base
    T_base_scan: numpy.ndarray  # as the robot believes
    T_base_scan_true: numpy.ndarray
    bodies: dict  # {id: name}


def read(file):
    kept = {topic: [] for topic in READ}
    with rosbag.Bag(str(file)) as bag:
        for topic, message, time in bag.read_messages(topics=READ):
            kept[topic].append((message, time.to_sec()))
    messages = {topic: [message for message, _ in of_topic] for topic, of_topic in kept.items()}
    odometry = Track(messages[ODOMETRY])
    scans = [Scan(scan, sent - scan.scan_time, truth) for (scan, sent), truth in zip(kept[SCAN], messages[TRUE_SCAN])
             if odometry.covers(scan.header.stamp.to_sec()) and odometry.covers(scan.header.stamp.to_sec() + 2 * scan.scan_time)]
    return Walk(scans, {topic: messages[topic] for topic in (ODOMETRY, IMU)}, messages["/tf_static"][0], odometry,
                Track(messages[TRUE_POSE]), _mount(messages["/tf_static"][0]), _mount(messages["/truth/tf_static"][0]),
                {body.id: body.name for body in messages["/truth/bodies"][0].bodies})


def _mount(static):
    found = next(t.transform for t in static.transforms if t.child_frame_id == "scan")
    return poses.matrix(found.translation, found.rotation)


def returns(scan):
    """Of a LaserScan: which beams returned, and their points n x 3 in the scanner's frame, as if it had stood still."""
    ranges = numpy.array(scan.ranges)
    seen = numpy.flatnonzero(numpy.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max))
    return seen, directions(scan)[seen] * ranges[seen, None]


def directions(scan):
    angles = scan.angle_min + scan.angle_increment * numpy.arange(len(scan.ranges))
    return numpy.stack([numpy.cos(angles), numpy.sin(angles), numpy.zeros(len(angles))], axis=1)


def cloud(message):
    """Of a PointCloud2 with x y z time: the points n x 3, and whether they are of one instant."""
    rows = fields(message, "x", "y", "z", "time")
    return rows[:, :3].astype(float), not rows[:, 3].any()
