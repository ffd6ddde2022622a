"""The simulated office: a way round with a look into every room, by odometry that drifts; error of the whole trajectory."""
import math
import statistics

import numpy
import rosbag

import figures
import sim_bag
import sim_world
import slam_report
import slam_stage
from slam_stage import between, compose, planar

SECONDS = {False: 266.0, True: 20.0}  # of the bag, whole (the robot moves so long) and with --quick
EVERY = 5  # of 50 scans a second
COLUMNS = ("seed", "way [m]", "odometry off at the end [m]", "RMSE [m]", "scans taken in", "CPU [ms] a scan", "peak memory [MB]")


def run(experiment):
    return [_run(experiment, seed) for seed in experiment.seeds]


def _run(experiment, seed):
    """A row of COLUMNS."""
    world = sim_world.shipped("office")
    bag = experiment.bag(world, SECONDS[experiment.quick], seed, "--mounts", "scan", "odom")
    done = slam_stage.run(experiment, bag, sim_bag.static_transforms(bag), seed, "/scan/scan", EVERY,
                          dict(experiment.given.set))
    truth = _truth(bag, [stamp for stamp, _ in done.poses])
    odometry = [pose for pose, _ in slam_stage.pairs(bag, "/scan/scan", EVERY)]
    if experiment.given.out and seed == experiment.seeds[0]:
        slam_report.picture(done.grid, done.poses, experiment.folder / "office_map.png", "office")
    experiment.done(bag)
    row = (seed, _way(truth), _off(odometry, truth)[-1], rmse([pose for _, pose in done.poses], truth), done.scans, done.cpu_ms,
           done.peak_mb)
    experiment.say(f"office, seed {seed}: {row[1]:.0f} m, odometry {row[2]:.2f} m off, RMSE {row[3]:.4f} m")
    return row


def _truth(bag_file, stamps):
    with rosbag.Bag(str(bag_file)) as bag:
        poses = [(m.header.stamp.to_nsec(), planar(m.pose.pose)) for _, m, _ in bag.read_messages(topics=["/truth/pose"])]
    times = numpy.array([stamp for stamp, _ in poses]) - stamps[0]
    values = numpy.array([pose for _, pose in poses])
    values[:, 2] = numpy.unwrap(values[:, 2])
    at = numpy.array(stamps) - stamps[0]
    return numpy.array([numpy.interp(at, times, values[:, k]) for k in range(3)]).T


def _off(poses, truth):
    """[m] of each pose from the true one, the first laid on it."""
    first = compose(truth[0], between(poses[0], numpy.zeros(3)))
    return [math.hypot(*(compose(first, pose) - true)[:2]) for pose, true in zip(poses, truth)]


def rmse(poses, truth):
    return math.sqrt(statistics.fmean(off * off for off in _off(poses, truth)))


def _way(truth):
    return float(numpy.hypot(*numpy.diff(truth[:, :2], axis=0).T).sum())


def table(rows):
    lines = ["office: root mean square error of the trajectory, the first pose laid on the true one (Gmapping: 0.04 to 0.16 m)",
             "seed    way   odometry at the end     RMSE   CPU a scan   memory"]
    return lines + [f"{seed:4}  {way:4.0f} m  {off:15.2f} m   {error:.4f} m  {cpu:6.1f} ms  {memory:6.0f} MB"
                    for seed, way, off, error, _, cpu, memory in rows] + [""]


def lines(rows):
    errors = [row[3] for row in rows]
    return [figures.median("slam/office/rmse_median", errors, "m"), figures.worst("slam/office/rmse_worst", errors, "m"),
            figures.median("slam/office/cpu", [row[5] for row in rows], "ms"),
            figures.worst("slam/office/memory", [row[6] for row in rows], "MB")]
