"""`kitti_object` and recordings like it: the obstacles of single frames against labelled bodies, next to what
camera and LiDAR alone would give.

Counted is every labelled body within 70 m. What the LiDAR sees stands for the body in whose box, grown by 0.3 m, it
has most of its points, and of several the one with most points there. What the camera alone sees stands for the body
whose box in the image it overlaps by half (intersection over union), if no other does.
Range: horizontal, from the LiDAR to the nearest of the labelled box against that of the cluster's box turned to fit (of
a part of a cluster: what 1 % of its points are nearer than), or the range that the camera estimates. Azimuth: middle of the sector that the box fills, seen from the LiDAR, against that of the
points, or the direction in which the camera sees the middle of its box.
"""
import dataclasses
import math

import numpy

import figures
import kitti_labels
import kitti_run
from body_score import near_range, turn
from kitti_messages import Clusters, lidar_points, shares_cluster
from poses import vector

FARTHEST = 70.0  # m, horizontal
MARGIN = 0.3  # m about the box
OVERLAP = 0.5  # intersection over union of boxes in the image
TALL = 40.0  # px: lower boxes have no say in class_accuracy
FEW_POINTS = 10  # fewer of the raw cloud, and no detection: no sensor tells that there is a body
NAMES = {"Car": ("car",), "Van": ("car", "truck", "bus"), "Truck": ("truck", "bus"), "Tram": ("train", "bus"),
         "Pedestrian": ("person",), "Person_sitting": ("person",), "Person": ("person",),
         "Cyclist": ("person", "bicycle")}  # COCO's names that are right for KITTI's; Misc has none
SYSTEMS = ("", "camera_only/", "lidar_only/")
COLUMNS = ("frame", "kind", "distance_m", "pixels_high", "raw_points",
           *(f"{system or 'fused/'}{value}" for system in SYSTEMS
             for value in ("by", "label", "range_error_m", "azimuth_error_deg")))


@dataclasses.dataclass(frozen=True)
class Candidate:
    """Something that may stand for a body: by its LiDAR points, or without them by its box in the image."""
    by: str  # lidar, camera, both
    label: str  # empty: unknown
    points: object  # n x 3, None where the camera alone sees it
    image_box: object  # px: left, top, right, bottom; None where the LiDAR alone sees it
    range: float  # m, horizontal, to the near side; NaN unknown
    azimuth: float  # rad

    def weight(self, body):
        """How much of the body it is; 0: it does not stand for it. LiDAR points count more than any overlap."""
        if self.points is None:
            shared = overlap(self.image_box, body.image_box)
            return shared if shared >= OVERLAP else 0.0
        inside = numpy.count_nonzero(body.contains(self.points, MARGIN))
        return float(inside + 1) if 2 * inside > len(self.points) else 0.0

    def range_error(self, body):
        return self.range - body.nearest_range()

    def azimuth_error(self, body):
        return turn(self.azimuth - body.azimuth())


def overlap(a, b):
    """Intersection over union of two boxes (left, top, right, bottom)."""
    width, height = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    if width <= 0.0 or height <= 0.0:
        return 0.0
    shared = width * height
    return shared / ((a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - shared)


def stands_for(body, candidates):
    """The candidate that does, None where none does."""
    best = max(candidates, key=lambda candidate: candidate.weight(body), default=None)
    return best if best and best.weight(body) > 0.0 else None


@dataclasses.dataclass(frozen=True)
class Outcome:
    """One body and what stands for it, for each of SYSTEMS (None: nothing)."""
    frame: str
    body: object
    raw_points: int
    found: dict

    def named(self, system):
        candidate = self.found[system]
        return candidate is not None and candidate.label in NAMES[self.body.kind]

    def row(self):
        values = [self.frame, self.body.kind, self.body.distance, self.body.pixels_high, self.raw_points]
        for candidate in map(self.found.get, SYSTEMS):
            values += ["-", "", math.nan, math.nan] if candidate is None else [
                candidate.by, candidate.label, candidate.range_error(self.body),
                math.degrees(candidate.azimuth_error(self.body))]
        return values


def lidar_candidates(clusters):
    return [Candidate("lidar", "", points, None, shape.near_side, kitti_labels.middle_azimuth(points))
            for points, shape in zip(clusters.arrays, clusters.shapes)]


def camera_candidates(detections, calibration):
    candidates = []
    for d in detections:
        ray = vector(d.ray)
        known = math.isfinite(d.range)
        # without range as if far away: then it does not matter that the camera stands beside the LiDAR
        x, y, _ = calibration.from_colour_camera(ray[None] * (d.range if known else 1e4))[0]
        candidates.append(Candidate("camera", d.label, None, _image_box(d), math.hypot(x, y) if known else math.nan,
                                    math.atan2(y, x)))
    return candidates


def fused_candidates(obstacles, clusters, detections):
    candidates = []
    for o in obstacles.obstacles:
        box = _image_box(detections[o.detection_id]) if o.detection_id >= 0 else None
        points = lidar_points(o, obstacles.obstacles, clusters)
        near, azimuth = math.hypot(o.position.x, o.position.y), o.azimuth
        if points is not None:
            part = shares_cluster(o, obstacles.obstacles)
            near = near_range(points) if part else clusters.shapes[o.cluster_id].near_side
            azimuth = kitti_labels.middle_azimuth(points)
        by = {o.SOURCE_LIDAR: "lidar", o.SOURCE_CAMERA: "camera", o.SOURCE_BOTH: "both"}[o.source]
        candidates.append(Candidate(by, o.label, points, box, near, azimuth))
    return candidates


def _image_box(detection):
    return detection.x_min, detection.y_min, detection.x_max, detection.y_max


def outcomes_of(frame, bodies, raw_cloud, candidates):
    """`candidates`: {system: [Candidate]}."""
    return [Outcome(frame, body, int(numpy.count_nonzero(body.contains(raw_cloud))),
                    {system: stands_for(body, candidates[system]) for system in SYSTEMS})
            for body in bodies if body.kind != kitti_labels.DONT_CARE and body.distance <= FARTHEST]


def system_figures(outcomes, system):
    name = f"kitti/object/{system}"
    found = [outcome for outcome in outcomes if outcome.found[system]]
    tall = [outcome for outcome in outcomes if outcome.body.pixels_high >= TALL and outcome.body.kind in NAMES]
    yield figures.share(name + "obstacle_recall", len(found), len(outcomes))
    yield figures.share(name + "class_accuracy", sum(outcome.named(system) for outcome in tall), len(tall))
    for value, unit, error in (("range", "m", lambda c, body: abs(c.range_error(body))),
                               ("azimuth", "deg", lambda c, body: math.degrees(abs(c.azimuth_error(body))))):
        errors = [error(outcome.found[system], outcome.body) for outcome in found]
        yield figures.worst(f"{name}{value}_max_error", errors, unit)


def report(outcomes):
    """The lines of the table and the figures."""
    yield f"{'frame':10} {'body':14} {'at':>7} {'high':>6} {'points':>6} " + "".join(
        f" | {name:6} {'label':10} {'range':>8} {'azimuth':>9}" for name in ("fused", "camera", "lidar"))
    for outcome in outcomes:
        frame, kind, distance, high, points, *systems = outcome.row()
        yield f"{frame:10} {kind:14} {distance:5.1f} m {high:3.0f} px {points:6} " + "".join(
            " | {:6} {:10} {:+6.2f} m {:+5.2f} deg".format(*systems[i:i + 4]) for i in range(0, len(systems), 4))
    for outcome in outcomes:
        if outcome.raw_points < FEW_POINTS and not outcome.found["camera_only/"]:
            yield (f"frame {outcome.frame}: physics forbids the {outcome.body.kind} at {outcome.body.distance:.1f} m: "
                   f"{outcome.raw_points} points, {outcome.body.pixels_high:.0f} px high, no detection "
                   "(it counts as any other)")
    for system in SYSTEMS:
        yield from system_figures(outcomes, system)


def run(session, folder, out, model):
    from field_fusion.msg import ImageDetectionArray

    names = kitti_run.names_of(folder)
    calibrations = [kitti_labels.read_calibration(kitti_labels.calibration_file(folder, name)) for name in names]
    labels = [kitti_labels.read_object_labels(folder / "label_2" / f"{name}.txt", calibration)
              for name, calibration in zip(names, calibrations)]
    also = {"/detections": ImageDetectionArray}
    if not any((folder / images).is_dir() for images in ("image_02", "image_2")):
        model, also = None, {}
    outcomes = []
    # 5 s apart, as the frames are of different drives: nothing is remembered from one to the next
    for place, answer in kitti_run.play(session, folder, out, model, rate=0.2, also=also):
        clusters = Clusters(answer["/clusters"])
        detections = answer["/detections"].detections if also else []
        candidates = {"": fused_candidates(answer["/obstacles"], clusters, detections),
                      "camera_only/": camera_candidates(detections, calibrations[place]),
                      "lidar_only/": lidar_candidates(clusters)}
        cloud = numpy.fromfile(folder / "velodyne" / f"{names[place]}.bin", "<f4").reshape(-1, 4)[:, :3]
        outcomes += outcomes_of(names[place], labels[place], cloud, candidates)
    return outcomes
