"""Grid SLAM on recorded logs with relations and in the simulated office, through the nodelet: errors, maps, time, memory."""
import argparse
import os
import pathlib
import typing

import slam_office
import slam_report
import slam_stage
import sim_bag
import stage_run

TITLE = __doc__
COLUMNS = ("log", "seed", "translation mean [m]", "median [m]", "without the worst [m]", "rotation mean [deg]", "relations",
           "scans taken in", "CPU [ms] a scan", "peak memory [MB]")


class Log(typing.NamedTuple):
    name: str
    log: pathlib.Path
    relations: pathlib.Path
    ahead: float  # m, of the scanner before the odometry's centre


KNOWN = (("intel", "slam2d/intel_raw_910.clf", "slam2d/intel_exact910.relations", 0.1),)  # below FIELD_FUSION_DATA
PUBLISHED = {"intel": ("0.070 +- 0.083 m (Kuemmerle et al. 2009, all relations, 50 particles); on these relations the original "
                       "has 0.0356 m and 0.81 deg (mean of 3 seeds, 30 particles), its published poses 0.041 m")}


def log_of(text):
    parts = text.split(",")
    try:
        name, log, relations, ahead = parts
        return Log(name, pathlib.Path(log), pathlib.Path(relations), float(ahead))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not NAME,LOG,RELATIONS,AHEAD") from None


def options(parser):
    parser.add_argument("--log", type=log_of, action="append", metavar="NAME,LOG,RELATIONS,AHEAD",
                        help="other logs than those below FIELD_FUSION_DATA; AHEAD: m of the scanner before the odometry's centre")
    parser.add_argument("--parts", nargs="+", choices=("logs", "office"), default=("logs", "office"))
    parser.add_argument("--set", type=setting, action="append", default=[], metavar="NAME=VALUE", help="another parameter of the stage")


def setting(text):
    name, _, value = text.partition("=")
    try:
        return name, float(value) if "." in value else int(value)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not NAME=VALUE with a number") from None


def check(given):
    """Raises ValueError where a log is missing or a parameter is none."""
    if given.degrade:
        raise ValueError("--degrade is not for grid-slam: what is degraded there is the odometry, always")
    unknown = [name for name, _ in given.set if name not in stage_run.defaults("grid_slam")]
    if unknown:
        raise ValueError(f"grid_slam has no parameter {', '.join(unknown)}")
    data = os.environ.get("FIELD_FUSION_DATA")
    if "logs" in given.parts and not given.log:
        if not data:
            raise ValueError("no logs: FIELD_FUSION_DATA is not set; name some by --log, or run --parts office")
        given.log = [Log(name, pathlib.Path(data) / log, pathlib.Path(data) / relations, ahead)
                     for name, log, relations, ahead in KNOWN]
    for log in given.log or []:
        for file in (log.log, log.relations):
            if not file.is_file():
                raise ValueError(f"no such file: {file}")


def run(experiment):
    """Lines: tables, then figures."""
    tables, figures = [], []
    if "logs" in experiment.given.parts:
        for log in experiment.given.log:
            rows = [_scored(experiment, log, seed) for seed in experiment.seeds]
            experiment.table(f"grid_slam_{log.name}", COLUMNS, rows)
            tables += slam_report.table(log.name, rows, PUBLISHED.get(log.name))
            figures += slam_report.lines(log.name, rows)
    if "office" in experiment.given.parts:
        rows = slam_office.run(experiment)
        experiment.table("grid_slam_office", slam_office.COLUMNS, rows)
        tables += slam_office.table(rows)
        figures += slam_office.lines(rows)
    return tables + figures


def _scored(experiment, log, seed):
    """A row of COLUMNS."""
    bag = experiment.folder / f"{log.name}.bag"
    if not bag.exists():
        stage_run.tool("carmen_to_bag", log.log, bag, "--laser", log.ahead, 0, 0, quiet=True)
    done = slam_stage.run(experiment, bag, sim_bag.static_transforms(bag), seed, changes=dict(experiment.given.set))
    poses = experiment.folder / f"{log.name}_{seed}_poses.txt"
    slam_report.write_poses(poses, done.poses)
    if experiment.given.out and seed == experiment.seeds[0]:
        slam_report.picture(done.grid, done.poses, experiment.folder / f"{log.name}_map.png", log.name)
    score = slam_report.relations(poses, log.relations, log.ahead)
    experiment.say(f"{log.name}, seed {seed}: {score.translation:.4f} m, {score.rotation:.3f} deg, {done.cpu_ms:.1f} ms a scan")
    return (log.name, seed, *score, done.scans, done.cpu_ms, done.peak_mb)
