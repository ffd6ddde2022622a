"""Settings of the paper's rivals, VICP and IMU, tried on pieces of the corridor and of the walk, of a seed that is not scored."""
import itertools
import typing

import mdr_room
import mdr_worlds
import point_error
import walk_bag
from deskew_stages import DeskewStages, Method

# What of the grids below was best, where it is not as shipped: {part: {method: changes}}.
TAKEN = {"corridor": {"vicp": {}, "imu": {}}, "room": {"vicp": {}, "imu": {"imu_velocity_time": 0.1}}}
SEED = 1001
CORRIDOR = point_error.Room({"wall_east": (1, 0, 15.0), "wall_west": (-1, 0, 15.0), "wall_north": (0, 1, 1.05), "wall_south": (0, -1, 1.05)})


class Place(typing.NamedTuple):
    world: dict
    seconds: float
    room: point_error.Room
    grids: dict  # {method: {parameter: values}}


def places():
    return {
        "corridor": Place(mdr_worlds.corridor(at_once=False), 4.0, CORRIDOR, {
            "vicp": {"vicp_metric": ("point", "line"), "vicp_max_distance": (0.2, 0.5, 1.0)},
            "imu": {"imu_velocity_time": (0.1, 0.5, 2.0), "imu_gravity_time": (0.5, 2.0, 10.0)}}),
        "walk": Place(mdr_worlds.walk(), 12.0, mdr_room.ROOM, {
            "imu": {"imu_velocity_time": (0.02, 0.1, 0.5), "imu_gravity_time": (0.5, 2.0, 10.0, 50.0)}}),
    }


def run(experiment):
    """A table of each place and method."""
    for name, place in places().items():
        bag = experiment.bag(place.world, place.seconds, SEED, *mdr_worlds.MOUNTS)
        walk = walk_bag.read(bag)
        for method, grid in place.grids.items():
            yield _tried(experiment, name, place, walk, method, grid)
        experiment.done(bag)


def _tried(experiment, name, place, walk, method, grid):
    experiment.say(f"tuning {method}, {name}")
    settings = {f"{method}_{i}": dict(zip(grid, values)) for i, values in enumerate(itertools.product(*grid.values()))}
    stages = DeskewStages(experiment.session, experiment.folder, {key: Method(method, changes) for key, changes in settings.items()})
    left = {key: [] for key in (*settings, "raw")}
    for scan, answer in zip(walk.scans, stages.play(walk)):
        noise = place.room.noise(walk, scan)
        clouds = {"raw": walk_bag.returns(scan.message)[1], **{key: deskewed.points for key, deskewed in answer.items()}}
        for key, points in clouds.items():
            left[key].append(place.room.errors(walk, scan, points) - noise)
    stages.close()
    rows = [[*changes.values(), f"{point_error.rms(left[key]):.4f}"] for key, changes in settings.items()]
    experiment.table(f"mdr_tune_{name}_{method}", [*grid, "motion_left_rms_m"], rows)
    return [f"{name}: {'  '.join(grid)}  motion left in the points, RMS [m]", *("  ".join(map(str, row)) for row in rows),
            f"without deskewing  {point_error.rms(left['raw']):.4f}"]
