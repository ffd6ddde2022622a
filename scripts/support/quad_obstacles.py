"""Section 5.1 of the quadruped paper (004): which of eight obstacles each map has."""
import figures
import quad_score
import quad_stages
import sim_world

SECONDS = {False: 52.0, True: 26.0}  # of the walk there and back, or there
COUNT = 8
NAMES = {"lidar": "LiDAR", "pf": "PF", "pmf": "PMF", "pmf_pf": "PMF, map A of PF"}
SIGMA = 0.03  # m, of a scanner's range: cells within a cell and three of it belong to a body


def run(experiment):
    """Lines: a table, then figures."""
    rows = [row for seed in experiment.seeds for row in _run(experiment, seed)]
    experiment.table("quadruped_obstacles", ("seed", "map", "found", "which", "occupied cells", "phantoms"), rows)
    return [*_table(rows), *_lines(rows)]


def _run(experiment, seed):
    bag = experiment.bag(sim_world.shipped("quad_obstacles"), SECONDS[experiment.quick], seed)
    maps, path = quad_stages.play(experiment, bag)
    T_world_map = quad_score.world_of_map(bag, path)
    bodies = quad_score.bodies(bag)
    rows = []
    for name, grid in maps.items():
        points = quad_score.occupied(grid, T_world_map)
        seen = quad_score.found(points, bodies, grid.info.resolution)
        rows.append((seed, name, len(seen), " ".join(seen), len(points),
                     quad_score.phantoms(points, bodies, grid.info.resolution + 3 * SIGMA)))
        experiment.say(f"obstacles, seed {seed}, {NAMES[name]}: {len(seen)} of {COUNT}; {rows[-1][-1]} of {len(points)} cells belong to none")
    if experiment.given.out:
        import quad_pictures  # matplotlib only where a picture is asked for

        quad_pictures.maps(maps, {name: NAMES[name] for name in maps}, experiment.folder / f"quadruped_maps_{seed}.png")
    experiment.done(bag)
    return rows


def _table(rows):
    lines = ["obstacles found of eight (paper: LiDAR 4, PF 6, PMF 8)", "map                 seed  found  which"]
    return lines + [f"{NAMES[name]:18}  {seed:4}  {count:5}  {which}" for seed, name, count, which, _, _ in rows] + [""]


def _lines(rows):
    lines = []
    for name in NAMES:
        own = [row for row in rows if row[1] == name]
        lines.append(figures.mean(f"pmf/obstacles/{name}_found", [row[2] for row in own], "-"))
    own = [row for row in rows if row[1] == "pmf"]
    return [*lines, figures.share("pmf/phantom_cells", sum(row[5] for row in own), sum(row[4] for row in own))]
