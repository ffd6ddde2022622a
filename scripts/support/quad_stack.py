"""Sections 4.2 and 4.3 of the quadruped paper (004): typical obstacles as each representation has them (Fig. 10), and heaps and
frames on maps of the LiDAR, of both sensors' scan (PF) and of both maps (PMF; Figs. 11 to 13)."""
import math
import statistics
import types
import typing

import genpy
import numpy
import rospy
from geometry_msgs.msg import PoseStamped, TransformStamped
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

import contour_error
import depth_cloud
import figures
import poses
import quad_outline
import quad_score
import quad_stages
import sim_bag
import sim_world
import slam_stage
import stage_run
import walk_bag

SECONDS = 50.0  # of the walk to the heap and back
QUICK_SECONDS = 20.0  # to the heap
ALONE = ("box", "football", "tube", "cone")
FORMS = {"scan": "scan map (Gmapping)", "cloud": "depth cloud", "laser": "laser-like map", "voxel": "voxel map"}
MAPS = {"lidar": "LiDAR", "pf": "PF", "pmf": "PMF"}
EVERY, STEP = 0.5, 4  # s and px, of the images and pixels that make the depth cloud
FINE = 0.01  # m, of the places of true surfaces
COLUMNS = ("seed", "as", "body", "points of the contour", "error [m]", "completeness")


class Drawn(typing.NamedTuple):
    points: numpy.ndarray  # n x 2 [m] in their own frame: middles of occupied cells, or a cloud
    T_world_own: numpy.ndarray
    cell: float  # m, its side; of a cloud that of the maps
    is_cloud: bool = False

    def own(self, places):
        """Places n x 2 of the world."""
        return quad_outline.in_map(places, self.T_world_own)


class Truth(typing.NamedTuple):
    """n x 2 [m], world."""
    outline: numpy.ndarray  # of all bodies as seen from above, between the heights of voxel_map
    seen: numpy.ndarray  # of it, what some sensor could see


class Row(typing.NamedTuple):
    seed: int
    form: str  # of FORMS or MAPS
    body: str
    score: contour_error.Score


def run(experiment):
    """Lines: tables, then figures."""
    rows = [row for seed in experiment.seeds for row in _seed(experiment, seed)]
    experiment.table("quadruped_stack", COLUMNS, [(row.seed, row.form, row.body, *row.score) for row in rows])
    return [*table("box, ball, tube and cone (Fig. 10)", of(rows, FORMS), FORMS), *table("heaps and frames (Figs. 11 to 13)", of(rows, MAPS), MAPS),
            *lines("alone", of(rows, FORMS), FORMS), *lines("stack", of(rows, MAPS), MAPS)]


def of(rows, forms):
    return [row for row in rows if row.form in forms and (row.body in ALONE) == (forms is FORMS)]


def _seed(experiment, seed):
    world, seconds = sim_world.shipped("quad_stack"), QUICK_SECONDS if experiment.quick else SECONDS
    bag = quad_stages.bag(experiment, world, seconds, seed)
    drawn = _drawn(experiment, bag, seed)
    read = quad_outline.read(experiment, world, seconds, seed)
    truth, bodies = Truth(contour_error.contour(read.surface, FINE), read.seen), quad_score.bodies(bag)
    rows = [row for form, one in drawn.items() for row in scores(seed, form, one, truth, bodies)]
    for form in drawn:
        mine = [row.score for row in rows if row.form == form]
        experiment.say(f"stack, seed {seed}, {form}: {1e3 * _mean([s.error for s in mine]):.0f} mm off, {_mean([s.completeness for s in mine]):.2f} of the outline")
    if experiment.given.out:
        import quad_stack_pictures  # matplotlib only where a picture is asked for

        shown = [body for body in bodies if body.name in ALONE]
        quad_stack_pictures.alone(drawn, truth, shown, FORMS, experiment.folder / f"quadruped_alone_{seed}.png")
        quad_stack_pictures.stack(drawn, truth, MAPS, experiment.folder / f"quadruped_stack_{seed}.png")
    experiment.done(bag)
    return rows


def _drawn(experiment, bag, seed):
    """{name of FORMS and MAPS: Drawn}"""
    scans, voxels = [], []
    subscribers = [rospy.Subscriber("/depth_scan", LaserScan, scans.append, queue_size=100),
                   rospy.Subscriber("/voxels", MarkerArray, voxels.append, queue_size=2)]
    try:
        maps, path = quad_stages.play(experiment, bag)
    finally:
        for subscriber in subscribers:
            subscriber.unregister()
    T_world_map, stage = quad_score.world_of_map(bag, path), stage_run.defaults("voxel_map")
    side, static = maps["lidar"].info.resolution, sim_bag.static_transforms(bag)
    out = {name: Drawn(quad_score.occupied(maps[name], numpy.eye(4)), T_world_map, side) for name in MAPS}
    in_band = lambda points: points[(points[:, 2] >= stage["min_height"]) & (points[:, 2] <= stage["max_height"]), :2]
    cloud = depth_cloud.cloud(bag, path, EVERY, STEP, stage["max_range"])
    cubes = numpy.array([[p.x, p.y, p.z] for p in voxels[-1].markers[0].points]).reshape(-1, 3)
    return {**out, "scan": out["lidar"], "cloud": Drawn(in_band(cloud), T_world_map, side, True),
            "voxel": Drawn(numpy.unique(in_band(cubes).round(4), axis=0), T_world_map, side),
            "laser": _laser(experiment, bag, scans, static, seed)}


def _laser(experiment, bag, scans, static, seed):
    """The map that grid_slam makes of the laser-like scan alone, scan by scan."""
    with_plane = TFMessage(transforms=[*static.transforms, _plane(scans[0].header.frame_id)])
    odometry = depth_cloud.odometry_of(bag)
    fed = ((poses.flat(odometry.at(scan.header.stamp.to_sec())), scan) for scan in scans)
    done = slam_stage.run_pairs(experiment, fed, with_plane, seed, stage_run.shipped_robot("quadruped")["grid_slam"])
    first = types.SimpleNamespace(poses=[_stamped(*done.poses[0])])
    return Drawn(quad_score.occupied(done.grid, numpy.eye(4)), quad_score.world_of_map(bag, first), done.grid.info.resolution)


def _plane(frame):
    """Of the laser-like scan: right below the base, and level, as the poses that are fed are."""
    out = TransformStamped()
    out.header.frame_id, out.child_frame_id, out.transform.rotation.w = "base", frame, 1.0
    return out


def _stamped(nanoseconds, pose):
    out = PoseStamped()
    out.header.stamp = genpy.Time(0, nanoseconds)
    out.pose.position.x, out.pose.position.y = pose[:2]
    out.pose.orientation.z, out.pose.orientation.w = math.sin(pose[2] / 2), math.cos(pose[2] / 2)
    return out


def scores(seed, form, drawn, truth, bodies):
    """A Row for each labelled body; what is nearer to another body, or to a wall, is not its own."""
    mine = [body._replace(T_world_box=numpy.linalg.inv(drawn.T_world_own) @ body.T_world_box) for body in bodies]
    parts = [drawn.points, drawn.own(truth.outline), drawn.own(truth.seen)]
    owners = [contour_error.of_bodies(part, mine) for part in parts]
    return [Row(seed, form, body.name, contour_error.score(*(part[owner == i] for part, owner in zip(parts, owners)), drawn.cell))
            for i, body in enumerate(mine) if body.label]


def _mean(values):
    """Of those that are known."""
    known = [value for value in values if not math.isnan(value)]
    return statistics.fmean(known) if known else math.nan


def table(title, rows, forms):
    """Of each body the mean over the seeds."""
    yield f"{title}: contour off the true outline [mm], and share of the outline that could be seen which is drawn"
    yield f"{'body':16} " + " ".join(f"{name:>22}" for name in forms.values())
    for body in dict.fromkeys(row.body for row in rows):
        told = []
        for form in forms:
            mine = [row.score for row in rows if (row.body, row.form) == (body, form)]
            error, share = 1e3 * _mean([s.error for s in mine]), _mean([s.completeness for s in mine])
            told.append(f"{'not there' if math.isnan(error) else f'{error:.0f} mm, {share:.2f}':>22}")
        yield f"{body:16} " + " ".join(told)
    yield ""


def lines(name, rows, forms):
    """The error of a form is the mean of the bodies that are there, its completeness that of all."""
    for form in forms:
        mine = [row.score for row in rows if row.form == form]
        yield figures.mean(f"pmf/contour/{name}/{form}_error", [s.error for s in mine if not math.isnan(s.error)], "m")
        yield figures.mean(f"pmf/contour/{name}/{form}_completeness", [s.completeness for s in mine if not math.isnan(s.completeness)], "-")
