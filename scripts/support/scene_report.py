#!/usr/bin/python3
"""Listens to /obstacles and /truth/obstacles of a made-up scene and prints what was found of each body.

Ranges are those of the near side (of the axis-aligned box, over ground): a LiDAR does not see the rest of a
body. Azimuths are those of the middle of what is seen.
"""
import argparse
import collections
import math
import statistics
import sys
import threading
import time

import figures

LIDAR, BOTH = 1, 3  # Obstacle.SOURCE_*
MAX_GAP = 1.0  # m between a body and what is taken for it


def gap(x, half):
    """Distance of 0 to the interval around x; a size that is not known counts as none."""
    return max(0.0, abs(x) - (half if math.isfinite(half) else 0.0))


def near_range(obstacle):
    return math.hypot(gap(obstacle.position.x, obstacle.size.x / 2), gap(obstacle.position.y, obstacle.size.y / 2))


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
    """Keeps both arrays of each stamp; of two revisions of the obstacles the later."""

    def __init__(self):
        import rospy
        from field_fusion.msg import ObstacleArray

        self.lock, self.truth, self.obstacles, self.last = threading.Lock(), {}, {}, None
        self.subscribers = [rospy.Subscriber("/truth/obstacles", ObstacleArray, self._on_truth, queue_size=100),
                            rospy.Subscriber("/obstacles", ObstacleArray, self._on_obstacles, queue_size=100)]

    def _on_truth(self, message):
        with self.lock:
            if message.header.stamp not in self.truth:  # a looping bag brings nothing new
                self.truth[message.header.stamp], self.last = message, time.monotonic()

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
            return [(self.truth[stamp].obstacles, self.obstacles[stamp].obstacles)
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
        print("scene_report: no frame with both /truth/obstacles and /obstacles came", file=sys.stderr)
        return 1
    print("\n".join(report(frames)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
