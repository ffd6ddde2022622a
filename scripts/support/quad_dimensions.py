"""Quadruped paper (004), section 5.2: ten marked dimensions of the laboratory on maps of raw and of deskewed scans (MDR)."""
import math
import typing

import numpy

import figures
import map_lines
import poses
import sim_world
import slam_stage
import stage_run
import walk_bag
from deskew_stages import DeskewStages, Method

SECONDS = 28.0  # of the walk, once round
# A quick trot whose body swings by 4 degrees with each stride, in place of the world's 0.5 m/s, 60 deg/s and 0.7 degrees: set so that
# raw scans give maps about as wrong as the paper's; a swing of 5 degrees is too much (docs/results.md).
STRIDE = [{"frequency": 2.0, "roll_deg": 1.5, "yaw_deg": 4.0, "y": 0.006},
          {"frequency": 4.0, "pitch_deg": 1.0, "x": 0.003, "z": 0.008, "phase_deg": 40}]  # else the preset `gait`
GAIT = {"speed": 1.2, "acceleration": 1.0, "turn_rate_deg": 120, "shake": STRIDE}
RESOLUTION = 0.025  # m
KINDS = ("raw", "mdr")
PAPER = {"raw": 109, "mdr": 59}  # mm, RMSE
# How each is measured, as by a person who knows what stands there; all others go from face to face.
ALONG, ROUND = ("a_box_1_length", "b_box_1_length"), ("d_barrels",)
# The scales that are drawn and that no map can tell: of ranges and of the odometry's way.
SCALES = {"scan": {"range_scale": 0.0}, "odom": {"scale_error": 0.0}}
COLUMNS = ("seed", "scans", "scale drawn", "dimension", "true [m]", "measured [m]")


class Row(typing.NamedTuple):
    seed: int
    kind: str  # raw or mdr
    scaled: bool  # whether scales were drawn
    name: str
    true: float  # m
    measured: float  # m; NaN: not found in the map

    @property
    def error(self):
        return self.measured - self.true


def world(scaled):
    """The laboratory, walked by the gait of this experiment; not `scaled`: the scales are 1, all else being drawn the same."""
    lab = sim_world.shipped("quad_lab")
    walked = {**lab, "name": f"lab_{'scaled' if scaled else 'unscaled'}",
              "robot": {**lab["robot"], "motion": {**lab["robot"]["motion"], **GAIT}}}
    return walked if scaled else sim_world.with_mounts(walked, SCALES)


def true_length(dimension):
    return float(numpy.linalg.norm(numpy.subtract(dimension["to"], dimension["from"])))


def measure(drawn, dimension):
    """[m]"""
    name = dimension["name"]
    by = map_lines.along_face if name in ALONG else map_lines.between_middles if name in ROUND else map_lines.between_faces
    return by(drawn, dimension["from"], dimension["to"])


def found(rows):
    return [row for row in rows if not math.isnan(row.error)]


def rmse(rows):
    """[m] of those that were found; NaN of none."""
    errors = [row.error for row in found(rows)]
    return math.sqrt(sum(error ** 2 for error in errors) / len(errors)) if errors else math.nan


def run(experiment):
    """Lines: a table, then figures."""
    rows = []
    for seed in experiment.seeds:
        for scaled in (False,) if experiment.quick else (False, True):
            rows += _seed(experiment, seed, scaled)
        experiment.table("quadruped_dimensions", COLUMNS, rows)  # what there is, should it be interrupted
    return [*table(rows), *lines(rows)]


def _seed(experiment, seed, scaled):
    bag = experiment.bag(world(scaled), SECONDS, seed, "--mounts", "scan", "odom")
    walk = walk_bag.read(bag)
    experiment.done(bag)
    stages = DeskewStages(experiment.session, experiment.folder, {"mdr": Method("odometry", {})})
    try:  # they end before others listen to the same transforms
        scans = {"raw": [], "mdr": []}
        for scan, answer in zip(walk.scans, stages.play(walk)):
            scans["raw"].append(scan.message)
            scans["mdr"].append(answer["mdr"].scan)
    finally:
        stages.close()
    maps = {kind: _map(experiment, of_kind, walk, seed) for kind, of_kind in scans.items()}
    rows = [Row(seed, kind, scaled, dimension["name"], true_length(dimension), measure(drawn, dimension))
            for kind, drawn in maps.items() for dimension in world(scaled)["dimensions"]]
    if experiment.given.out and not scaled:
        import quad_lab_pictures  # matplotlib only where a picture is asked for

        quad_lab_pictures.maps(maps, world(scaled)["dimensions"], rows, experiment.folder / f"quadruped_lab_{seed}.png")
    experiment.say(f"dimensions, seed {seed}, scales {'drawn' if scaled else 'removed'}: " + ", ".join(
        f"{kind} {1e3 * rmse([row for row in rows if row.kind == kind]):.0f} mm" for kind in KINDS))
    return rows


def _map(experiment, scans, walk, seed):
    fed = ((poses.flat(walk.odometry.at(scan.header.stamp.to_sec())), scan) for scan in scans)
    changes = {**stage_run.shipped_robot("quadruped")["grid_slam"], "resolution": RESOLUTION}
    done = slam_stage.run_pairs(experiment, fed, walk.static, seed, changes)
    T_world_base = poses.level(walk.truth.at(walk.scans[0].begin))
    return map_lines.Map(done.grid, T_world_base @ numpy.linalg.inv(poses.planar(*done.poses[0][1])))


def of(rows, kind, scaled):
    return [row for row in rows if (row.kind, row.scaled) == (kind, scaled)]


def table(rows):
    """Of each dimension the mean error and the RMSE over the seeds."""
    seeds = len({row.seed for row in rows})
    yield f"ten dimensions of the laboratory, scales removed, seeds: {seeds}; mean error and RMSE [mm]"
    yield f"{'dimension':20} {'true':>8}   " + "   ".join(f"{kind:>14}" for kind in KINDS)
    for name in dict.fromkeys(row.name for row in rows):
        mine = [row for row in rows if row.name == name]
        told = [of(mine, kind, False) for kind in KINDS]
        yield f"{name:20} {mine[0].true:6.3f} m   " + "   ".join(
            f"{1e3 * _mean(some):+7.0f} {1e3 * rmse(some):6.0f}" for some in told)
    for scaled in sorted({row.scaled for row in rows}):
        yield f"RMSE, scales {'drawn  ' if scaled else 'removed'}              " + "   ".join(
            f"{1e3 * rmse(of(rows, kind, scaled)):14.0f}" for kind in KINDS)
    yield "paper, RMSE                       " + "   ".join(f"{PAPER[kind]:14}" for kind in KINDS)
    less = lambda raw, mdr: 100 * (1 - mdr / raw)
    yield (f"MDR errs by {less(*(rmse(of(rows, kind, False)) for kind in KINDS)):.1f} % less (paper: "
           f"{less(*PAPER.values()):.1f} %)")
    yield ""


def _mean(rows):
    errors = [row.error for row in found(rows)]
    return sum(errors) / len(errors) if errors else math.nan


def lines(rows):
    for scaled in sorted({row.scaled for row in rows}, reverse=True):
        for kind in KINDS:
            mine, suffix = of(rows, kind, scaled), "_with_scale" if scaled else ""
            yield figures.share(f"pmf/dimensions/{kind}_found{suffix}", len(found(mine)), len(mine))
            yield _line(f"pmf/dimensions/{kind}_rmse{suffix}", mine)


def _line(name, rows):
    """Its interval resamples whole seeds."""
    seeds = [[row for row in rows if row.seed == seed] for seed in dict.fromkeys(row.seed for row in rows)]
    interval = figures.bootstrap(seeds, lambda drawn: 1e3 * rmse(sum(drawn, [])))
    return figures.line(name, 1e3 * rmse(rows), "mm", len(found(rows)), interval)
