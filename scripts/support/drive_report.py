#!/usr/bin/python3
"""Listens to /obstacles of the real drive and prints what is fused, at last against the known range of the car
ahead in the own lane."""
import argparse
import math
import time

import rospy
from field_fusion.msg import Obstacle, ObstacleArray
from kitti_data import CAR_AHEAD, FRAMES, HALF_LANE, VEHICLES

START, PERIOD = 1.317e9, 0.1  # s, as kitti_to_bag writes them


def describe(obstacle):
    return (f"{obstacle.label:8} {obstacle.label_probability:.2f}  {obstacle.range:5.1f} m "
            f"{math.degrees(obstacle.azimuth):+6.1f} deg")


class Report:
    def __init__(self):
        self.seen = {}  # frame: ranges found
        self.arrays = 0
        self.printed = 0.0
        self.subscriber = rospy.Subscriber("/obstacles", ObstacleArray, self.on_obstacles, queue_size=50)

    def on_obstacles(self, array):
        if array.provisional:
            return
        self.arrays += 1
        fused = [o for o in array.obstacles if o.source == Obstacle.SOURCE_BOTH]
        frame = round((array.header.stamp.to_sec() - START) / PERIOD) % FRAMES
        for o in fused:
            if o.label in VEHICLES and abs(o.position.y) < HALF_LANE:
                self.seen.setdefault(frame, []).append(o.position.x - o.size.x / 2)
        if fused and time.monotonic() - self.printed > 1.0:
            self.printed = time.monotonic()
            others = len(array.obstacles) - len(fused)
            print(f"frame {frame}: " + " | ".join(map(describe, fused)) + f" | and {others} by one sensor alone", flush=True)

    def summary(self):
        yield f"{self.arrays} obstacle arrays; the car ahead, nearest point of its box along x:"
        for frame, truth in sorted(CAR_AHEAD.items()):
            ranges = self.seen.get(frame, [])
            found = f"{sum(ranges) / len(ranges):.2f} m, {len(ranges)} times" if ranges else "not fused"
            yield f"  frame {frame}: truth {truth:.2f} m, found {found}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--limit", type=float, default=math.inf, help="end after so long [s]")
    given = parser.parse_args()
    rospy.init_node("drive_report", disable_signals=True)
    report = Report()
    deadline = time.monotonic() + given.limit
    try:
        while time.monotonic() < deadline:
            time.sleep(0.1)
    except KeyboardInterrupt:
        pass
    print("\n".join(report.summary()))


if __name__ == "__main__":
    main()
