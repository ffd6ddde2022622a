"""Bodies of each class, and of none."""
from data import afloat, ashore, assembled, assembled_afloat
from data.extras import dress
from data.thing import Thing

MAKERS = {f.__name__: f for f in (
    afloat.cage, afloat.boat, afloat.buoy, ashore.bollard, ashore.car, ashore.balloon_car, ashore.puppet, ashore.person,
    ashore.box, ashore.cone, ashore.ball, ashore.stool, ashore.chair)}
ASSEMBLERS = {f.__name__: f for f in (
    assembled_afloat.boat, assembled_afloat.buoy, assembled.bollard, assembled.box, assembled.stool, assembled.chair)}
ASSEMBLED = 0.5  # share of the bodies of these classes; none of those held out

# What has no class: parameters from .. to, radius of a circle about it.
FIXTURES = {
    "wall": ({"length": (3, 8)}, 4.2), "brick_wall": ({"length": (3, 8)}, 4.2), "fence": ({"length": (3, 8)}, 4.2),
    "net": ({"length": (3, 6)}, 3.2), "guardrail": ({"length": (4, 8)}, 4.2), "barrier": ({"length": (1.5, 3)}, 1.6),
    "tree": ({"diameter": (1, 4), "height": (4, 9)}, 0.5), "bush": ({"diameter": (0.8, 4), "height": (0.8, 1.6)}, 2.0),
    "container": ({}, 3.4), "pole": ({}, 0.2), "barrel": ({}, 0.4), "table": ({}, 0.9), "bench": ({}, 0.9),
    "shelf": ({}, 0.6), "radiator": ({}, 0.6), "distribution_box": ({}, 0.4), "experimental_table": ({}, 1.7),
}
IN_WATER = ("wall", "brick_wall", "pole", "tree", "net")
UNSEEN = ("guardrail", "radiator", "distribution_box", "shelf")  # in held-out worlds alone
AS_THEY_ARE = ("tree", "bush", "barrier")


def labelled(draw, label):
    if not draw.held_out and label in ASSEMBLERS and draw.chance(ASSEMBLED):
        thing = ASSEMBLERS[label](draw)
        thing.label = label
        return thing
    thing = MAKERS[label](draw)
    thing.label = label
    return dress(draw, thing)


def fixture(draw, wet=False):
    known = IN_WATER if wet else [name for name in FIXTURES if draw.held_out or name not in UNSEEN]
    shape = draw.choice(list(known))
    ranges, radius = FIXTURES[shape]
    keys = {"shape": shape, "params": {key: draw.number(*limits) for key, limits in ranges.items()}}
    if shape not in AS_THEY_ARE and draw.chance(0.7):
        keys["material"] = draw.material(size=(0.1, 0.8))
    return Thing(keys, radius, 3.0)
