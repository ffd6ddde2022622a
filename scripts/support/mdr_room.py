"""Points of scans against the walls of a room, on a walk that stamps and on turns on the spot."""
import math
import typing

import numpy

import figures
import mdr_worlds
import point_error
import poses
import walk_bag

RATES = (60, 180)  # deg/s, of the turns
TURNING = 0.9  # of the rate: scans that count, and begin and end so
PART_SECONDS, QUICK_SECONDS = 2.0, 6.0  # of which one interval of a figure resamples; of a walk
COLUMNS = ["case", "seed", "scans", "points", "rms_m", "range_noise_rms_m", "passed_on_raw"]
ROOM = point_error.Room(mdr_worlds.WALLS)


class Tally(typing.NamedTuple):
    case: str
    seed: int
    kind: str  # of scans: range (the error of the range alone), raw and the methods
    errors: list  # of arrays [m], one for each scan
    raw: int  # scans that were not deskewed


class Overlay(typing.NamedTuple):
    """Of one scan, in the world."""
    case: str
    place: numpy.ndarray  # of the scanner
    clouds: dict  # {kind: n x 2}


def run(experiment, stages, cases):
    """(tallies, overlays) of worlds {case: (world, seconds, whether a scan counts)}."""
    tallies, overlays = [], []
    for seed in experiment.seeds:
        for case, (world, seconds, counts) in cases.items():
            experiment.say(f"{case}, seed {seed}")
            bag = experiment.bag(world, seconds, seed, *mdr_worlds.MOUNTS)
            walk = walk_bag.read(bag)
            mine, overlay = _scored(case, seed, walk, stages.play(walk), counts)
            experiment.done(bag)
            tallies += mine
            overlays += [overlay] if seed == 1 and overlay else []
    return tallies, overlays


def walk_case(quick):
    return {"walk": (mdr_worlds.walk(), QUICK_SECONDS if quick else mdr_worlds.SECONDS["walk"], lambda walk, scan: True)}


def rotation_cases():
    def turns(rate):
        return lambda walk, scan: all(_turn_rate(walk, scan.begin + late) >= TURNING * rate for late in (0.0, scan.message.scan_time))

    return {f"rotation_{rate}": (mdr_worlds.rotation(rate), mdr_worlds.SECONDS["rotation"], turns(rate)) for rate in RATES}


def _turn_rate(walk, time, span=0.04):
    """[deg/s]"""
    step = numpy.linalg.inv(walk.truth.at(time - span / 2)) @ walk.truth.at(time + span / 2)
    return abs(math.degrees(poses.yaw(step))) / span


def _scored(case, seed, walk, answers, counts):
    errors, raw, overlay = {}, {}, None
    for scan, answer in zip(walk.scans, answers):
        if not counts(walk, scan):
            continue
        clouds = {"raw": walk_bag.returns(scan.message)[1], **{kind: deskewed.points for kind, deskewed in answer.items()}}
        errors.setdefault("range", []).append(ROOM.noise(walk, scan))
        for kind, points in clouds.items():
            errors.setdefault(kind, []).append(ROOM.errors(walk, scan, points))
            raw[kind] = raw.get(kind, 0) + (kind in answer and not answer[kind].done)
        T = point_error.T_world_scan(walk, scan)
        overlay = overlay or Overlay(case, T[:2, 3], {kind: poses.apply(T, points)[:, :2] for kind, points in clouds.items()})
    return [Tally(case, seed, kind, of_kind, raw.get(kind, 0)) for kind, of_kind in errors.items()], overlay


def csv_rows(tallies):
    noise = {(t.case, t.seed): point_error.rms(t.errors) for t in tallies if t.kind == "range"}
    return [[f"{t.case}/{t.kind}", t.seed, len(t.errors), sum(map(len, t.errors)), f"{point_error.rms(t.errors):.4f}",
             f"{noise[t.case, t.seed]:.4f}", t.raw] for t in tallies]


def table(tallies):
    kinds = list(dict.fromkeys(t.kind for t in tallies))
    yield "points off the walls, RMS  " + "".join(f"{kind:>10}" for kind in kinds)
    for case in dict.fromkeys(t.case for t in tallies):
        told = [point_error.rms(_errors(tallies, case, kind)) for kind in kinds]
        yield f"{case:25}  " + "".join(f"{value:8.3f} m" for value in told)


def lines(tallies):
    """Of the walk: what odometry leaves."""
    errors = _errors(tallies, "walk", "mdr")
    whole = max(1, round(PART_SECONDS / 0.1))
    parts = [numpy.concatenate(errors[i:i + whole]) for i in range(0, len(errors), whole)]
    yield figures.line("quadruped/walk/residual_rms", point_error.rms(errors), "m", sum(map(len, parts)),
                       figures.bootstrap(parts, point_error.rms, 400))


def _errors(tallies, case, kind):
    return [errors for t in tallies if (t.case, t.kind) == (case, kind) for errors in t.errors]
