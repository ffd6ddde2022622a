"""The nodelet grid_slam fed from a bag, one scan at a time, and what it says where the robot was."""
import bisect
import math
import os
import time
import xmlrpc.client

from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import OccupancyGrid, Path
from rosgraph import Master
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
import genpy
import numpy
import rosbag
import rospy

import stage_run
from lock_step import MapSteps
from ros_session import RosSession, SessionError

NAME = "slam"
SCANS, MAP, PATH = f"/{NAME}/scan", f"/{NAME}/map", f"/{NAME}/path"
TICK = os.sysconf("SC_CLK_TCK")


class SlamSteps(MapSteps):
    """Its answer to a scan is the transform that it sends for it, `delay` after the scan's stamp. Stamps rise from bag to bag,
    so that no old transform is taken for a new one."""

    def __init__(self, static, delay):
        self.delay = genpy.Duration.from_sec(delay)
        super().__init__({"/tf": TFMessage, SCANS: LaserScan}, static, {"/tf": TFMessage},
                         listeners={"/tf": 2})  # this process is one of them

    def scan(self, transform, scan):
        """[s] of wall time until it is taken in."""
        began = time.monotonic()
        stamp = scan.header.stamp
        self.require([("/tf", transform), (SCANS, scan)], {"/tf": stamp + self.delay}, stage_run.PATIENCE)
        return time.monotonic() - began


class Usage:
    """CPU time [s] and peak memory [MB] of a node's process."""

    def __init__(self, session, node):
        uri = Master("/reproduce").lookupNode(node)
        self.pid = xmlrpc.client.ServerProxy(uri).getPid("/reproduce")[2]

    def cpu(self):
        with open(f"/proc/{self.pid}/stat") as file:
            words = file.read().rpartition(")")[2].split()
        return (int(words[11]) + int(words[12])) / TICK

    def peak(self):
        with open(f"/proc/{self.pid}/status") as file:
            return next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) / 1024.0


class Run:
    """`poses`: [(stamp [ns], [x, y, yaw])] of the robot at each scan: between those that the best path has, odometry goes on.
    `grid`: the last map. `scans`: how many were taken in. `cpu_ms`: of each of these, the whole process."""

    def __init__(self, poses, grid, scans, cpu_ms, peak_mb):
        self.poses, self.grid, self.scans, self.cpu_ms, self.peak_mb = poses, grid, scans, cpu_ms, peak_mb


def pairs(bag_file, scan_topic, every):
    """(odom to base, scan) of every so many scans; odometry interpolated at the scan's stamp."""
    with rosbag.Bag(str(bag_file)) as bag:
        odometry = [(m.header.stamp.to_nsec(), m.pose.pose) for _, m, _ in bag.read_messages(topics=["/odom"])]
        stamps = [stamp for stamp, _ in odometry]
        scans = [m for _, m, _ in bag.read_messages(topics=[scan_topic])]
    for scan in scans[::every]:
        at = scan.header.stamp.to_nsec()
        after = bisect.bisect_left(stamps, at)
        if after == len(stamps) or (after == 0 and stamps[0] != at):
            continue  # before the first or after the last that the odometry tells
        yield _between(odometry[max(0, after - 1)], odometry[after], at), scan


def planar(pose):
    return numpy.array([pose.position.x, pose.position.y, 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)])


def compose(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    return numpy.array([a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2]])


def between(a, b):
    c, s = math.cos(a[2]), math.sin(a[2])
    x, y = b[0] - a[0], b[1] - a[1]
    return numpy.array([c * x + s * y, -s * x + c * y, b[2] - a[2]])


def _between(before, after, at):
    a, b = planar(before[1]), planar(after[1])
    share = 1.0 if after[0] == before[0] else (at - before[0]) / (after[0] - before[0])
    turn = math.remainder(b[2] - a[2], 2.0 * math.pi)
    return numpy.array([*(a[:2] + share * (b[:2] - a[:2])), a[2] + share * turn])


def _transform(pose, stamp):
    message = TFMessage(transforms=[TransformStamped()])
    entry = message.transforms[0]
    entry.header.stamp, entry.header.frame_id, entry.child_frame_id = stamp, "odom", "base"
    entry.transform.translation.x, entry.transform.translation.y = pose[:2]
    entry.transform.rotation.z, entry.transform.rotation.w = math.sin(pose[2] / 2), math.cos(pose[2] / 2)
    return message


def run(experiment, bag_file, static, seed, scan_topic="/scan", every=1, changes=None):
    """The whole bag through a nodelet of its own."""
    done = run_pairs(experiment, pairs(bag_file, scan_topic, every), static, seed, changes)
    if not done:
        raise SessionError(f"{bag_file} has no scan with odometry")
    return done


def run_pairs(experiment, fed, static, seed, changes=None):
    """The same of (odom to base, scan); None without any."""
    values = {**stage_run.defaults("grid_slam"), "seed": seed, "hold_limit": 10.0, "map_update_interval": 0.0, **(changes or {})}
    for key, value in values.items():
        rospy.set_param(f"/{NAME}/grid_slam/{key}", value)
    session = experiment.session
    node = session.start("rosrun", "nodelet", "nodelet", "standalone", "field_fusion/grid_slam",
                         "__name:=grid_slam", f"__ns:=/{NAME}")
    latest = {}
    subscribers = [rospy.Subscriber(topic, kind, lambda m, topic=topic: latest.__setitem__(topic, m), queue_size=1)
                   for topic, kind in ((MAP, OccupancyGrid), (PATH, Path))]
    steps = SlamSteps(static, values["tf_delay"])
    try:
        session.require(steps.connected, stage_run.PATIENCE, "grid_slam did not start", node)
        return _feed(steps, Usage(session, f"/{NAME}/grid_slam"), latest, fed)
    finally:
        steps.close()
        for subscriber in subscribers:
            subscriber.unregister()
        session.end(node)


def _feed(steps, usage, latest, fed):
    began, odometry = usage.cpu(), []
    for pose, scan in fed:
        steps.scan(_transform(pose, scan.header.stamp), scan)
        odometry.append((scan.header.stamp.to_nsec(), pose))
    if not odometry:
        return None
    cpu = usage.cpu() - began
    # the map goes out after the path of the same scan
    whole = lambda: PATH in latest and MAP in latest and latest[PATH].header.stamp == latest[MAP].header.stamp
    if not RosSession.wait(whole, stage_run.PATIENCE):
        raise SessionError("grid_slam sent no path")
    path = [(p.header.stamp.to_nsec(), planar(p.pose)) for p in latest[PATH].poses]
    return Run(_poses(path, odometry), latest[MAP], len(path), 1e3 * cpu / len(path), usage.peak())


def _poses(path, odometry):
    stamps, at = [stamp for stamp, _ in path], dict(odometry)
    out = []
    for stamp, pose in odometry:
        node = max(0, bisect.bisect_right(stamps, stamp) - 1)
        out.append((stamp, compose(path[node][1], between(at[path[node][0]], pose))))
    return out
