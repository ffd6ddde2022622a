"""One cage at known places, 10 s of bag at each, through the nodelets."""
import copy
import math
import random
import statistics
import typing

import numpy

import figures
import outline
import poses
import sim_world
from sim_stages import Stages

SECONDS = 10.05  # of each bag: 100 clouds
# Paper 001, Table I: place, distance [m], angle [deg, clockwise], errors of both. 0230 is 2 m, 30 degrees.
PAPER = (("0200", 2.22, 0.23, 0.22, 0.23), ("0230", 2.23, 29.73, 0.23, 0.27), ("0300", 3.15, 0.49, 0.15, 0.49),
         ("0320", 3.28, 19.60, 0.28, 0.40), ("0410", 4.31, 9.36, 0.31, 0.64), ("0420", 4.24, 19.31, 0.24, 0.69),
         ("0510", 5.35, 10.73, 0.35, 0.73), ("a0210", 2.22, -10.08, 0.22, 0.08), ("a0310", 3.25, -10.75, 0.25, 0.75),
         ("a0420", 4.26, -20.97, 0.26, 0.97))
QUICK = ("0200", "0320", "0510", "a0210")
COLUMNS = ("place", "seed", "frames", "found", "true_face_m", "true_centre_m", "true_azimuth_deg",
           "face_error_m", "centre_error_m", "angle_error_deg", "paper_distance_m", "paper_distance_error_m", "paper_angle_error_deg")


class Errors(typing.NamedTuple):
    """Of one cloud: ours, and the paper's method by the paper's measure. NaN where the cage was not found."""
    face: float  # m, range to the nearest of it
    centre: float  # m, range to its middle
    angle: float  # rad, azimuth of its middle
    paper_distance: float  # m, range to the middle of the axis-aligned box, against that to the nearest of the cage
    paper_angle: float  # rad


class Row(typing.NamedTuple):
    """Of one place: medians over its clouds."""
    place: str
    seed: int
    frames: int
    found: int
    truth: tuple  # ranges [m] of face and centre, azimuth [rad]
    errors: Errors


def table_world(place, seed):
    """usv_cages with the cage at one of its places, turned as drawn."""
    world = sim_world.shipped("usv_cages")
    cage = next(body for body in world["bodies"] if body["name"] == "cage")
    points = cage.pop("motion")["points"]
    names = [name for name, *_ in PAPER]
    x, y, z = points[names.index(place)]["at"]
    cage["pose"] = [x, y, z, random.Random(f"{place} {seed}").uniform(-180.0, 180.0)]
    return {**world, "name": f"cage_{place}"}


FAR = 30  # places
NEAREST, FARTHEST, ASIDE = 2.0, 30.0, 45.0  # m to the near face, deg to both sides
CAGE = {"name": "cage", "label": "cage", "shape": "cage", "params": {"diameter": 2.0}, "floats": True}


def far_world(place, seed):
    """The vessel and the waves of usv_harbour, and one cage of 2 m; it lies turned as drawn. Places are spread evenly
    over ranges and, by the golden section, over angles."""
    world = sim_world.shipped("usv_harbour")
    share = (place + 0.5) / FAR
    away = NEAREST + share * (FARTHEST - NEAREST) + CAGE["params"]["diameter"] / 2
    aside = math.radians(ASIDE * (2.0 * math.fmod(place * 0.6180339887, 1.0) - 1.0))
    lidar = next(mount["pose"] for mount in world["robot"]["mounts"] if mount["name"] == "lidar")
    yaw = random.Random(f"far {place} {seed}").uniform(-180.0, 180.0)
    robot = {**world["robot"], "pose": [0, 0, 0]}
    del robot["motion"]
    cage = {**CAGE, "pose": [lidar[0] + away * math.cos(aside), lidar[1] + away * math.sin(aside), 0, yaw]}
    return {**world, "name": f"far_{place:02}", "bodies": [cage], "robot": robot}


def measured(answer):
    body = next(body for body in answer.frame.bodies.values() if body.label == "cage")
    face, (centre, azimuth, _) = outline.face_range(body), poses.polar(outline.middle(body))
    ours, papers = (found(answer, method) for method in ("optimal", "paper"))
    nothing = (math.nan,) * 3
    near, far, angle = (poses.length(ours[0].face), ours[0].range, ours[0].azimuth) if ours else nothing
    paper, paper_angle = (papers[1].range, papers[1].azimuth) if papers else nothing[:2]
    turn = lambda a: math.remainder(a - azimuth, math.tau)
    return (face, centre, azimuth), Errors(near - face, far - centre, turn(angle), paper - face, turn(paper_angle))


def found(answer, method):
    """(obstacle, cluster) that both sensors call a cage, of several the surest; None without."""
    both = [o for o in answer.obstacles[method].obstacles if o.source == o.SOURCE_BOTH and o.label == "cage"]
    best = max(both, key=lambda o: o.label_probability, default=None)
    return best and (best, answer.clusters[method].clusters[best.cluster_id])


def median(values):
    known = [value for value in values if not math.isnan(value)]
    return statistics.median(known) if known else math.nan


def row(place, seed, answers):
    pairs = [measured(answer) for answer in answers]
    errors = [errors for _, errors in pairs]
    return Row(place, seed, len(pairs), sum(not math.isnan(e.face) for e in errors),
               tuple(median(column) for column in zip(*(truth for truth, _ in pairs))),
               Errors(*map(median, zip(*errors))))


class Part(typing.NamedTuple):
    name: str
    places: tuple
    quick: tuple
    world: object  # of (place, seed)
    cage: dict  # what the user knows of it [m]: diameter, net, height


TABLE = Part("table1", tuple(name for name, *_ in PAPER), QUICK, table_world, {"diameter": 0.5, "net": 0.31, "height": 0.8})
FURTHER = Part("far", tuple(range(FAR)), (2, 9, 16, 23, 29), far_world, {"diameter": 2.0, "net": 1.36, "height": 1.0})


def run(experiment, methods, part):
    sizes = {"class_diameters": {"cage": part.cage["diameter"]}, "class_nets": {"cage": part.cage["net"]}}
    changes = {"match": sizes, "detect": {"class_heights": {"cage": part.cage["height"]}}}
    stages = Stages(experiment.session, experiment.folder, methods, changes, experiment.given.model)
    rows = []
    for seed in experiment.seeds:
        for place in part.quick if experiment.quick else part.places:
            # sizes and mounts are drawn anew at each place: ten cages tell more than one
            bag = experiment.bag(part.world(place, seed), SECONDS, 100 * seed + part.places.index(place))
            rows.append(row(place, seed, stages.play(bag)))
            experiment.done(bag)
            r=rows[-1]
            print(place, seed, r.frames, r.found, ["%.3f"%v for v in r.truth], ["%+.3f"%v for v in r.errors[:2]], "%.3f deg"%math.degrees(r.errors[2]), flush=True)
    stages.close()
    return report(rows, part)


def report(rows, part):
    for name, unit, pick in (("face", "m", lambda e: e.face), ("centre", "m", lambda e: e.centre),
                             ("angle", "deg", lambda e: math.degrees(e.angle)),
                             ("paper_distance", "m", lambda e: e.paper_distance),
                             ("paper_angle", "deg", lambda e: math.degrees(e.paper_angle))):
        yield figures.mean(f"usv/{part.name}/{name}_mae", [abs(pick(row.errors)) for row in rows], unit)
