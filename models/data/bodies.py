"""Bodies of each class, as a world file has them."""
import dataclasses
import math


@dataclasses.dataclass
class Thing:
    keys: dict  # shape, params, material, motion ...
    radius: float  # m, of a circle about it
    extent: float  # m, the larger of what is seen from the side: how far off it is still told
    label: str = ""


def shaped(draw, shape, params, material=None, label=""):
    width = params.get("diameter", math.hypot(params.get("length", 0.5), params.get("width", 0.5)))
    keys = {"shape": shape, "params": params}
    if material:
        keys["material"] = material
    return Thing(keys, width / 2, max(params.get("height", width), 0.6 * width), label)


def cage(draw):
    params = {"diameter": draw.spread(2, 12), "height": draw.number(0.7, 1.4), "posts": draw.randint(8, 28),
              "tube": draw.number(0.15, 0.4), "transparency": draw.number(0.6, 0.95)}
    return shaped(draw, "cage", params)


def boat(draw):
    length = draw.spread(3.5, 14)
    params = {"length": length, "width": draw.near(0.34 * length), "height": draw.near(0.38 * length),
              "draught": draw.near(0.07 * length)}
    material = {"texture": "noise", "texture_size": draw.spread(0.2, 2), "colour2": draw.colour()}
    return shaped(draw, "boat", params, material if draw.chance(0.5) else None)


def buoy(draw):
    size = draw.spread(0.3, 1.6)
    params = {"diameter": size, "height": draw.near(2 * size, 0.3), "draught": draw.near(0.5 * size)}
    return shaped(draw, "buoy", params, {"colour": draw.colour((0.2, 0.9), (0.5, 1))} if draw.chance(0.5) else None)


def bollard(draw):
    size = draw.spread(0.25, 0.7)
    params = {"diameter": size, "height": draw.near(1.4 * size)}
    return shaped(draw, "bollard", params, draw.material(draw.colour((0.03, 0.7)), gloss=(0, 0.4)))


def car(draw):
    params = {"length": draw.near(4.3), "width": draw.near(1.8, 0.08), "height": draw.near(1.5, 0.1)}
    return shaped(draw, "car", params, {"colour": draw.colour()} if draw.chance(0.6) else None)


def balloon_car(draw):
    params = {"length": draw.near(0.8), "width": draw.near(1.6), "height": draw.near(1.35)}
    return shaped(draw, "balloon_car", params, draw.material(draw.colour((0.3, 0.9)), gloss=(0.1, 0.3)))


def puppet(draw):
    params = {"height": draw.number(1.0, 1.8), "width": draw.near(0.34)}
    return shaped(draw, "puppet", params, draw.material(draw.colour((0.2, 0.9), (0, 0.4)), size=(0.05, 0.2)))


def person(draw):
    params = {"height": draw.number(1.5, 1.95), "width": draw.near(0.5, 0.1),
              "speed": draw.number(0.5, 1.8) if draw.chance(0.6) else 0}
    return shaped(draw, "person", params)


def box(draw):
    if draw.chance(0.3):
        params = {"length": draw.number(0.3, 0.7), "width": draw.number(0.3, 0.6), "height": draw.number(0.5, 1.2),
                  "count": draw.randint(2, 4)}
        return shaped(draw, "stacked_boxes", params, {"colour": draw.colour((0.3, 0.8), (0.3, 0.7), (0.05, 0.12))})
    params = {key: draw.spread(0.25, 1.2) for key in ("length", "width", "height")}
    shape = draw.choice(["box", "cardboard_box"])
    return shaped(draw, shape, params, draw.material(draw.colour(), (0.03, 0.4)) if draw.chance(0.7) else None)


def cone(draw):
    size = draw.spread(0.25, 0.5)
    params = {"diameter": size, "height": draw.near(1.7 * size, 0.25)}
    return shaped(draw, draw.choice(["red_cone", "blue_cone"]), params)


def ball(draw):
    shape = draw.choice(["football", "balloon", "sphere"])
    params = {"diameter": draw.spread(0.2, 0.9)}
    return shaped(draw, shape, params, draw.material(draw.colour((0.3, 1)), (0.05, 0.3), gloss=(0, 0.4)))


def stool(draw):
    params = {"diameter": draw.number(0.28, 0.45), "height": draw.number(0.4, 0.8)}
    return shaped(draw, "stool", params, draw.material(draw.colour(), (0.02, 0.1)) if draw.chance(0.6) else None)


def chair(draw):
    side = draw.near(0.46)
    params = {"length": side, "width": draw.near(side, 0.1), "height": draw.near(0.95)}
    shape = draw.choice(["chair", "ladder_back"])
    return shaped(draw, shape, params, draw.material(draw.colour(), (0.02, 0.1)) if draw.chance(0.7) else None)


MAKERS = {f.__name__: f for f in (cage, boat, buoy, bollard, car, balloon_car, puppet, person, box, cone, ball, stool, chair)}


def labelled(draw, label):
    thing = MAKERS[label](draw)
    thing.label = label
    return thing


AFLOAT = ("wall", "brick_wall", "pole", "barrel", "tree", "net")  # that may stand in shallow water


def fixture(draw, wet=False):
    """Something without a class."""
    shapes = {"wall": (3, 8), "brick_wall": (3, 8), "container": None, "tree": None, "bush": None, "fence": (3, 8),
              "barrier": (1.5, 3), "barrel": None, "radiator": None, "distribution_box": None, "truck": None,
              "pole": None, "guardrail": (4, 8), "shelf": None, "table": None, "bench": None, "net": (3, 6)}
    shape = draw.choice(AFLOAT if wet else sorted(shapes))
    params = {"length": draw.number(*shapes[shape])} if shapes[shape] else {}
    if shape in ("tree", "bush"):
        params = {"diameter": draw.number(0.8, 4), "height": draw.number(0.8, 1.6) if shape == "bush" else draw.number(3, 9)}
    radius = {"container": 3.3, "truck": 4.2, "tree": 0.5}.get(shape, 0.5 * params.get("length", params.get("diameter", 1.2)) + 0.2)
    painted = shape not in ("tree", "bush", "truck", "barrier") and draw.chance(0.6)
    keys = {"shape": shape, "params": params}
    if painted:
        keys["material"] = draw.material(draw.colour(), (0.1, 0.8))
    return Thing(keys, radius, 3.0)
