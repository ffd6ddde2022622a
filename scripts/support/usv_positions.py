"""One cage at known places, 10 s of bag at each, through the nodelets.

Ranges are 3-D, from the LiDAR's true place, azimuths in its true frame, at the stamp of each cloud. The true face is the
nearest point of the cage's outline, an upright cylinder; the true centre, the middle of what of it is over the ground or
the water. No stage averages over time: what counts of a place is the median over the clouds of its bag, as the paper's
table has one line for each, and the errors of single clouds are told beside it.
"""
import math
import random
import statistics
import typing

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
FAR = 30  # places
NEAREST, FARTHEST, ASIDE = 2.0, 30.0, 45.0  # m to the near face, deg to both sides
CAGE = {"name": "cage", "label": "cage", "shape": "cage", "params": {"diameter": 2.0}, "floats": True}


class Errors(typing.NamedTuple):
    """Ours, and the paper's method by the paper's measure. NaN where the cage was not found."""
    face: float  # m, range to the nearest of it
    centre: float  # m, range to its middle
    angle: float  # deg, azimuth of its middle
    paper_distance: float  # m, range to the middle of the axis-aligned box, against that to the nearest of the cage
    paper_angle: float  # deg


class Row(typing.NamedTuple):
    """Of one place: medians over its clouds."""
    place: object
    seed: int
    frames: int
    found: int
    paper_found: int  # by the paper's method
    face: float  # m, true range
    centre: float  # m, true range
    azimuth: float  # deg, true
    errors: Errors
    single: Errors  # mean absolute errors of the clouds in which the cage was found


class Part(typing.NamedTuple):
    """Of the experiment. `cage`: what its user knows of it [m]."""
    name: str
    places: tuple
    quick: tuple
    world: object  # of (place, seed)
    cage: dict


def table_world(place, seed):
    """usv_cages with the cage at one of its places, turned as drawn."""
    world = sim_world.shipped("usv_cages")
    cage = next(body for body in world["bodies"] if body["name"] == "cage")
    x, y, z = cage.pop("motion")["points"][[name for name, *_ in PAPER].index(place)]["at"]
    cage["pose"] = [x, y, z, drawn_yaw(place, seed)]
    return {**world, "name": f"cage_{place}"}


def far_world(place, seed):
    """The vessel and the waves of usv_harbour, and one cage of 2 m; it lies turned as drawn. Places are spread evenly
    over ranges and, by the golden section, over angles."""
    world = sim_world.shipped("usv_harbour")
    away = NEAREST + (place + 0.5) / FAR * (FARTHEST - NEAREST) + CAGE["params"]["diameter"] / 2
    aside = math.radians(ASIDE * (2.0 * math.fmod(place * 0.6180339887, 1.0) - 1.0))
    lidar = sim_world.place_of(world, "lidar")
    cage = {**CAGE, "pose": [lidar[0] + away * math.cos(aside), lidar[1] + away * math.sin(aside), 0, drawn_yaw(place, seed)]}
    return sim_world.at_anchor(world, f"far_{place:02}", [cage])


def drawn_yaw(place, seed):
    return random.Random(f"{place} {seed}").uniform(-180.0, 180.0)


TABLE = Part("table1", tuple(name for name, *_ in PAPER), ("0200", "0320", "0510", "a0210"), table_world,
             {"diameter": 0.5, "net": 0.31, "height": 0.8})
FURTHER = Part("far", tuple(range(FAR)), (2, 9, 16, 23, 29), far_world, {"diameter": 2.0, "net": 1.36, "height": 1.0})


def found(answer, method):
    """The obstacle that both sensors call a cage, of several the surest, and its cluster; None without."""
    both = [o for o in answer.obstacles[method].obstacles if o.source == o.SOURCE_BOTH and o.label == "cage"]
    best = max(both, key=lambda o: o.label_probability, default=None)
    return best and (best, answer.clusters[method].clusters[best.cluster_id])


def measured(answer):
    """(true range of the face, of the centre, true azimuth [deg], Errors) of one cloud."""
    body = next(body for body in answer.frame.bodies.values() if body.label == "cage")
    face, (centre, azimuth, _) = outline.face_range(body), poses.polar(outline.middle(body))
    ours, papers = (found(answer, method) for method in ("optimal", "paper"))
    near, far, angle = (poses.length(ours[0].face), ours[0].range, ours[0].azimuth) if ours else (math.nan,) * 3
    paper, paper_angle = (papers[1].range, papers[1].azimuth) if papers else (math.nan,) * 2
    turn = lambda a: math.degrees(math.remainder(a - azimuth, math.tau))
    return face, centre, math.degrees(azimuth), Errors(near - face, far - centre, turn(angle), paper - face, turn(paper_angle))


def known(values):
    return [value for value in values if not math.isnan(value)]


def median(values):
    return statistics.median(known(values) or [math.nan])


def row(place, seed, answers):
    faces, centres, azimuths, errors = zip(*map(measured, answers))
    columns = list(zip(*errors))
    single = [statistics.fmean(map(abs, known(column) or [math.nan])) for column in columns]
    return Row(place, seed, len(errors), len(known(columns[0])), len(known(columns[3])), median(faces), median(centres), median(azimuths),
               Errors(*map(median, columns)), Errors(*single))


def chosen(experiment, part):
    if experiment.given.places:
        return [place for place in part.places if str(place) in experiment.given.places]
    return part.quick if experiment.quick else part.places


def run(experiment, methods, part):
    """A Row for each place and seed."""
    changes = {"match": {"class_diameters": {"cage": part.cage["diameter"]}, "class_nets": {"cage": part.cage["net"]}},
               "detect": {"class_heights": {"cage": part.cage["height"]}}}
    stages = Stages(experiment.session, experiment.folder, methods, changes, experiment.given.model)
    rows = []
    for seed in experiment.seeds:
        for place in chosen(experiment, part):
            # sizes and mounts are drawn anew at each place: ten cages tell more than one
            bag = experiment.bag(part.world(place, seed), SECONDS, 100 * seed + part.places.index(place))
            rows.append(row(place, seed, stages.play(bag)))
            experiment.done(bag)
            experiment.say("{0.place:>6} seed {0.seed}: found in {0.found} of {0.frames}, at {0.face:.2f} m: face {1.face:+.3f} m, "
                           "centre {1.centre:+.3f} m, angle {1.angle:+.2f} deg".format(rows[-1], rows[-1].errors)
                           if rows[-1].found else "{0.place:>6} seed {0.seed}: not found in {0.frames}".format(rows[-1]))
    stages.close()
    return rows
