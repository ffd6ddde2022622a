#!/usr/bin/python3
"""Listens to /obstacles and to the truth of a simulated world and prints what was found of each body.

Of a body counts what the LiDAR truly hit within the sector that the stages look at: ranges are those of what is nearest
of it (over ground), azimuths those of the middle.
"""
import argparse
import collections
import math
import statistics
import sys
import threading
import time
from types import SimpleNamespace

import figures
import numpy

LIDAR, CAMERA, BOTH = 1, 2, 3  # Obstacle.SOURCE_*
SECTOR, REACH = math.radians(60.0), 80.0  # rad, m: filter in config/robots/usv.yaml
MIN_RETURNS = 10  # that the LiDAR needs to have got from a body: cluster's min_points
SLACK = math.radians(1.0)  # by which a body may stand beside its box in the picture: the two sensors are not at one place
ROW = numpy.dtype([("x", "f4"), ("y", "f4"), ("z", "f4"), ("body", "i4"), ("range", "f4")])  # truth/<lidar>/points
MAX_GAP = 1.0  # m between a body and what is taken for it


def gap(x, half):
    """Distance of 0 to the interval around x; a size that is not known counts as none."""
    return max(0.0, abs(x) - (half if math.isfinite(half) else 0.0))


def near_range(thing):
    return math.hypot(thing.face.x, thing.face.y)


def distance(body, obstacle):
    """[m] over ground from the obstacle's position to the body."""
    return math.hypot(gap(obstacle.position.x - body.position.x, body.size.x / 2),
                      gap(obstacle.position.y - body.position.y, body.size.y / 2))


def pairs(bodies, obstacles):
    """(body, obstacle or None) for each body that the LiDAR can see; each obstacle goes to one body. Of several
    within 0.1 m, as when a body falls apart into rings, the one that the camera agrees with comes first."""
    wanted = [body for body in bodies if body.source & LIDAR]
    offered = [obstacle for obstacle in obstacles if obstacle.source & LIDAR]
    order = sorted((round(distance(b, o), 1), -o.source, i, j)
                   for i, b in enumerate(wanted) for j, o in enumerate(offered))
    found, taken = {}, set()
    for away, _, i, j in order:
        if away <= MAX_GAP and i not in found and j not in taken:
            found[i] = offered[j]
            taken.add(j)
    return [(body, found.get(i)) for i, body in enumerate(wanted)]


def bearing(ray):
    """[rad] of a ray in the optical frame, left is positive."""
    return math.atan2(-ray.x, ray.z)


def seen_bodies(rows, labels, detections):
    """Of each labelled body that the LiDAR hit: where its hits are, and which sensors see it."""
    places = numpy.stack([rows[axis] for axis in "xyz"], axis=1).astype(float)
    places *= (rows["range"] / numpy.linalg.norm(places, axis=1))[:, None]
    flat = numpy.hypot(places[:, 0], places[:, 1])
    inside = (numpy.abs(numpy.arctan2(places[:, 1], places[:, 0])) <= SECTOR) & (flat <= REACH)
    bodies = []
    for number, label in labels.items():
        hits = places[inside & (rows["body"] == number)]
        if not label or len(hits) == 0:
            continue
        low, high = hits.min(axis=0), hits.max(axis=0)
        nearest = hits[numpy.hypot(hits[:, 0], hits[:, 1]).argmin()]
        middle = (low + high) / 2
        azimuth = math.atan2(middle[1], middle[0])
        pictured = any(d.label == label
                       and bearing(d.ray_max) - SLACK <= azimuth <= bearing(d.ray_min) + SLACK for d in detections)
        bodies.append(SimpleNamespace(
            id=number, label=label, azimuth=azimuth,
            source=(LIDAR if len(hits) >= MIN_RETURNS else 0) | (CAMERA if pictured else 0),
            position=SimpleNamespace(x=middle[0], y=middle[1]), face=SimpleNamespace(x=nearest[0], y=nearest[1]),
            size=SimpleNamespace(x=high[0] - low[0], y=high[1] - low[1])))
    return bodies


class Tally:
    """What was found of one body over all frames."""

    def __init__(self, body):
        self.name = f"{body.label or 'unlabelled'} {body.id}"
        self.frames = self.found = self.both = self.both_possible = self.named = 0
        self.range_errors, self.azimuth_errors = [], []

    def add(self, body, obstacle):
        self.frames += 1
        self.both_possible += body.source == BOTH and bool(body.label)
        if obstacle is None:
            return
        self.found += 1
        self.both += obstacle.source == BOTH
        self.named += obstacle.source == BOTH and obstacle.label == body.label
        self.range_errors.append(near_range(obstacle) - near_range(body))
        self.azimuth_errors.append(math.degrees(math.remainder(obstacle.azimuth - body.azimuth, math.tau)))

    def row(self):
        fused = f"{self.both}/{self.both_possible}"
        head = f"{self.name:14} {self.found:4}/{self.frames:<4} {fused:>9} {self.named:6}"
        if not self.found:
            return head
        return head + f" {statistics.mean(self.range_errors):+9.2f} m {statistics.mean(self.azimuth_errors):+9.2f} deg"


def report(frames):
    """Lines for [(bodies, obstacles)], one of each instant."""
    tallies = collections.OrderedDict()
    for bodies, obstacles in frames:
        for body, obstacle in pairs(bodies, obstacles):
            tallies.setdefault(body.id, Tally(body)).add(body, obstacle)
    lines = [f"{'body':14} {'found':>9} {'fused':>9} {'named':>6} {'range error':>11} {'azimuth error':>13}"]
    lines += [tally.row() for _, tally in sorted(tallies.items())]
    every = list(tallies.values())
    found, possible = sum(t.found for t in every), sum(t.frames for t in every)
    lines.append(figures.line("scene/found", found / possible if possible else math.nan, "-", possible,
                              figures.wilson(found, possible)))
    for name, unit, errors in (("range", "m", [abs(e) for t in every for e in t.range_errors]),
                               ("azimuth", "deg", [abs(e) for t in every for e in t.azimuth_errors])):
        mean = statistics.fmean(errors) if errors else math.nan
        lines.append(figures.line(f"scene/{name}_mae", mean, unit, len(errors),
                                  figures.bootstrap(errors, statistics.fmean, 400)))
    return lines


class Listener:
    """Keeps the truth and the obstacles of each stamp; of two revisions of the obstacles the later."""

    def __init__(self):
        import rospy
        from field_fusion.msg import ImageDetectionArray, ObstacleArray, TruthBodies
        from sensor_msgs.msg import PointCloud2

        self.lock, self.truth, self.obstacles, self.last = threading.Lock(), {}, {}, None
        self.labels, self.detections = {}, []
        self.subscribers = [rospy.Subscriber(topic, kind, handler, queue_size=100) for topic, kind, handler in (
            ("/truth/bodies", TruthBodies, self._on_bodies),
            ("/truth/camera/detections", ImageDetectionArray, self._on_detections),
            ("/truth/lidar/points", PointCloud2, self._on_truth),
            ("/obstacles", ObstacleArray, self._on_obstacles))]

    def _on_bodies(self, message):
        with self.lock:
            self.labels = {body.id: body.label for body in message.bodies}

    def _on_detections(self, message):
        with self.lock:
            self.detections = message.detections

    def _on_truth(self, message):
        with self.lock:
            if message.header.stamp not in self.truth and self.labels:  # a looping bag brings nothing new
                bodies = seen_bodies(numpy.frombuffer(message.data, ROW), self.labels, self.detections)
                self.truth[message.header.stamp], self.last = bodies, time.monotonic()

    def _on_obstacles(self, message):
        with self.lock:
            known = self.obstacles.get(message.header.stamp)
            if known is None or message.revision >= known.revision:
                self.obstacles[message.header.stamp] = message

    def quiet(self, seconds):
        with self.lock:
            return self.last is not None and time.monotonic() - self.last > seconds

    def frames(self):
        with self.lock:
            return [(self.truth[stamp], self.obstacles[stamp].obstacles)
                    for stamp in sorted(self.truth) if stamp in self.obstacles]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quiet", type=float, default=3.0, help="report when no new truth came for this long [s]")
    parser.add_argument("--limit", type=float, default=120.0, help="report after this long at the latest [s]")
    given = parser.parse_args()
    import rospy

    rospy.init_node("scene_report", disable_signals=True)
    listener = Listener()
    deadline = time.monotonic() + given.limit
    while not listener.quiet(given.quiet) and time.monotonic() < deadline:
        time.sleep(0.1)
    frames = listener.frames()
    if not frames:
        print("scene_report: no frame with both /truth/lidar/points and /obstacles came", file=sys.stderr)
        return 1
    print("\n".join(report(frames)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
