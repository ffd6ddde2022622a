"""Cages, boats and buoys."""
from data.thing import shaped

SIGNAL = ((0.5, 0.95), (0.7, 1.0))  # value and saturation of colours that are to be seen


def dark_or_bright(draw, dark):
    return draw.colour((0.08, 0.3), (0, 0.3)) if draw.chance(dark) else draw.colour(*SIGNAL)


def cage(draw, sizes=(0.4, 12)):
    """`sizes`: of its diameter [m]."""
    shape = draw.kind({"cage": 3, "pontoon_cage": 1.5}, {"bird_net_cage": 1, "pontoon_cage": 1})
    params = {"diameter": draw.spread(2 if draw.held_out else sizes[0], sizes[1]), "height": draw.number(0.7, 1.4),
              "transparency": draw.number(0.6, 0.95), "draught": draw.number(0.5, 2)}
    if shape == "cage":
        params.update(posts=draw.randint(8, 30), tube=draw.number(0.12, 0.4), rails=draw.randint(1, 3),
                      unbraced=draw.randint(0, 1))
    elif shape == "bird_net_cage":
        params.update(posts=draw.randint(10, 24), tube=draw.number(0.15, 0.4), height=draw.near(0.9 + 0.07 * params["diameter"]))
    else:
        params.update(posts=draw.randint(3, 9), gangway=draw.number(0.4, 1.0), drums=draw.randint(3, 6) if draw.held_out else 0)
    if params["diameter"] < 2:  # a model of one, of finer parts
        params.update(height=draw.number(0.3, 1.2), draught=draw.number(0.2, 0.6))
        finer = {"tube": draw.number(0.04, 0.12)} if shape == "cage" else {"gangway": draw.number(0.06, 0.15)}
        params.update(finer, posts=draw.randint(3, 12))
    paints = {"float": draw.material(dark_or_bright(draw, 0.6), gloss=(0, 0.3)),
              "rail": draw.material(dark_or_bright(draw, 0.4), (0.02, 0.2)),
              "net": {"colour": draw.colour((0.1, 0.7), (0, 0.7))}}
    if shape == "pontoon_cage":
        paints["deck"] = draw.material(draw.colour((0.2, 0.7), (0, 0.5), (0.0, 0.2)), (0.05, 0.3))
    thing = shaped(shape, params, materials=paints)
    if shape == "pontoon_cage" and not draw.held_out:
        thing.radius *= 1.42  # it is square
    return thing


BOATS = {  # length from .. to; width, height, draught over it; what is painted
    "boat": (3.5, 12, 0.36, 0.38, 0.06, ("hull", "cabin")),
    "fishing_boat": (6, 16, 0.33, 0.5, 0.07, ("hull", "cabin", "gear")),
    "rowing_boat": (2.6, 5, 0.38, 0.19, 0.05, ("hull", "floor", "thwart")),
    "sailing_boat": (5, 12, 0.31, 1.2, 0.06, ("hull", "cabin", "sail")),
    "rib": (3.5, 8, 0.4, 0.32, 0.05, ("hull", "tube", "console", "motor")),
    "work_boat": (6, 15, 0.4, 0.38, 0.06, ("hull", "cabin", "gear", "mast")),
}


def boat(draw):
    shape = draw.kind({"boat": 3, "fishing_boat": 2, "rowing_boat": 1.5, "sailing_boat": 1}, {"rib": 1, "work_boat": 1})
    low, high, wide, tall, deep, roles = BOATS[shape]
    length = draw.spread(low, high)
    params = {"length": length, "width": draw.near(wide * length, 0.12), "height": draw.near(tall * length),
              "draught": draw.near(deep * length)}
    if shape == "boat":
        params["cabin"] = draw.number(0.25, 0.65)
    if shape == "sailing_boat":
        params["sail"] = draw.randint(0, 1)
    paints = {role: draw.material(draw.colour((0.75, 0.95), (0, 0.1)) if draw.chance(0.35) else None, (0.1, 1.5), 0.6, (0, 0.35))
              for role in roles}
    return shaped(shape, params, materials=paints)


BUOYS = {  # height over the diameter, and what is painted
    "buoy": (2.0, ("body", "topmark")),
    "mooring_buoy": (0.9, ("body", "neck")),
    "can_buoy": (1.6, ("body", "band", "skirt")),
    "spar_buoy": (4.0, ("body", "band", "float", "topmark")),
    "nun_buoy": (1.7, ("body",)),
    "pillar_buoy": (2.3, ("body", "mast", "topmark")),
}


def buoy(draw):
    shape = draw.kind({"buoy": 2, "mooring_buoy": 2, "can_buoy": 2, "spar_buoy": 1.5}, {"nun_buoy": 1, "pillar_buoy": 1})
    tall, roles = BUOYS[shape]
    size = draw.spread(0.3, 1.5) if shape != "pillar_buoy" else draw.number(1, 2)
    params = {"diameter": size, "height": draw.near(tall * size, 0.2), "draught": draw.near(0.35 * size, 0.3)}
    paints = {role: draw.material(dark_or_bright(draw, 0.25), (0.05, 0.3), 0.7, (0, 0.3)) for role in roles}
    return shaped(shape, params, materials=paints)
