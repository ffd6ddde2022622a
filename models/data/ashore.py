"""Bollards, cars, people, boxes, cones, balls and seats."""
from data.thing import shaped


def bollard(draw):
    shape = draw.kind({"bollard": 2, "twin_bollard": 1, "street_bollard": 1}, {"tee_bollard": 1, "stone_bollard": 1})
    size = draw.spread(0.25, 0.6)
    params = {"diameter": size, "height": draw.near(1.4 * size)}
    if shape == "street_bollard":
        params = {"diameter": draw.number(0.1, 0.3), "height": draw.number(0.7, 1.1)}
    elif shape in ("twin_bollard", "tee_bollard"):
        wide = draw.near(2.4 if shape == "twin_bollard" else 1.25)
        params = {"length": size, "width": round(wide * size, 3), "height": draw.near(1.2 * size)}
    elif shape == "stone_bollard":
        params["height"] = draw.near(2.2 * size)
    colour = draw.colour((0.1, 0.35), (0, 0.3)) if draw.chance(0.5) else draw.colour()
    return shaped(shape, params, materials={"body": draw.material(colour, (0.05, 0.3), gloss=(0, 0.3))})


CARS = {"car": (4.4, 1.8, 1.45), "hatchback": (3.9, 1.7, 1.5), "suv": (4.5, 1.85, 1.7), "estate": (4.7, 1.8, 1.48),
        "van": (5, 1.95, 2.1), "pickup": (5.2, 1.9, 1.8)}


def car(draw):
    shape = draw.kind({"car": 1, "hatchback": 1, "suv": 1}, {"estate": 1, "van": 0.7, "pickup": 1})
    params = {key: draw.near(size, 0.08) for key, size in zip(("length", "width", "height"), CARS[shape])}
    colour = draw.colour((0.1, 0.95), (0, 0.15)) if draw.chance(0.5) else draw.colour((0.3, 0.8), (0.5, 1))
    return shaped(shape, params, materials={
        "paint": draw.material(colour, (0.2, 1.5), plain=0.85, gloss=(0.15, 0.45), wear=0.5),
        "rim": {"colour": draw.colour((0.2, 0.8), (0, 0.1))}, "window": {"colour": draw.colour((0.1, 0.4), (0, 0.3))}})


def balloon_car(draw):
    shape = draw.choice(["balloon_car", "inflated_car"])
    params = {"length": draw.number(0.6, 1.1), "width": draw.near(1.6), "height": draw.near(1.35)}
    if shape == "inflated_car":
        params.update(length=draw.number(2, 2.8) if draw.held_out else draw.number(2.8, 4),
                      bonnet=draw.number(0.12, 0.22) if draw.held_out else draw.number(0.28, 0.42))
    return shaped(shape, params, materials={
        "body": draw.material(draw.colour((0.4, 0.95)), (0.1, 0.8), gloss=(0.1, 0.3), wear=0.3),
        "print": {"colour": draw.colour((0.05, 0.4), (0, 0.4))}})


def puppet(draw):
    """Of one fabric from head to foot."""
    params = {"height": draw.number(1.0, 1.4) if draw.held_out else draw.number(1.1, 1.85)}
    params["width"] = round(params["height"] * (draw.number(0.22, 0.25) if draw.held_out else draw.number(0.25, 0.31)), 3)
    if draw.held_out or draw.chance(0.4):
        params["stand"] = draw.number(0.2, 0.28)
    fabric = draw.material(draw.colour((0.1, 0.95), (0, 0.3)) if draw.chance(0.7) else None, (0.05, 0.25), wear=0.3)
    thing = shaped("puppet", params, fabric, {"seam": {"colour": draw.colour((0.05, 0.6), (0, 0.4)), "texture": "plain"}})
    thing.radius = 0.35
    return thing


def person(draw):
    params = {"height": draw.number(1.5, 1.95), "width": draw.near(0.5, 0.12),
              "speed": draw.number(0.5, 1.8) if draw.chance(0.6) else 0}
    for key, share in (("vest", 0.3), ("helmet", 0.25)) if not draw.held_out else (("coat", 0.6), ("pack", 0.6), ("helmet", 0.2)):
        params[key] = int(draw.chance(share))
    tone = draw.number(0.25, 1.0)
    paints = {"skin": {"colour": [round(tone * c, 3) for c in (0.62, 0.36, 0.25)]}}
    for role, worn in (("shirt", True), ("trousers", True), ("shoes", True), ("hair", not params["helmet"]),
                       ("helmet", params["helmet"]), ("vest", params.get("vest")), ("coat", params.get("coat")),
                       ("pack", params.get("pack"))):
        if worn:
            bright = role in ("vest", "helmet") and draw.chance(0.7)
            colour = draw.colour((0.8, 1), (0.8, 1), (0.05, 0.25)) if bright else draw.colour((0.1, 0.9))
            paints[role] = draw.material(colour, (0.05, 0.3), 0.5)
    return shaped("person", params, materials=paints)


CARDBOARD = ((0.4, 0.8), (0.3, 0.65), (0.06, 0.12))  # value, saturation, hue


def box(draw):
    shape = draw.kind({"box": 1.5, "parcel": 2, "crate": 1.5, "stacked_boxes": 1}, {"tote": 1, "open_box": 1})
    params = {key: draw.spread(0.25, 1.1) for key in ("length", "width", "height")}
    colour = draw.colour(*CARDBOARD) if shape in ("parcel", "open_box", "stacked_boxes") and draw.chance(0.7) else draw.colour()
    paint = draw.material(colour, (0.03, 0.4))
    if shape == "stacked_boxes":
        params.update(height=draw.number(0.6, 1.4), count=draw.randint(2, 4))
    if shape in ("box", "stacked_boxes"):
        return shaped(shape, params, paint)
    second = {"parcel": "tape", "crate": "post", "tote": "rim", "open_box": "flap"}[shape]
    return shaped(shape, params, materials={"body": paint, second: draw.material(draw.like(colour))})


def cone(draw):
    shape = draw.kind({"red_cone": 1, "blue_cone": 1, "plain_cone": 1, "road_cone": 2}, {"banded_cone": 1, "road_cone": 1})
    size = draw.spread(0.22, 0.5)
    params = {"diameter": size, "height": draw.near(1.7 * size, 0.25)}
    if shape in ("plain_cone", "banded_cone", "road_cone"):
        params["round"], band = int(draw.held_out), draw.number(0.1, 0.28)
        params.update({"band": band} if shape != "plain_cone" else {})
    colour = draw.colour((0.7, 0.95), (0.8, 1), (-0.03, 0.07)) if draw.chance(0.6) else draw.colour((0.4, 0.95), (0.5, 1))
    paints = {"body": draw.material(colour, plain=0.8), "base": draw.material(draw.like(colour) if draw.chance(0.5) else None)}
    return shaped(shape, params, materials=paints)


def ball(draw):
    shape = draw.kind({"football": 1, "sphere": 2}, {"sphere": 1})
    size = draw.spread(0.2, 0.9)
    paint = draw.material(draw.colour((0.3, 1)), (0.2 * size, size), 0.3, (0, 0.4), 0.4)
    if shape == "sphere" and not draw.held_out and draw.chance(0.4):
        paint.update(texture="wedges", colour2=draw.colour((0.3, 1)))
    return shaped(shape, {"diameter": size}, paint if shape == "sphere" or draw.chance(0.5) else None)


def seat_paint(draw, *roles):
    return dict(zip(roles, draw.alike(len(roles), (0.03, 0.15), (0, 0.2))))


def stool(draw):
    shape = draw.kind({"stool": 2, "bar_stool": 1, "square_stool": 1}, {"folding_stool": 1, "board_stool": 1, "stool": 1})
    if shape in ("stool", "bar_stool"):
        params = {"diameter": draw.number(0.28, 0.45), "height": draw.number(0.4, 0.8)}
        if shape == "stool":
            params.update(legs=5 if draw.held_out else draw.randint(3, 4),
                          splay=draw.number(0.4, 0.6) if draw.held_out else draw.number(0, 0.3))
    else:
        params = {"length": draw.number(0.3, 0.45), "width": draw.number(0.3, 0.45), "height": draw.number(0.35, 0.6)}
    return shaped(shape, params, materials=seat_paint(draw, "seat", "leg"))


def chair(draw):
    shape = draw.kind({"chair": 1, "ladder_back": 1, "office_chair": 1, "garden_chair": 1},
                      {"folding_chair": 1, "armchair": 1, "tube_chair": 1})
    size = {"office_chair": 0.6, "garden_chair": 0.58, "armchair": 0.8}.get(shape, 0.46)
    params = {"length": draw.near(size, 0.1), "width": draw.near(size, 0.1), "height": draw.near(0.95, 0.12)}
    return shaped(shape, params, materials=seat_paint(draw, "seat", "back", "base" if shape == "office_chair" else "leg"))
