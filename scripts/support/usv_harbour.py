"""The harbour with waves: which bodies are found, matched and named, by the paper's match and ours, and by each sensor alone.

A body's box in the picture is that of its pixels. A detection stands for the body whose box it overlaps by half
(intersection over union) and most; what the LiDAR sees, for the body of most of its points. A body counts for a sensor
that sees enough of it: FEWEST returns within the sector and reach of the stages, a detection. A match is right when both
halves stand for one body.
"""
import collections
import math
import statistics

import numpy

import figures
import sim_world
from kitti_messages import Clusters, lidar_points
from object_score import overlap
from sim_stages import Stages

SECONDS, QUICK_SECONDS = 40.05, 20.05
SECTOR, REACH = math.radians(60.0), 80.0  # rad, m: filter in config/robots/usv.yaml
FEWEST = 10  # returns: cluster's min_points
SMALLEST, LEAST_VISIBLE = 8, 0.5  # px, share: less of a body in the picture is not asked of a detector
OVERLAP = 0.5
STRETCH = 50  # clouds that are resampled together: what follows one another is alike


class Scene:
    """What is true in one frame, and what was found."""

    def __init__(self, answer):
        frame = answer.frame
        self.labels = {number: body.label for number, body in frame.bodies.items() if body.label}
        self.boxes = pixel_boxes(frame.picture.ids(), self.labels)
        self.shown = {number: d.score for number, d in self._matched(frame.picture.detections.detections, self.boxes)}
        self.detected = self._detected(answer.detections.detections)
        self.hits = self._hits(frame.points)
        rows = numpy.stack([frame.points[axis] for axis in "xyz"], axis=1)
        self.body_of = {key: int(body) for key, body in zip(keys(rows), frame.points["body"])}

    def _matched(self, detections, boxes):
        for number, box in boxes.items():
            for d in detections:
                if overlap(box, image_box(d)) > 0.99:
                    yield number, d

    def _detected(self, detections):
        """{detection id: body} of those that stand for one."""
        out = {}
        for d in detections:
            number, share = max(((n, overlap(box, image_box(d))) for n, box in self.boxes.items()), key=lambda pair: pair[1],
                                default=(None, 0.0))
            if share >= OVERLAP:
                out[d.id] = number
        return out

    def _hits(self, points):
        azimuth, away = numpy.arctan2(points["y"], points["x"]), numpy.hypot(points["x"], points["y"])
        inside = (numpy.abs(azimuth) <= SECTOR) & (away <= REACH)
        return collections.Counter(points["body"][inside].tolist())

    def body_of_points(self, points):
        """The labelled or other body that most of them are of; None of no points."""
        counts = collections.Counter(self.body_of.get(key, -1) for key in keys(points))
        return counts.most_common(1)[0][0] if counts else None

    def seen_by_camera(self):
        return {n for n, box in self.boxes.items() if self.shown.get(n, 0.0) >= LEAST_VISIBLE and small_side(box) >= SMALLEST}

    def seen_by_lidar(self):
        return {n for n in self.labels if self.hits[n] >= FEWEST}


def keys(points):
    data = numpy.ascontiguousarray(points, numpy.float32).tobytes()
    return [data[i:i + 12] for i in range(0, len(data), 12)]


def image_box(d):
    return d.x_min, d.y_min, d.x_max, d.y_max


def small_side(box):
    return min(box[2] - box[0], box[3] - box[1])


def pixel_boxes(pixels, labels):
    boxes = {}
    for number in labels:
        rows, columns = numpy.nonzero(pixels == number)
        if len(rows):
            boxes[number] = columns.min(), rows.min(), columns.max() + 1, rows.max() + 1
    return boxes


class Tally:
    """Of one system over some frames."""

    def __init__(self):
        self.right = self.matches = self.matchable = self.matched = 0  # pairs of LiDAR and camera
        self.asked = self.found = self.told = self.correct = self.named = self.misnamed = 0

    def pairs(self, scene, pairs):
        """`pairs`: (body by the LiDAR, body by the detection) of each match."""
        right = {of_points for of_points, of_box in pairs if of_points == of_box and of_points is not None}
        matchable = set(scene.detected.values()) & scene.seen_by_lidar()
        self.right += sum(a == b and a is not None for a, b in pairs)
        self.matches += len(pairs)
        self.matchable += len(matchable)
        self.matched += len(matchable & right)

    def bodies(self, scene, told):
        """`told`: (body or None, label) of each thing that the system tells of. Of several of one body all but one are
        wrong; what belongs to no class, such as the quay, counts neither way."""
        asked = scene.seen_by_lidar() | scene.seen_by_camera()
        known = [body for body, _ in told if body in scene.labels]
        self.asked += len(asked)
        self.found += len(asked & set(known))
        self.told += len(known) + sum(body is None or body < 0 for body, _ in told)
        self.correct += len(set(known))
        labelled = [(body, label) for body, label in told if label and body in scene.labels]
        self.named += len(labelled)
        self.misnamed += sum(label != scene.labels[body] for body, label in labelled)


SYSTEMS = ("optimal", "paper", "camera_only", "lidar_only")
RATES = {  # figure: (counted, of)
    "match_precision": ("right", "matches"), "match_recall": ("matched", "matchable"),
    "recall": ("found", "asked"), "precision": ("correct", "told"), "wrong_class": ("misnamed", "named")}
COLUMNS = ("system", "seed", *RATES)


def tell(scene, answer, tallies):
    for method, obstacles in answer.obstacles.items():
        clusters = Clusters(answer.clusters[method])
        told, pairs = [], []
        for o in obstacles.obstacles:
            points = lidar_points(o, obstacles.obstacles, clusters)
            of_box = scene.detected.get(o.detection_id)
            of_points = scene.body_of_points(points) if points is not None else of_box
            told.append((of_points, o.label))
            if o.source == o.SOURCE_BOTH:
                pairs.append((of_points, of_box))
        tallies[method].bodies(scene, told)
        tallies[method].pairs(scene, pairs)
    tallies["camera_only"].bodies(scene, [(scene.detected.get(d.id), d.label) for d in answer.detections.detections])
    clusters = Clusters(answer.clusters["optimal"])
    tallies["lidar_only"].bodies(scene, [(scene.body_of_points(points), "") for cluster, points
                                         in zip(clusters.messages, clusters.arrays) if not cluster.faint])


def run(experiment, methods):
    """{system: [[Tally of each stretch] of each seed]}."""
    stages = Stages(experiment.session, experiment.folder, methods, sim_world.KNOWN["usv_harbour"], experiment.given.model)
    seconds = QUICK_SECONDS if experiment.quick else SECONDS
    tallies = {system: [] for system in SYSTEMS}
    for seed in experiment.seeds:
        bag = experiment.bag(sim_world.shipped("usv_harbour"), seconds, seed, "--labels", "--mounts", "lidar", "camera")
        for system in SYSTEMS:
            tallies[system].append([])
        for place, answer in enumerate(stages.play(bag)):
            if place % STRETCH == 0:
                for system in SYSTEMS:
                    tallies[system][-1].append(Tally())
            tell(Scene(answer), answer, {system: tallies[system][-1][-1] for system in SYSTEMS})
        experiment.done(bag)
    stages.close()
    return tallies


def rate(tallies, name):
    counted, of = RATES[name]
    total = sum(getattr(tally, of) for tally in tallies)
    return sum(getattr(tally, counted) for tally in tallies) / total if total else math.nan


def table(tallies):
    """A row a system, mean and standard deviation over the seeds."""
    yield f"{'harbour':12} " + " ".join(f"{name:>17}" for name in RATES)
    for system, seeds in tallies.items():
        cells = []
        for name in RATES:
            values = [value for value in (rate(stretches, name) for stretches in seeds) if not math.isnan(value)]
            spread = statistics.stdev(values) if len(values) > 1 else math.nan
            cells.append(f"{statistics.fmean(values):8.3f} +- {spread:5.3f}" if values else "-".rjust(17))
        yield f"{system:12} " + " ".join(cells)


def csv_rows(tallies):
    return [(system, seed, *(rate(stretches, name) for name in RATES))
            for system, seeds in tallies.items() for seed, stretches in enumerate(seeds, 1)]


def lines(tallies):
    for system, seeds in tallies.items():
        stretches = [tally for seed in seeds for tally in seed]
        for name, (_, of) in RATES.items():
            if not math.isnan(rate(stretches, name)):
                prefix = "" if system == "optimal" else f"{system}/"
                yield figures.line(f"usv/harbour/{prefix}{name}", rate(stretches, name), "-",
                                   sum(getattr(tally, of) for tally in stretches),
                                   figures.bootstrap(stretches, lambda drawn: rate(drawn, name), 400))
