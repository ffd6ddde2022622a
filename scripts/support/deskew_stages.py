"""Bags of a walk through the nodelet `deskew_scan` in lock-step, by several methods at once."""
import typing

import genpy
import numpy
import yaml

from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan, PointCloud2

import stage_run
import walk_bag
from lock_step import LockStep

BETWEEN = 1000  # s between the bags, so that stamps rise: nothing is remembered from one to the next
AHEAD = 0.1  # s that odometry and inertial unit are sent beyond the end of a scan
BURST = 1000  # messages between two scans, at most
INPUTS = {walk_bag.ODOMETRY: Odometry, walk_bag.IMU: Imu, walk_bag.SCAN: LaserScan}
LISTENS = {"odometry": walk_bag.ODOMETRY, "imu": walk_bag.IMU, "vicp": None}  # to what besides the scan, by method


class Method(typing.NamedTuple):
    name: str  # as of the parameter `method`
    changes: dict  # {parameter: value}


class Deskewed(typing.NamedTuple):
    points: numpy.ndarray  # n x 3, in the scanner's frame at the stamp
    done: bool  # False: passed on raw
    scan: object  # LaserScan, its beams binned anew


class DeskewStages:
    """One nodelet for each of `methods` {name: Method}, below /NAME. The process must have a node in `session`."""

    def __init__(self, session, folder, methods):
        self.session, self.methods, self.bags, self.steps = session, methods, 0, None
        self.launches = [self._launch(folder, name, method) for name, method in methods.items()]

    def _launch(self, folder, name, method):
        config = folder / f"deskew_{name}.yaml"
        patient = {"hold_limit": 10.0}  # a slow machine must not change the score
        config.write_text(yaml.safe_dump({**stage_run.defaults("deskew_scan"), **method.changes, **patient}))
        return self.session.start(
            "env", f"ROS_NAMESPACE={name}", "roslaunch", str(stage_run.package() / "launch/deskew_scan.launch"),
            f"method:={method.name}", f"config:={config}", f"scan:={walk_bag.SCAN}", f"odom:={walk_bag.ODOMETRY}",
            f"imu:={walk_bag.IMU}")

    def play(self, walk):
        """{method: Deskewed} of each scan of the walk."""
        if not self.steps:
            self._connect(walk.static)
        self.bags += 1
        shift = genpy.Duration(BETWEEN * self.bags)
        motion = sorted(((m.header.stamp, topic, m) for topic, of_topic in walk.messages.items() if topic in self.steps.publishers
                         for m in of_topic), key=lambda entry: entry[0])
        sent = 0
        for scan in walk.scans:
            until = scan.message.header.stamp + genpy.Duration.from_sec(scan.message.scan_time + AHEAD)
            first = sent
            while sent < len(motion) and motion[sent][0] <= until:
                sent += 1
            messages = [(topic, _later(m, shift)) for _, topic, m in motion[first:sent]] + [(walk_bag.SCAN, _later(scan.message, shift))]
            stamp = scan.message.header.stamp + shift
            answer = self.steps.require(messages, {topic: stamp for name in self.methods for topic in _outputs(name)}, stage_run.PATIENCE)
            yield {name: self._deskewed(name, answer, scan.message.header.stamp) for name in self.methods}

    @staticmethod
    def _deskewed(name, answer, stamp):
        scan, points = (answer[topic] for topic in _outputs(name))
        scan.header.stamp = stamp
        return Deskewed(*walk_bag.cloud(points), scan)

    def _connect(self, static):
        methods = list(self.methods.values())
        heard = {topic: sum(LISTENS[method.name] == topic for method in methods) for topic in INPUTS}
        heard[walk_bag.SCAN] = heard["/tf_static"] = len(methods)
        self.steps = LockStep({topic: kind for topic, kind in INPUTS.items() if heard[topic]}, static,
                              {topic: kind for name in self.methods for topic, kind in _outputs(name).items()}, heard, BURST)
        self.session.require(self.steps.connected, stage_run.PATIENCE, "the stages did not start", *self.launches)

    def close(self):
        if self.steps:
            self.steps.close()
        for process in self.launches:
            self.session.end(process)


def _outputs(name):
    return {f"/{name}/scan_deskewed": LaserScan, f"/{name}/scan_points": PointCloud2}


def _later(message, shift):
    """A copy with a later stamp: the walk itself is still asked for the truth at its own."""
    kind = type(message)
    header = type(message.header)(message.header.seq, message.header.stamp + shift, message.header.frame_id)
    return kind(**{**{slot: getattr(message, slot) for slot in kind.__slots__}, "header": header})
