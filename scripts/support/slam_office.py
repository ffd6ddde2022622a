"""The simulated office: a way round with a look into every room, by odometry that drifts; error of the whole trajectory.

It is the scanner's: how it truly sits on the robot nobody knows, and an angle of 0.2 degrees there would turn the whole map
about the start. Told with the first pose laid on the true one, and with the trajectory laid on the true one as a whole (ATE:
absolute trajectory error, Sturm et al. 2012)."""
import math

import numpy
import rosbag

import figures
import poses
import sim_bag
import sim_world
import slam_report
import slam_stage
from slam_stage import between, compose, planar

SECONDS = {False: 266.0, True: 20.0}  # of the bag, whole (the robot moves so long) and with --quick
EVERY = 5  # of 50 scans a second
COLUMNS = ("seed", "way [m]", "odometry off at the end [m]", "RMSE [m]", "ATE [m]", "scans taken in", "CPU [ms] a scan", "peak memory [MB]")


def run(experiment):
    return [_run(experiment, seed) for seed in experiment.seeds]


def _run(experiment, seed):
    """A row of COLUMNS."""
    world = sim_world.shipped("office")
    bag = experiment.bag(world, SECONDS[experiment.quick], seed, "--mounts", "scan", "odom")
    done = slam_stage.run(experiment, bag, sim_bag.static_transforms(bag), seed, "/scan/scan", EVERY,
                          dict(experiment.given.set))
    stamps, found = [stamp for stamp, _ in done.poses], [pose for _, pose in done.poses]
    odometry = [pose for pose, _ in slam_stage.pairs(bag, "/scan/scan", EVERY)]
    base = _truth(bag, stamps)
    truth = moved(base, poses.flat(sim_bag.true_transform(bag, "base", "scan")))
    nominal = moved(found, poses.flat(sim_bag.nominal_transform(bag, "base", "scan")))
    if experiment.given.out and seed == experiment.seeds[0]:
        slam_report.picture(done.grid, done.poses, experiment.folder / "office_map.png", "office")
    experiment.done(bag)
    row = (seed, _way(base), math.hypot(*(laid_first(odometry, base) - base)[-1, :2]), rmse(laid_first(nominal, truth), truth),
           rmse(laid_best(nominal, truth), truth), done.scans, done.cpu_ms, done.peak_mb)
    experiment.say(f"office, seed {seed}: {row[1]:.0f} m, odometry {row[2]:.2f} m off, RMSE {row[3]:.4f} m, ATE {row[4]:.4f} m")
    return row


def _truth(bag_file, stamps):
    with rosbag.Bag(str(bag_file)) as bag:
        poses = [(m.header.stamp.to_nsec(), planar(m.pose.pose)) for _, m, _ in bag.read_messages(topics=["/truth/pose"])]
    times = numpy.array([stamp for stamp, _ in poses]) - stamps[0]
    values = numpy.array([pose for _, pose in poses])
    values[:, 2] = numpy.unwrap(values[:, 2])
    at = numpy.array(stamps) - stamps[0]
    return numpy.array([numpy.interp(at, times, values[:, k]) for k in range(3)]).T


def moved(path, step):
    """The poses (n x 3: x, y, yaw) of what sits at `step` on the robot."""
    return numpy.array([compose(pose, step) for pose in path])


def laid_first(path, truth):
    """n x 3: the path with its first pose laid on the true one."""
    first = compose(truth[0], between(path[0], numpy.zeros(3)))
    return numpy.array([compose(first, pose) for pose in path])


def laid_best(path, truth):
    """n x 3: the path turned and shifted to the least squares of its places."""
    path = numpy.asarray(path)
    a, b = (way[:, :2] - way[:, :2].mean(axis=0) for way in (path, truth))
    turn = math.atan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum())
    mean = numpy.append(path[:, :2].mean(axis=0), 0.0)
    middle = numpy.append(truth[:, :2].mean(axis=0), turn)
    return numpy.array([compose(middle, pose - mean) for pose in path])


def rmse(path, truth):
    """[m] of the places."""
    return math.sqrt(((path[:, :2] - truth[:, :2]) ** 2).sum(axis=1).mean())


def _way(truth):
    return float(numpy.hypot(*numpy.diff(truth[:, :2], axis=0).T).sum())


def table(rows):
    lines = ["office: root mean square error of the trajectory, the first pose laid on the true one (Gmapping: 0.04 to 0.16 m)",
             "seed    way   odometry at the end     RMSE      ATE    CPU a scan   memory"]
    return lines + [f"{seed:4}  {way:4.0f} m  {off:15.2f} m   {error:.4f} m  {ate:.4f} m  {cpu:6.1f} ms  {memory:6.0f} MB"
                    for seed, way, off, error, ate, _, cpu, memory in rows] + [""]


def lines(rows):
    errors = [row[3] for row in rows]
    return [figures.median("slam/office/rmse_median", errors, "m"), figures.worst("slam/office/rmse_worst", errors, "m"),
            figures.median("slam/office/ate_median", [row[4] for row in rows], "m"),
            figures.median("slam/office/cpu", [row[6] for row in rows], "ms"),
            figures.worst("slam/office/memory", [row[7] for row in rows], "MB")]
