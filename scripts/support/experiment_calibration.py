"""Quadruped paper (004), section 2.3: camera against LiDAR and against 2-D scanner, from boards at rest, beside the truth."""
import csv
import io
import math
import subprocess

import numpy
import rosbag
import yaml

import calibration_world
import figures
import poses
import stage_run

TITLE = __doc__
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
    del parser  # none of its own


def check(given):
    del given  # nothing that can be wrong


def run(experiment):
    rows = [row for seed in experiment.seeds for row in _seed(experiment, seed)]
    experiment.table("calibration", COLUMNS, rows)
    runs = {kind: _coverage(experiment, drawn) for kind, drawn in DRAWN.items()}
    yield "seed  sensor     poses  rotation  translation   stated    (one sigma)"
    for seed, kind, count, used, rotation, shift, sigma, sigma_shift, _ in rows:
        yield (f"{seed:4}  {kind}  {used:2} of {count}  {rotation:6.3f} deg  {1e3 * shift:6.1f} mm  "
               f"{sigma:6.3f} deg  {1e3 * sigma_shift:6.1f} mm")
    yield "The paper tells no error: its authors looked at overlays. coverage95 is of drawn boards that go to the solver alone."
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
    off = error(found, true_transform(bag, "camera_optical", frame))
    variances = numpy.diag(covariance)
    used = sum(pose["used"] for pose in result["poses"])
    return [seed, kind, count, used, math.degrees(numpy.linalg.norm(off[:3])), float(numpy.linalg.norm(off[3:])),
            math.degrees(math.sqrt(variances[:3].sum())), math.sqrt(variances[3:].sum()),
            float(off @ numpy.linalg.solve(covariance, off))]


def error(found, truth):
    """(turn [rad], shift [m]) x with truth = found * motion(x), as the covariance is of."""
    step = numpy.linalg.inv(found) @ truth
    axis = numpy.array([step[2, 1] - step[1, 2], step[0, 2] - step[2, 0], step[1, 0] - step[0, 1]]) / 2
    sine = numpy.linalg.norm(axis)
    angle = math.atan2(sine, (numpy.trace(step[:3, :3]) - 1) / 2)
    return numpy.concatenate([axis * (angle / sine if sine > 0 else 1.0), step[:3, 3]])


def true_transform(bag_file, target, source):
    """T_target_source by where the mounts truly are: all frames hang on the base by a chain."""
    with rosbag.Bag(str(bag_file)) as bag:
        transforms = [t for _, message, _ in bag.read_messages(topics=["/truth/tf_static"]) for t in message.transforms]
    parents = {t.child_frame_id: (t.header.frame_id, poses.matrix(t.transform.translation, t.transform.rotation))
               for t in transforms}

    def in_base(frame):
        T = numpy.eye(4)
        while frame in parents:
            frame, T_parent_frame = parents[frame]
            T = T_parent_frame @ T
        return T

    return numpy.linalg.inv(in_base(target)) @ in_base(source)


def _coverage(experiment, drawn):
    runs = QUICK_RUNS if experiment.quick else RUNS
    done = subprocess.run(["rosrun", "field_fusion", "calibration_coverage", "--runs", str(runs), *drawn], check=True, text=True,
                          stdout=subprocess.PIPE)
    return [float(row["mahalanobis2"]) for row in csv.DictReader(io.StringIO(done.stdout))]
