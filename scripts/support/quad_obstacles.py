"""Section 5.1 of the quadruped paper (004): which of eight obstacles each map has, and how much of what could be seen."""
import typing

import figures
import quad_outline
import quad_score
import quad_stages
import sim_world

SECONDS = {False: 52.0, True: 26.0}  # of the walk there and back, or there
NAMES = {"lidar": "LiDAR", "pf": "PF", "pmf": "PMF", "pmf_pf": "PMF, map A of PF"}
SIGMA = 0.03  # m, of a scanner's range: cells within a cell and three of it belong to a surface
COLUMNS = ("seed", "map", "found", "which", "outline of obstacles that could be seen", "of it in the map", "outline of all that could be seen",
           "of it in the map", "occupied cells", "phantoms")


class Row(typing.NamedTuple):
    """Of one map of one walk."""
    seed: int
    map: str
    found: list  # names of obstacles
    seen: int  # places of the obstacles' outlines that some sensor could see
    shown: int  # of them, those that the map has
    all_seen: int  # likewise of all bodies, walls included
    all_shown: int
    occupied: int  # cells
    phantoms: int  # of them

    def completeness(self):
        return self.shown / self.seen

    def completeness_of_all(self):
        return self.all_shown / self.all_seen

    def csv(self):
        return self.seed, self.map, len(self.found), " ".join(self.found), *self[3:]


def run(experiment):
    """Lines: a table, then figures."""
    rows = measure(experiment, sim_world.shipped("quad_obstacles"), quad_score.found)
    lines = [figures.mean(f"pmf/obstacles/{name}_found", [len(row.found) for row in rows if row.map == name], "-") for name in NAMES]
    return [*table("obstacles found of eight (paper: LiDAR 4, PF 6, PMF 8)", rows), *lines, *of_maps("pmf", rows)]


def measure(experiment, world, found):
    """Rows of every seed and map; `found(points, bodies, resolution)` names the obstacles that are there."""
    rows = [row for seed in experiment.seeds for row in _walk(experiment, world, found, seed)]
    experiment.table(world["name"], COLUMNS, [row.csv() for row in rows])
    return rows


def _walk(experiment, world, found, seed):
    seconds = SECONDS[experiment.quick]
    bag = quad_stages.bag(experiment, world, seconds, seed)
    maps, path = quad_stages.play(experiment, bag)
    T_world_map, bodies = quad_score.world_of_map(bag, path), quad_score.bodies(bag)
    outline = quad_outline.read(experiment, world, seconds, seed)
    rows = [_score(seed, name, grid, T_world_map, found, bodies, outline) for name, grid in maps.items()]
    for row in rows:
        experiment.say(f"{world['name']}, seed {seed}, {NAMES[row.map]}: {len(row.found)} found, {row.completeness():.3f} of their "
                       f"outline, {row.phantoms} of {row.occupied} cells belong to none")
    if experiment.given.out:
        import quad_pictures  # matplotlib only where a picture is asked for

        missed = {name: quad_outline.missed(grid, T_world_map, outline) for name, grid in maps.items()}
        quad_pictures.maps(maps, NAMES, experiment.folder / f"{world['name']}_maps_{seed}.png", missed)
    experiment.done(bag)
    return rows


def _score(seed, name, grid, T_world_map, found, bodies, outline):
    points, resolution = quad_score.occupied(grid, T_world_map), grid.info.resolution
    of_obstacles = quad_outline.of_bodies(outline, [body for body in bodies if body.label])
    counts = [count for places in (of_obstacles, outline) for count in
              (len(places.seen), int(quad_outline.shown(grid, T_world_map, places).sum()))]
    return Row(seed, name, found(points, bodies, resolution), *counts, len(points),
               quad_outline.phantoms(points, outline, resolution + 3 * SIGMA))


def table(title, rows):
    lines = [title, "map                 seed  found  their outline  of all  phantoms  which"]
    return lines + [f"{NAMES[row.map]:18}  {row.seed:4}  {len(row.found):5}  {row.completeness():13.3f}  {row.completeness_of_all():6.3f}  "
                    f"{row.phantoms:8}  {' '.join(row.found)}" for row in rows] + [""]


def of_maps(prefix, rows):
    """Figures of completeness and of phantom cells; those of PMF without its name."""
    lines = []
    for name in NAMES:
        own, suffix = [row for row in rows if row.map == name], "" if name == "pmf" else f"/{name}"
        lines.append(figures.mean(f"{prefix}/contour_completeness{suffix}", [row.completeness() for row in own], "-"))
        lines.append(figures.mean(f"{prefix}/contour_completeness_of_all{suffix}", [row.completeness_of_all() for row in own], "-"))
        lines.append(figures.share(f"{prefix}/phantom_cells{suffix}", sum(row.phantoms for row in own), sum(row.occupied for row in own)))
    return lines
