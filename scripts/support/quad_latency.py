"""All stages of quadruped.launch in one manager, in real time: from a depth image to the maps it goes into.

A latency runs from when the CameraInfo that goes before an image has come here to when a map with the image's stamp has. Two
hops between processes are in it at the end, one at the begin. `fused_map` and `projected_map` go out at most every so many
seconds (their `publish_interval`); only images that a map was made for have a latency. The recording is played by rosbag:
scanner at 10 Hz, depth of 640 x 480 at 30 Hz, odometry and its transforms at 500 Hz."""
import os
import time
import typing

import figures
import quad_stages
import rospy
import sim_world
import slam_stage
import stage_run
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import OccupancyGrid
from real_time import percentile, percentile_line
from ros_session import RosSession
from sensor_msgs.msg import CameraInfo, LaserScan

SECONDS, QUICK_SECONDS = 40.0, 12.0
SETTLED = 4.0  # s that the stages get to know of each other, and of the map, before anything counts
ADVERTISED = 5.0  # s between the topics of the recording and its messages
LAST = 3.0  # s of wall time for what is under way at the end, and for its diagnostics
MAPS = {"fused": "/fused_map", "projected": "/projected_map"}
HEARD = {"/scan_merged": LaserScan, "/depth_scan": LaserScan, "/fused_local_map": OccupancyGrid}  # so that every stage works
MANAGER = "/manager"
STAGES = ("deskew_scan", "depth_scan", "scan_merge", "grid_slam", "voxel_map", "map_fusion")
LOST = ("dropped", "missing", "skipped")  # of an input, in /diagnostics
COLUMNS = ("seed", "map", "maps", "p50 [ms]", "p99 [ms]", "max [ms]")


class Row(typing.NamedTuple):
    seed: int
    latencies: dict  # {name of MAPS: [s]}
    images: int  # that came
    lost: dict  # {"stage input: how": count}, of all messages
    pace: float  # s of wall time for each of the recording
    cores: float  # that the manager took
    load: float  # of the machine, mean of one minute


class Ear:
    """When what came: `came` {(topic, stamp): monotonic s}; `told` [(monotonic s, {stage: {key: value}})]."""

    def __init__(self):
        self.came, self.told = {}, []
        keep = lambda message, topic: self.came.setdefault((topic, message.header.stamp), time.monotonic())
        kinds = {quad_stages.INFO: CameraInfo, **dict.fromkeys(MAPS.values(), OccupancyGrid)}
        self.subscribers = [rospy.Subscriber(topic, kind, keep, topic, queue_size=50) for topic, kind in kinds.items()]
        self.subscribers += [rospy.Subscriber(topic, kind, lambda message: None, queue_size=1) for topic, kind in HEARD.items()]
        self.subscribers.append(rospy.Subscriber("/diagnostics", DiagnosticArray, self._on_diagnostics, queue_size=100))

    def _on_diagnostics(self, message):
        for status in message.status:
            stage = status.name.split(":")[0].split("/")[-1]
            if stage in STAGES:
                self.told.append((time.monotonic(), stage, {value.key: value.value for value in status.values}))

    def of(self, topic):
        """{stamp: monotonic s}"""
        return {stamp: at for (of, stamp), at in self.came.items() if of == topic}

    def diagnosed(self, stages, after):
        return set(stages) <= {stage for at, stage, _ in self.told if at > after}

    def close(self):
        for subscriber in self.subscribers:
            subscriber.unregister()


def run(experiment):
    """Lines: a table, then figures."""
    rows = []
    for seed in experiment.seeds:
        bag = experiment.bag(sim_world.shipped("quad_obstacles"), QUICK_SECONDS if experiment.quick else SECONDS, seed,
                             "--mounts", "scan", "depth", "odom")
        rows.append(_played(experiment, seed, bag))
        experiment.done(bag)
        told = "; ".join(f"{name} p50 {_p(rows[-1], name, 50):.0f} ms, p99 {_p(rows[-1], name, 99):.0f} ms" for name in MAPS)
        experiment.say(f"latency, seed {seed}: {told}, lost {sum(rows[-1].lost.values())}, load {rows[-1].load:.1f}")
    experiment.table("quadruped_latency", COLUMNS, [
        (row.seed, name, len(row.latencies[name]), *(1e3 * percentile(row.latencies[name], share) for share in (50, 99, 100)))
        for row in rows for name in MAPS])
    return [*table(rows), *lines(rows)]


def _played(experiment, seed, bag):
    session = experiment.session
    launch = session.launch(stage_run.package() / "launch/quadruped.launch", "rviz:=false", f"scan:={quad_stages.SCAN}",
                            f"odom:={quad_stages.ODOM}", f"image:={quad_stages.IMAGE}", f"camera_info:={quad_stages.INFO}")
    ear = Ear()
    try:
        session.require(lambda: ear.diagnosed(STAGES, 0.0), stage_run.PATIENCE, "the stages did not start", launch)
        player = session.start("rosbag", "play", "--quiet", "--delay", str(ADVERTISED), str(bag), "--topics", "/tf_static",
                               *quad_stages.KINDS)
        session.require(lambda: ear.of(quad_stages.INFO), stage_run.PATIENCE, "the recording did not begin", launch, player)
        usage, began = slam_stage.Usage(session, MANAGER), time.monotonic()
        before = usage.cpu()
        session.require(lambda: player.poll() is not None, stage_run.PATIENCE + 2 * SECONDS, "the recording did not end", launch)
        ended, cpu = time.monotonic(), usage.cpu() - before
        RosSession.wait(lambda: ear.diagnosed(STAGES, ended + LAST / 2), LAST + 5.0)
        return _row(seed, ear, cpu / (ended - began))
    finally:
        ear.close()
        session.end(launch)


def _row(seed, ear, cores):
    images = ear.of(quad_stages.INFO)
    if len(images) < 2:
        return Row(seed, {name: [] for name in MAPS}, len(images), {}, float("nan"), cores, os.getloadavg()[0])
    began, ended = min(images), max(images)
    counted = {stamp: at for stamp, at in images.items() if (stamp - began).to_sec() >= SETTLED}
    maps = {name: ear.of(topic) for name, topic in MAPS.items()}
    return Row(seed, {name: latencies(counted, came) for name, came in maps.items()}, len(counted),
               lost(ear.told, images[began] + SETTLED), (images[ended] - images[began]) / (ended - began).to_sec(), cores,
               os.getloadavg()[0])


def latencies(images, maps):
    """[s] of each map that has the stamp of an image; both {stamp: when it came}."""
    return [at - images[stamp] for stamp, at in sorted(maps.items()) if stamp in images]


def lost(told, since):
    """{"stage, input: how": count} of messages that were lost from the last that was told before `since` [s] on."""
    out = {}
    for stage in STAGES:
        mine = [(at, values) for at, of, values in told if of == stage]
        before = next((values for at, values in reversed(mine) if at <= since), {})
        for key, value in (mine[-1][1] if mine else {}).items():
            if key.endswith(tuple(f": {how}" for how in LOST)):
                count = int(value) - int(before.get(key, 0))
                out.update({f"{stage}, {key}": count} if count else {})
    return out


def _p(row, name, share):
    return 1e3 * percentile(row.latencies[name], share)


def table(rows):
    yield f"latency from a depth image to a map, {os.cpu_count()} cores"
    yield "seed  map         maps     p50     p99     max   pace  cores   load   lost"
    for row in rows:
        for name in MAPS:
            told = "; ".join(f"{what} {count}" for what, count in row.lost.items()) or "none"
            yield (f"{row.seed:4}  {name:10} {len(row.latencies[name]):5}  {_p(row, name, 50):6.1f}  {_p(row, name, 99):6.1f}  "
                   f"{_p(row, name, 100):6.1f}  {row.pace:5.3f}  {row.cores:5.2f}  {row.load:5.1f}   {told}")
    yield ""


def lines(rows):
    """The headline last: to the fused map."""
    yield figures.mean("quadruped/latency/cores", [row.cores for row in rows], "cores")
    yield figures.mean("quadruped/latency/lost", [float(sum(row.lost.values())) for row in rows], "messages")
    for name, figure in (("projected", "depth_to_projected_p99"), ("fused", "depth_to_map_p99")):
        yield percentile_line(f"quadruped/latency/{figure}", [1e3 * value for row in rows for value in row.latencies[name]], 99, "ms")
