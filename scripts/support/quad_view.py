"""Section 4.3 of the quadruped paper (004), Figs. 12 and 13: a low box that leaves the depth camera's view, and one that is taken away."""
import bisect
import math
import types

import numpy
import rosbag

import figures
import quad_outline
import quad_score
import quad_stages
import sim_world
from quad_obstacles import NAMES

SIZE = {"length": 0.5, "width": 0.4, "height": 0.3}  # m, below the scanner
BEFORE, TAKEN = 1.2, 5.0  # m that the robot stands before the box; s, when it is taken away
BEGIN = 1000.0  # s, of every bag
PAPER = {"pf": "a sheet", "pmf": "the whole box"}
COLUMNS = ("seed", "map", "before", "after", "fades after [s]")


def run(experiment):
    """Lines: a table, then figures."""
    rows = [row for seed in experiment.seeds for row in _rows(experiment, seed)]
    experiment.table("quad_view", COLUMNS, rows)
    lines = ["share of a low box's outline: while it is seen, and when the robot has passed it; how soon one that is taken away fades",
             "map                 seed  before   after   fades   paper: after"]
    for seed, name, before, after, faded in rows:
        lines.append(f"{NAMES[name]:18}  {seed:4}  {before:6.2f}  {after:6.2f}  {faded:4.1f} s   {PAPER.get(name, '-')}")
    own = lambda name, column: [row[column] for row in rows if row[1] == name]
    return [*lines, "", *(figures.mean(f"pmf/view/{what}/{name}", own(name, column), "-") for name in NAMES
                          for column, what in ((2, "before"), (3, "after"))),
            *(figures.mean(f"pmf/view/fades/{name}", own(name, 4), "s") for name in ("pmf", "pmf_pf"))]


def world(name, box, way):
    """The walls of quad_obstacles and a box; the robot walks `way`."""
    plain = sim_world.shipped("quad_obstacles")
    motion = {**plain["robot"]["motion"], **way}
    bodies = [body for body in plain["bodies"] if body["name"].startswith("wall")]
    return {**plain, "name": name, "bodies": [*bodies, {"name": "box", "label": "box", "shape": "cardboard_box", "params": SIZE, **box}],
            "robot": {**plain["robot"], "motion": motion}}


def passed():
    return world("quad_view_passed", {"pose": [0, 0.6, 0]}, {"points": [[-3, 0, 0], [1.3, 0]]}), 13.0


def taken():
    """Away to the side, too fast to be seen on its way; the robot walks on slowly, since grid_slam takes no scan in at rest."""
    away = {"points": [{"at": [0, 0], "yaw_deg": 0, "pause": TAKEN}, {"at": [0, 60], "yaw_deg": 0}],
            "speed": 100.0, "acceleration": 400.0, "turn_rate_deg": 360}
    return world("quad_view_taken", {"motion": away}, {"points": [[-2.2, 0, 0], [-0.9, 0]], "speed": 0.1}), 12.0


def _rows(experiment, seed):
    before, after = _passed(experiment, seed)
    faded = _taken(experiment, seed)
    for name in NAMES:
        experiment.say(f"box, seed {seed}, {NAMES[name]}: {before[name]:.2f} of it before, {after[name]:.2f} after; fades in {faded[name]:.1f} s")
    return [(seed, name, before[name], after[name], faded[name]) for name in NAMES]


class _History:
    """Every map that comes, by its name and stamp."""

    def __init__(self):
        self.maps = {name: [] for name in NAMES}

    def __call__(self, name, grid):
        cells = numpy.array(grid.data, dtype=numpy.int8)
        self.maps[name].append((grid.header.stamp.to_sec(), types.SimpleNamespace(info=grid.info, data=cells)))

    def at(self, name, time):
        """The last one not after it [s]."""
        stamps = [stamp for stamp, _ in self.maps[name]]
        return self.maps[name][max(0, bisect.bisect_right(stamps, time) - 1)][1]


def _play(experiment, world, seconds, seed):
    """(history, T_world_map, the box as it first stands, s when the robot first is near it)."""
    bag = quad_stages.bag(experiment, world, seconds, seed)
    history = _History()
    _, path = quad_stages.play(experiment, bag, history)
    T_world_map = quad_score.world_of_map(bag, path)
    box = next(body for body in quad_score.bodies(bag) if body.name == "box")
    at = _when(bag, box)
    experiment.done(bag)
    return history, T_world_map, box, at


def _when(bag_file, box):
    """[s] When the robot first is so near before the box."""
    with rosbag.Bag(str(bag_file)) as bag:
        for _, message, _ in bag.read_messages(topics=["/truth/pose"]):
            if box.T_world_box[0, 3] - message.pose.pose.position.x <= BEFORE:
                return message.header.stamp.to_sec()
    return math.inf


def _passed(experiment, seed):
    """({map: share of what could be seen of the box so far} while the camera sees it, and at the end)."""
    world, seconds = passed()
    history, T_world_map, box, near = _play(experiment, world, seconds, seed)
    shares = []
    for what, time in (("before", near - BEGIN), ("after", seconds)):
        outline = quad_outline.of_bodies(quad_outline.read(experiment, world, time, seed), [box])
        maps = {name: history.at(name, BEGIN + time) for name in NAMES}
        shares.append({name: float(quad_outline.shown(grid, T_world_map, outline).mean()) for name, grid in maps.items()})
        if experiment.given.out:
            import quad_pictures  # matplotlib only where a picture is asked for

            quad_pictures.maps(maps, NAMES, experiment.folder / f"quad_view_{what}_{seed}.png")
    return shares


def _taken(experiment, seed):
    """{map: s from when the box goes to the first map from which on none shows it}; NaN: it stays, or was never there."""
    world, seconds = taken()
    history, T_world_map, box, _ = _play(experiment, world, seconds, seed)
    return {name: _faded(history.maps[name], T_world_map, box) for name in NAMES}


def _faded(maps, T_world_map, box):
    there = [(time, bool(numpy.any(box.distance(quad_score.occupied(grid, T_world_map)) <= 0.0))) for time, grid in maps]
    last = max((i for i, (time, shown) in enumerate(there) if shown), default=None)
    if last is None or last + 1 == len(there) or there[last][0] < BEGIN + TAKEN:
        return math.nan
    return there[last + 1][0] - BEGIN - TAKEN
