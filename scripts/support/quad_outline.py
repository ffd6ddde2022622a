"""True outlines of a world as seen from above, and what of them the robot could see: for the scorer alone."""
import typing

import numpy
from scipy.ndimage import binary_dilation
from scipy.spatial import cKDTree

import grids
import poses
import stage_run

NEAR = 0.02  # m from a body's box: its outline
MARGIN = 2  # [cells] about a map, so that at least the outermost is beside nothing


class Outline(typing.NamedTuple):
    surface: numpy.ndarray  # n x 2 [m], world: every 1 cm of the surfaces between the heights, and where beams end
    seen: numpy.ndarray  # m x 2: of the outline, what some sensor could see


def read(experiment, world, seconds, seed):
    """Of a world (a dictionary); the heights and the range of voxel_map count."""
    stage = stage_run.defaults("voxel_map")
    file = experiment.folder / f"{world['name']}_{seed}_{seconds:.0f}s.csv"
    stage_run.tool("seen_outline", experiment.world_file(world), file, "--seconds", seconds, "--seed", seed, "--low", stage["min_height"],
                   "--high", stage["max_height"], "--range", stage["max_range"], quiet=True)
    return of_rows(numpy.genfromtxt(file, delimiter=",", skip_header=1, ndmin=2))


def of_rows(rows):
    """Rows of x, y, outline, camera, scanner."""
    return Outline(rows[:, :2], rows[(rows[:, 2] > 0) & ((rows[:, 3] > 0) | (rows[:, 4] > 0)), :2])


def of_bodies(outline, bodies):
    """With what is seen of these bodies alone."""
    own = numpy.zeros(len(outline.seen), dtype=bool)
    for body in bodies:
        own |= body.distance(outline.seen) <= NEAR
    return outline._replace(seen=outline.seen[own])


def shown(grid, T_world_map, outline):
    """Of each seen place, whether it lies in an occupied cell or in one of the eight around it."""
    info = grid.info
    cells = grids.cells(grid) >= grids.OCCUPIED
    near = binary_dilation(numpy.pad(cells, MARGIN), numpy.ones((3, 3)))
    local = in_map(outline.seen, T_world_map)
    place = lambda value, start, count: numpy.clip(numpy.floor((value - start) / info.resolution).astype(int) + MARGIN,
                                                   0, count + 2 * MARGIN - 1)
    columns = place(local[:, 0], info.origin.position.x, info.width)
    rows = place(local[:, 1], info.origin.position.y, info.height)
    return near[rows, columns]


def missed(grid, T_world_map, outline):
    """n x 2 [m], map: seen places that it does not show."""
    return in_map(outline.seen[~shown(grid, T_world_map, outline)], T_world_map)


def in_map(points, T_world_map):
    return poses.apply_flat(numpy.linalg.inv(T_world_map), points)


def phantoms(points, outline, near):
    """How many points are farther than `near` [m] from every surface."""
    if not len(points):
        return 0
    return int(numpy.sum(cKDTree(outline.surface).query(points)[0] > near))
