"""Settings of the paper's rivals, VICP and IMU, tried on a piece of the corridor of a seed that is not scored."""
import itertools

import mdr_worlds
import point_error
import walk_bag
from deskew_stages import DeskewStages, Method

VICP = {}  # what of the grid below was best, where it is not as shipped
IMU = {}
GRID = {
    "vicp": {"vicp_metric": ("point", "line"), "vicp_max_distance": (0.2, 0.5, 1.0)},
    "imu": {"imu_velocity_time": (0.1, 0.5, 2.0), "imu_gravity_time": (0.5, 2.0, 10.0)},
}
SEED, SECONDS = 1001, 4.0
CORRIDOR = point_error.Room({"wall_east": (1, 0, 15.0), "wall_west": (-1, 0, 15.0), "wall_north": (0, 1, 1.05), "wall_south": (0, -1, 1.05)})


def run(experiment):
    """A table of each method."""
    bag = experiment.bag(mdr_worlds.corridor(at_once=False), SECONDS, SEED, *mdr_worlds.MOUNTS)
    walk = walk_bag.read(bag)
    for method, grid in GRID.items():
        experiment.say(f"tuning {method}")
        settings = [dict(zip(grid, values)) for values in itertools.product(*grid.values())]
        names = {f"{method}_{i}": changes for i, changes in enumerate(settings)}
        stages = DeskewStages(experiment.session, experiment.folder, {name: Method(method, changes) for name, changes in names.items()})
        left = {name: [] for name in (*names, "raw")}
        for scan, answer in zip(walk.scans, stages.play(walk)):
            noise = CORRIDOR.noise(walk, scan)
            clouds = {"raw": walk_bag.returns(scan.message)[1], **{name: deskewed.points for name, deskewed in answer.items()}}
            for name, points in clouds.items():
                left[name].append(CORRIDOR.errors(walk, scan, points) - noise)
        stages.close()
        rows = [[*changes.values(), f"{point_error.rms(left[name]):.4f}"] for name, changes in names.items()]
        experiment.table(f"mdr_tune_{method}", [*grid, "motion_left_rms_m"], rows)
        yield [f"{'  '.join(grid)}  motion left in the points, RMS [m]", *("  ".join(map(str, row)) for row in rows),
               f"without deskewing  {point_error.rms(left['raw']):.4f}"]
    experiment.done(bag)
