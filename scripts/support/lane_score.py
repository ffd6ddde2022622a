"""Obstacles in the lane that the car then drives through: whatever stood there was none.

The lane of a frame is the strip of 1 m to each side of the way that the LiDAR takes in the later frames of the
recording, from 3 m ahead to where the recording ends, 0.3 to 2.2 m above the ground plane. An obstacle is in it
with half of its points, or with the middle of its box. It is false unless half of its points lie within 0.5 m of a
labelled body, which may have driven on, or its middle in an area where the labels tell nothing (DontCare).
"""
import csv
import dataclasses

import numpy

from kitti_labels import DONT_CARE, BadFile

HALF_WIDTH, AHEAD = 1.0, 3.0  # m
LOWEST, HIGHEST = 0.3, 2.2  # m
NEAR_BODY = 0.5  # m


@dataclasses.dataclass(frozen=True)
class Lane:
    """In the LiDAR's frame of one instant. `way` (n x 2) [m] begins 3 m ahead; `normal` . p + `height` is a point's
    height above the ground plane."""
    way: numpy.ndarray
    normal: numpy.ndarray
    height: float

    def contains(self, points):
        """For points (n x 3). An obstacle beyond the ends of the way is outside, whatever its distance."""
        above = points @ self.normal + self.height
        return (above >= LOWEST) & (above <= HIGHEST) & self._beside(points[:, :2])

    def _beside(self, points):
        inside = numpy.zeros(len(points), bool)
        for start, end in zip(self.way[:-1], self.way[1:]):
            step = end - start
            length = numpy.hypot(*step)
            if length == 0.0:
                continue
            along, across = (points - start) @ step / length, (points - start) @ [-step[1], step[0]] / length
            inside |= (along >= 0.0) & (along <= length) & (numpy.abs(across) <= HALF_WIDTH)
        return inside


def way_ahead(poses, frame):
    """(n x 2) [m] where the LiDAR passes after `frame`, seen from there, without the first 3 m; a point a frame.
    Empty where it does not get so far, or without poses."""
    if not poses:
        return numpy.empty((0, 2))
    T_frame_first = numpy.linalg.inv(poses[frame])
    way = numpy.array([(T_frame_first @ pose)[:2, 3] for pose in poses[frame:]])
    driven = numpy.concatenate([[0.0], numpy.cumsum(numpy.hypot(*numpy.diff(way, axis=0).T))])
    if driven[-1] <= AHEAD:
        return way[:0]
    start = [numpy.interp(AHEAD, driven, axis) for axis in way.T]
    return numpy.vstack([start, way[driven > AHEAD]])


def false_obstacles(lane, obstacles, bodies, calibration):
    """The places of those that are false, of `obstacles`: [(points, middle of the box)]."""
    return [place for place, (points, middle) in enumerate(obstacles)
            if _in_lane(lane, points, middle) and not _excused(points, middle, bodies, calibration)]


def _in_lane(lane, points, middle):
    return 2 * numpy.count_nonzero(lane.contains(points)) >= len(points) or lane.contains(middle[None])[0]


def _excused(points, middle, bodies, calibration):
    pixel = calibration.pixels(middle[None])[0]
    for body in bodies:
        if body.kind == DONT_CARE:
            left, top, right, bottom = body.image_box
            if left <= pixel[0] <= right and top <= pixel[1] <= bottom:
                return True
        elif 2 * numpy.count_nonzero(body.contains(points, NEAR_BODY)) >= len(points):
            return True
    return False


def read_poses(file):
    """{name of the frame: T_first_lidar (4x4)} as kitti_poses writes them, in their order."""
    poses = {}
    with open(file, newline="") as rows:
        for number, row in enumerate(csv.reader(rows), 1):
            if number == 1:
                continue
            pose = numpy.eye(4)
            try:
                pose[:3] = numpy.array(row[1:], float).reshape(3, 4)
            except ValueError as error:
                raise BadFile(f"{file}:{number}: {error}") from None
            poses[row[0]] = pose
    return poses


def stillest(tracks, poses, fewest=20):
    """(track, its body's kind, frames, wander) of the labelled body that moves least over ground: `wander` [m] is the
    root mean square distance of its labelled centres from their mean, so what poses and labels are off by at most.
    None without a body in `fewest` frames. `tracks`: {track: [(frame, body)]}."""
    found = []
    for track, seen in tracks.items():
        if len(seen) >= fewest:
            centres = numpy.array([poses[frame][:2] @ [*body.centre, 1.0] for frame, body in seen])
            wander = numpy.sqrt(((centres - centres.mean(axis=0)) ** 2).sum(axis=1).mean())
            found.append((float(wander), track, seen[0][1].kind, len(seen)))
    if not found:
        return None
    wander, track, kind, frames = min(found)
    return track, kind, frames, wander
