"""Quadruped paper (004), section 2.3: camera against LiDAR, 2-D scanner and inertial unit, from a board, beside the truth."""
import csv
import io
import math
import subprocess

import numpy
import yaml

import calibration_motion
import calibration_world
import figures
import poses
import sim_bag
import stage_run

TITLE = __doc__
PARTS = ("lidar", "imu")
POSES, QUICK_POSES = 30, 15
RUNS, QUICK_RUNS = 200, 50
CHI95 = 12.592  # 95 % of chi-square with 6 degrees of freedom
SENSORS = {  # what the tool is told: topic, and what errors of the ranges the data sheets let expect
    "camera_3d": ("/lidar/points", "lidar", ["--range-offset", "0.01"]),
    "camera_2d": ("/scan/scan", "scan", ["--range-offset", "0.005", "--range-scale", "0.003"]),
}
DRAWN = {  # the same sensors in the solver's own trial
    "camera_3d": ["--range-noise", "0.01", "--range-bias", "0.015"],
    "camera_2d": ["--flat", "--range-noise", "0.005", "--range-bias", "0.005", "--range-scale", "0.004"],
}
COLUMNS = ["seed", "sensor", "poses", "used", "rotation_deg", "translation_m", "sigma_deg", "sigma_m", "mahalanobis2"]


def options(parser):
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=PARTS,
                        help="lidar: camera against LiDAR and scanner; imu: camera against inertial unit (default: both)")


def check(given):
    del given  # nothing that can be wrong


def run(experiment):
    """Lines: tables, then figures."""
    tables, lines = [], []
    for part, told in (("lidar", _lidar), ("imu", _imu)):
        if part in experiment.given.parts:
            table, figures_of = told(experiment)
            tables += table
            lines += figures_of
    return tables + lines


def _imu(experiment):
    rows = [calibration_motion.row(experiment, seed) for seed in experiment.seeds]
    experiment.table("calibration_camera_imu", calibration_motion.COLUMNS, rows)
    return list(calibration_motion.table(rows)), list(calibration_motion.lines(rows))


def _lidar(experiment):
    rows = [row for seed in experiment.seeds for row in _seed(experiment, seed)]
    experiment.table("calibration", COLUMNS, rows)
    runs = {kind: _coverage(experiment, drawn) for kind, drawn in DRAWN.items()}
    return list(_table(rows)), list(_lines(rows, runs))


def _table(rows):
    yield "seed  sensor     poses  rotation  translation   stated    (one sigma)"
    for seed, kind, count, used, rotation, shift, sigma, sigma_shift, _ in rows:
        yield (f"{seed:4}  {kind}  {used:2} of {count}  {rotation:6.3f} deg  {1e3 * shift:6.1f} mm  "
               f"{sigma:6.3f} deg  {1e3 * sigma_shift:6.1f} mm")
    yield "The paper tells no error: its authors looked at overlays. coverage95 is of drawn boards that go to the solver alone."


def _lines(rows, runs):
    for kind in SENSORS:
        mine = [row for row in rows if row[1] == kind]
        yield figures.worst(f"calibration/{kind}/rotation_error", [row[4] for row in mine], "deg")
        yield figures.worst(f"calibration/{kind}/translation_error", [row[5] for row in mine], "m")
    for kind, squares in runs.items():
        yield figures.share(f"calibration/{kind}/coverage95", sum(s <= CHI95 for s in squares), len(squares))
    squares = [s for of_kind in runs.values() for s in of_kind]
    yield figures.share("calibration/coverage95", sum(s <= CHI95 for s in squares), len(squares))


def _seed(experiment, seed):
    count = QUICK_POSES if experiment.quick else POSES
    experiment.say(f"seed {seed}: {count} poses")
    world = calibration_world.world("calibration", seed, count)
    bag = experiment.bag(world, count * calibration_world.REST + 0.5, seed)
    out = [_calibrated(experiment, bag, seed, kind, count) for kind in SENSORS]
    experiment.done(bag)
    return out


def _calibrated(experiment, bag, seed, kind, count):
    topic, frame, more = SENSORS[kind]
    folder = experiment.folder / f"calibration_{seed}_{kind}"
    stage_run.tool("calibrate_lidar_camera", bag, "--board", calibration_world.BOARD, "--image", "/camera/image_raw",
                   "--camera-info", "/camera/camera_info", "--lidar", topic, "--out", folder, *more, quiet=True)
    result = yaml.safe_load((folder / "calibration.yaml").read_text())
    found, covariance = numpy.array(result["T_camera_lidar"]), numpy.array(result["covariance"])
    off = poses.chart(found, sim_bag.true_transform(bag, "camera_optical", frame))
    variances = numpy.diag(covariance)
    used = sum(pose["used"] for pose in result["poses"])
    return [seed, kind, count, used, math.degrees(numpy.linalg.norm(off[:3])), float(numpy.linalg.norm(off[3:])),
            math.degrees(math.sqrt(variances[:3].sum())), math.sqrt(variances[3:].sum()),
            float(off @ numpy.linalg.solve(covariance, off))]


def _coverage(experiment, drawn):
    runs = QUICK_RUNS if experiment.quick else RUNS
    done = subprocess.run(["rosrun", "field_fusion", "calibration_coverage", "--runs", str(runs), *drawn], check=True, text=True,
                          stdout=subprocess.PIPE)
    return [float(row["mahalanobis2"]) for row in csv.DictReader(io.StringIO(done.stdout))]
