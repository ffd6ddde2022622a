"""A body to be put somewhere."""
import dataclasses
import math


@dataclasses.dataclass
class Thing:
    keys: dict  # shape, params, material ... as a world file has them
    radius: float  # m, of a circle about it
    extent: float  # m, as large as it looks from the side: how far off it can still be told
    label: str = ""


def shaped(shape, params, material=None, materials=None):
    width = params.get("diameter", math.hypot(params.get("length", 0.5), params.get("width", 0.5)))
    keys = {"shape": shape, "params": params}
    if material:
        keys["material"] = material
    if materials:
        keys["materials"] = materials
    return Thing(keys, width / 2, max(params.get("height", width), 0.6 * width))
