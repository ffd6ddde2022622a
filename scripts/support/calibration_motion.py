"""Camera against inertial unit: a world in which both are moved by hand before a board at rest, and how far off the answer is."""
import math
import random

import numpy
import rosbag
import yaml

import calibration_world
import figures
import poses
import sim_bag
import stage_run

SECONDS = {False: 20.0, True: 6.0}  # of a recording; with --quick
MOUNTS = ("--mounts", "camera", "imu")
RATE = 10.0  # pictures a second
AWAY = 1.5  # m from the camera to the board
HEIGHT = 0.6  # m of the hands
CLOCK = 0.02  # s by which the camera's clock is off at most
COLUMNS = ["seed", "pictures", "rotation_deg", "translation_m", "time_s", "sigma_deg", "sigma_m", "sigma_s", "mahalanobis2"]
KALIBR = "Kalibr's authors: time offsets 'up to a fraction of the smallest measurement period' (Furgale et al. 2013), here 5 ms."


def world(name, seed):
    """Turned by up to 20 degrees and shifted by up to 0.15 m, back and forth at 0.4 to 1.4 Hz, about and along all axes."""
    draw = random.Random(seed)
    shake = [{"frequency": draw.uniform(*between), "phase_deg": draw.uniform(-180, 180), key: size}
             for key, size in (("roll_deg", 13), ("pitch_deg", 13), ("yaw_deg", 13), ("x", 0.1), ("y", 0.1), ("z", 0.1))
             for between, size in (((0.4, 0.8), size), ((0.9, 1.4), size / 2))]
    wall = lambda name, length, pose: {"name": name, "shape": "wall", "params": {"length": length, "height": 3}, "pose": pose}
    return {
        "name": name,
        "ground": {"kind": "plane", "material": {"colour": [0.4, 0.4, 0.38], "reflectivity": 0.4}},
        "light": {"sun": 0.3, "sky": 0.8},
        "bodies": [wall("ahead", 12, [6, 0, 90]), wall("left", 14, [0, 6, 0]), wall("right", 14, [0, -6, 0]),
                   {"name": "board", "shape": "checkerboard", "pose": [AWAY + 0.1, 0, HEIGHT - calibration_world.HIGH / 2, 180],
                    "params": {"width": calibration_world.WIDE, "height": calibration_world.HIGH}}],
        "robot": {"name": "hands", "pose": [0, 0, HEIGHT, 0], "motion": {"shake": shake}, "mounts": [
            {"name": "camera", "model": "wide_105", "pose": [0.1, 0, 0], "rate": RATE, "samples": 2, "clock_error": CLOCK},
            {"name": "imu", "model": "bmi055", "pose": [0.02, -0.06, -0.05, 0, 0, 90]}]}}


def row(experiment, seed):
    """COLUMNS of one recording."""
    experiment.say(f"seed {seed}: camera and inertial unit moved before a board")
    bag = experiment.bag(world("calibration_motion", seed), SECONDS[experiment.quick], seed, *MOUNTS)
    folder = experiment.folder / f"calibration_{seed}_camera_imu"
    stage_run.tool("calibrate_camera_imu", bag, "--board", calibration_world.BOARD, "--out", folder, quiet=True)
    result = yaml.safe_load((folder / "calibration.yaml").read_text())
    off, covariance = error(result, bag), numpy.array(result["covariance"])
    experiment.done(bag)
    variances = numpy.diag(covariance)
    return [seed, result["pictures"], math.degrees(numpy.linalg.norm(off[:3])), float(numpy.linalg.norm(off[3:6])), abs(off[6]),
            math.degrees(math.sqrt(variances[:3].sum())), math.sqrt(variances[3:6].sum()), math.sqrt(variances[6]),
            float(off @ numpy.linalg.solve(covariance, off))]


def error(result, bag):
    """(turn [rad], shift [m], offset [s]) of the truth from what was found, as the covariance is of."""
    found = numpy.array(result["T_camera_imu"])
    step = poses.chart(found, sim_bag.true_transform(bag, "camera_optical", "imu"))
    return numpy.array([*step, true_offset(bag) - result["time_offset"]])


def true_offset(bag_file):
    """[s] Both begin at one instant: their first stamps differ by what their clocks do."""
    with rosbag.Bag(str(bag_file)) as bag:
        first = lambda topic: next(message for _, message, _ in bag.read_messages(topics=[topic])).header.stamp
        return (first("/imu/data") - first("/camera/camera_info")).to_sec()


def table(rows):
    yield "seed  camera_imu  pictures  rotation  translation     time   stated    (one sigma)"
    for seed, count, rotation, shift, time, sigma, sigma_shift, sigma_time, _ in rows:
        yield (f"{seed:4}  camera_imu  {count:8}  {rotation:5.3f} deg  {1e3 * shift:6.1f} mm  {1e3 * time:6.3f} ms  "
               f"{sigma:6.3f} deg  {1e3 * sigma_shift:6.1f} mm  {1e3 * sigma_time:6.3f} ms")
    yield KALIBR


def lines(rows):
    for what, column, unit in (("rotation", 2, "deg"), ("translation", 3, "m"), ("time", 4, "s")):
        yield figures.worst(f"calibration/camera_imu/{what}_error", [row[column] for row in rows], unit)
