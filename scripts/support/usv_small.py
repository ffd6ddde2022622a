"""Black buoys of half a metre, from 5 to 40 m: what the LiDAR alone finds of them, what a camera's box makes of one or two
points, and what the picture alone tells.

Two lie in each BIN, at ranges and bearings that are drawn, apart from one another. All errors are of the range to the true
middle of what is over the water, the camera's from its own place. A buoy is found by
  lidar   a cluster with enough points, most of them its own
  faint   an obstacle with a cluster, or with a faint one that a box supports
  camera  a detection
  fused   an obstacle, by points or box.
"""
import math
import random
import statistics
import typing

import numpy

import figures
import outline
import poses
import sim_world
from kitti_messages import Clusters, lidar_points
from sim_stages import Stages
from usv_harbour import Scene

SECONDS, QUICK_SECONDS = 10.05, 2.05
BINS = ((5, 10), (10, 15), (15, 20), (20, 25), (25, 30), (30, 40))  # m, to the near side
EACH = 2
ASIDE = math.radians(42.0)
SYSTEMS = ("lidar", "faint", "camera", "fused")
SIZE = {"diameter": 0.5, "height": 1.0, "draught": 0.25}
BLACK = {"colour": [0.02, 0.02, 0.02], "reflectivity": 0.03}
# what the user knows of them
KNOWN = {"match": {"class_diameters": {"buoy": SIZE["diameter"]}},
         "detect": {"class_heights": {"buoy": SIZE["height"]}, "class_height_spreads": {"buoy": 0.1}}}


class Found(typing.NamedTuple):
    error: float  # m, range less the true one; NaN where it has none
    sigma: float  # m, as stated; NaN where nothing is


class Sample(typing.NamedTuple):
    """Of one buoy and cloud. None of a system that did not find it."""
    buoy: tuple  # seed, name
    face: float  # m, true range of its near side
    returns: int
    lidar: object = None
    faint: object = None
    camera: object = None
    fused: object = None


def world(seed):
    """The vessel and waves of usv_harbour among the buoys."""
    harbour, draw = sim_world.shipped("usv_harbour"), random.Random(seed)
    count = EACH * len(BINS)
    bearings = [ASIDE * (2 * (i + 0.5) / count - 1) for i in range(count)]
    draw.shuffle(bearings)
    x = float(sim_world.place_of(harbour, "lidar")[0])
    bodies = []
    for i, bearing in enumerate(bearings):
        away = draw.uniform(*BINS[i // EACH]) + SIZE["diameter"] / 2
        bodies.append({"name": f"buoy_{i}", "label": "buoy", "shape": "buoy", "params": SIZE, "material": BLACK, "floats": True,
                       "pose": [x + away * math.cos(bearing), away * math.sin(bearing), draw.uniform(-180, 180)]})
    return sim_world.at_anchor(harbour, "small", bodies)


def radial_sigma(obstacle):
    """[m] Along the ray to its position."""
    place = poses.vector(obstacle.position)
    ray = place / numpy.linalg.norm(place)
    variance = float(ray @ numpy.array(obstacle.position_covariance).reshape(3, 3) @ ray)
    return math.sqrt(variance) if variance > 0 else math.nan


def nearest(found):
    """Of several that stand for one buoy."""
    return min(found, key=lambda f: (math.isnan(f.error), abs(f.error)), default=None)


def samples(answer, seed, camera):
    """`camera`: its place [m] in the LiDAR's frame."""
    scene, obstacles = Scene(answer), answer.obstacles["optimal"].obstacles
    clusters = Clusters(answer.clusters["optimal"])
    body_of = [scene.body_of_points(points) for points in clusters.arrays]
    by_points = {o.id: scene.body_of_points(points) for o in obstacles
                 if (points := lidar_points(o, obstacles, clusters)) is not None}
    for number, body in answer.frame.bodies.items():
        middle = outline.middle(body)
        away, from_camera = numpy.linalg.norm(middle), numpy.linalg.norm(middle - camera)
        told = lambda some: nearest([Found(o.range - away, radial_sigma(o)) for o in some])
        lidar = [Found(c.range - away, math.nan) for c, of in zip(clusters.messages, body_of) if of == number and not c.faint]
        seen = [Found(d.range - from_camera, d.range_sigma) for d in answer.detections.detections
                if scene.detected.get(d.id) == number]
        points = [o for o in obstacles if by_points.get(o.id) == number]
        boxes = [o for o in obstacles if o.source == o.SOURCE_CAMERA and scene.detected.get(o.detection_id) == number]
        yield Sample((seed, body.name), outline.face_range(body), scene.hits[number], nearest(lidar), told(points),
                     nearest(seen), told(points or boxes))


def run(experiment, methods):
    """Samples of all seeds."""
    methods = {"optimal": methods["optimal"]}
    stages = Stages(experiment.session, experiment.folder, methods, KNOWN, experiment.given.model)
    out = []
    for seed in experiment.seeds:
        there = world(seed)
        camera = numpy.subtract(sim_world.place_of(there, "camera"), sim_world.place_of(there, "lidar"))
        bag = experiment.bag(there, QUICK_SECONDS if experiment.quick else SECONDS, seed, "--labels", "--mounts", "lidar", "camera")
        for answer in stages.play(bag):
            out += samples(answer, seed, camera)
        experiment.done(bag)
        experiment.say(f"small, seed {seed}: {len(out)} samples")
    stages.close()
    return out


def inside(sample, low, high):
    return low <= sample.face < high


def found_share(some, system):
    return statistics.fmean(getattr(s, system) is not None for s in some) if some else math.nan


def errors(some, system):
    """[m] Of those that have a range."""
    found = [getattr(s, system) for s in some]
    return [f.error for f in found if f is not None and not math.isnan(f.error)]


def mean_error(some, system):
    values = errors(some, system)
    return statistics.fmean(map(abs, values)) if values else math.nan


def within(some, system):
    """Share of the errors inside two of the stated sigmas."""
    found = [getattr(s, system) for s in some]
    known = [f for f in found if f is not None and not math.isnan(f.error) and not math.isnan(f.sigma)]
    return statistics.fmean(abs(f.error) <= 2 * f.sigma for f in known) if known else math.nan


def binned(all_samples):
    for low, high in BINS:
        some = [s for s in all_samples if inside(s, low, high)]
        if some:
            yield f"{low}_{high}m", some


COLUMNS = ("bin", "samples", "returns", *(f"{s}_found" for s in SYSTEMS), *(f"{s}_range_mae_m" for s in SYSTEMS),
           "camera_in_2_sigma", "fused_in_2_sigma")


def numbers(some):
    return (statistics.fmean(s.returns for s in some), *(found_share(some, s) for s in SYSTEMS),
            *(mean_error(some, s) for s in SYSTEMS), within(some, "camera"), within(some, "fused"))


def csv_rows(all_samples):
    return [(name, len(some), *numbers(some)) for name, some in binned(all_samples)]


def table(all_samples):
    yield f"{'black buoys':12}           found by                      mean error of range [m]        in 2 sigma"
    yield f"{'':12} returns  lidar  faint camera  fused     lidar  faint camera  fused    camera fused"
    for name, some in binned(all_samples):
        yield ("{:12} {:7.1f} {:6.2f} {:6.2f} {:6.2f} {:6.2f}    {:6.2f} {:6.2f} {:6.2f} {:6.2f}    {:6.2f} {:5.2f}".format(
            name.replace("_", "-", 1), *numbers(some)))


def figure(name, some, statistic, unit):
    """With an interval that draws whole buoys: the clouds of one are alike."""
    buoys = {}
    for s in some:
        buoys.setdefault(s.buoy, []).append(s)
    pooled = lambda drawn: statistic([s for group in drawn for s in group])
    defined = lambda drawn: -math.inf if math.isnan(value := pooled(drawn)) else value
    value = statistic(some)
    interval = (math.nan,) * 2 if math.isnan(value) else figures.bootstrap(list(buoys.values()), defined, 400)
    return figures.line(name, value, unit, len(some), interval)


def lines(all_samples):
    for name, some in (*binned(all_samples), ("all", all_samples)):
        for system in SYSTEMS:
            yield figure(f"usv/small/{system}/found/{name}", some, lambda these: found_share(these, system), "-")
            yield figure(f"usv/small/{system}/range_mae/{name}", some, lambda these: mean_error(these, system), "m")
        for system in ("camera", "fused"):
            yield figure(f"usv/small/{system}/in_2_sigma/{name}", some, lambda these: within(these, system), "-")
