"""The eight obstacles of section 5.1 of the quadruped paper (004), and four that are harder to see."""
import collections

import figures
import quad_obstacles
import quad_score
import sim_world

STEEL = {"colour": [0.6, 0.6, 0.62], "reflectivity": 0.4}
LEG, LEGS = 0.025, 0.36  # m: their diameter, and from one to the next
TOP = 0.65  # m: what begins higher stands in no map of the scanner's plane or below


def _leg(place, x, y):
    return {"name": f"thin_legs_{place}", "label": "thin_legs", "shape": "cylinder", "params": {"diameter": LEG, "height": 0.75},
            "material": STEEL, "pose": [x, y, 0]}


# In free places of quad_obstacles, all within 1.3 m of the way.
MORE = [
    {"name": "rod", "label": "rod", "shape": "cylinder", "params": {"diameter": 0.02, "height": 0.5}, "material": STEEL, "pose": [-1.8, 0.75, 0]},
    {"name": "kerb", "label": "kerb", "shape": "box", "params": {"length": 1.2, "width": 0.15, "height": 0.08},
     "material": {"colour": [0.6, 0.6, 0.58], "reflectivity": 0.4, "texture": "noise", "texture_size": 0.05}, "pose": [-2.9, -1.1, 0]},
    *(_leg(place, 0.15 + x * LEGS / 2, -1.15 + y * LEGS / 2) for place, (x, y) in enumerate(((-1, -1), (1, -1), (-1, 1), (1, 1)), 1)),
    {"name": "seat", "shape": "box", "params": {"length": 0.4, "width": 0.4, "height": 0.04}, "pose": [0.15, -1.15, 0.75, 0]},
    {"name": "bar", "label": "bar", "shape": "box", "params": {"length": 0.7, "width": 0.04, "height": 0.04}, "material": STEEL,
     "pose": [1.5, 1.0, 0.35, 70]},
]


def world():
    eight = sim_world.shipped("quad_obstacles")
    return {**eight, "name": "quad_obstacles_hard", "bodies": [*eight["bodies"], *MORE]}


def found(points, bodies, resolution):
    """Names of obstacles; of the legs, each must be there. A seat above is in no map's heights, so it hides nothing."""
    low = [body for body in bodies if body.T_world_box[2, 3] - body.size[2] / 2 < TOP]
    single = quad_score.found(points, low, resolution)
    parts = collections.Counter(body.label for body in low if body.label == "thin_legs")
    whole = [name for name in single if not name.startswith("thin_legs")]
    legs = len(single) - len(whole)
    return whole + (["thin_legs"] if legs == parts["thin_legs"] > 0 else [])


def run(experiment):
    """Lines: a table, then figures."""
    rows = quad_obstacles.measure(experiment, world(), found)
    lines = [figures.mean(f"pmf/obstacles/{name}_found_hard", [len(row.found) for row in rows if row.map == name], "-")
             for name in quad_obstacles.NAMES]
    return [*quad_obstacles.table("obstacles found of twelve, four of them harder: rod, kerb, thin legs, hanging bar", rows), *lines,
            *quad_obstacles.of_maps("pmf/hard", rows)]
