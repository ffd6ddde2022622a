"""Boats and buoys put together at random."""
import math

from data.assembled import paints, thing_of
from data.part import Assembly


def hull_of(assembly, length, width, side, draught, paint, inner):
    """One hull, two beside each other, or a pontoon; the height of its deck."""
    draw, kind = assembly.draw, assembly.draw.choice(["open", "open", "decked", "decked", "twin", "pontoon"])
    sizes = {"length": length, "width": width, "height": side + draught, "draught": draught}
    if kind in ("open", "decked"):
        assembly.solid("rowing_boat", sizes, [0, 0, 0], paint)
        if kind == "decked":
            assembly.box(0.62 * length, 0.8 * width, 0.05, [-0.12 * length, 0, 0.85 * side], inner)
        return 0.4 * side if kind == "open" else 0.85 * side + 0.05
    if kind == "twin":
        for hand in (-1, 1):
            assembly.solid("rowing_boat", {**sizes, "width": 0.25 * width}, [0, hand * 0.36 * width, 0], paint)
    else:
        for hand in (-1, 1):
            thick = side + draught
            assembly.round("cylinder", thick, length, [-length / 2, hand * 0.3 * width, (side - draught) / 2], paint, (0, 90, 0))
    assembly.box(0.8 * length, 0.9 * width, 0.06, [0, 0, side], inner)
    return side + 0.06


def house(assembly, x, length, width, height, deck, paint, glass):
    """A cabin, with a band of windows, a roof that stands over, a smaller one above it."""
    draw = assembly.draw
    assembly.box(length, width, height, [x, 0, deck], paint)
    if draw.chance(0.75):
        assembly.box(length + 0.02, width + 0.02, 0.3 * height, [x, 0, deck + 0.5 * height], glass)
    if draw.chance(0.5):
        assembly.box(length * 1.15, width * 1.1, 0.05, [x, 0, deck + height], paint)
    if draw.chance(0.3):
        assembly.box(0.6 * length, 0.7 * width, 0.6 * height, [x, 0, deck + height], paint)


def canopy(assembly, x, length, width, height, deck, paint, post):
    for sx in (-0.5, 0.5):
        for sy in (-0.5, 0.5):
            assembly.round("cylinder", 0.05, height, [x + sx * length, sy * width, deck], post)
    assembly.box(1.1 * length, 1.1 * width, 0.06, [x, 0, deck + height], paint)


def boat(draw):
    assembly, (hull, inner, cabin, gear) = Assembly(draw), paints(draw, 4, (0.1, 1.5))
    glass = {"colour": draw.colour((0.05, 0.3), (0, 0.4)), "gloss": 0.3}
    length = draw.spread(2.8, 14)
    width = draw.near(0.36 * length, 0.25)
    side, draught = length * draw.number(0.07, 0.16), draw.near(0.05 * length)
    deck = hull_of(assembly, length, width, side, draught, hull, inner)
    tall = draw.number(0.12, 0.26) * length
    if draw.chance(0.6):
        house(assembly, length * draw.number(-0.3, 0.15), length * draw.number(0.15, 0.4), width * draw.number(0.4, 0.75),
              tall, deck, cabin, glass)
    elif draw.chance(0.5):
        canopy(assembly, length * draw.number(-0.2, 0.1), length * draw.number(0.2, 0.45), 0.6 * width, tall * 1.2, deck, cabin, gear)
    for _ in range(draw.randint(0, 3)):
        place = [length * draw.number(-0.35, 0.25), width * draw.number(-0.25, 0.25), deck]
        if draw.chance(0.5):
            assembly.round("cylinder", 0.01 * length + 0.02, length * draw.number(0.2, 0.6), place, gear)
        else:
            size = [length * draw.number(0.04, 0.14) for _ in range(3)]
            assembly.box(*size, place, gear)
    if draw.chance(0.5):
        assembly.box(0.06 * length, 0.1 * length, 0.12 * length, [-0.5 * length, 0, 0.3 * side], gear)
    return thing_of(assembly, length / 2, max(0.6 * length, tall))


def topmark(assembly, size, at, paint):
    kind, (x, y, z) = assembly.draw.choice(["ball", "cross", "cone", "drum", "flag"]), at
    if kind == "ball":
        assembly.ball(size, at, paint)
    elif kind == "cross":
        for turn in (45, -45):
            assembly.box(0.2 * size, 0.2 * size, 1.4 * size, [x, y - 0.5 * size * math.sin(math.radians(-turn)), z], paint, (turn, 0, 0))
    elif kind == "flag":
        assembly.box(0.02, size, 0.6 * size, [x, y + size / 2, z], paint)
    else:
        assembly.round("cone" if kind == "cone" else "cylinder", 0.8 * size, size, at, paint)


def buoy(draw):
    """Sections on each other, the lowest in the water; a pole and a topmark on every second."""
    assembly, colours = Assembly(draw), paints(draw, 4, (0.05, 0.3))
    size = draw.spread(0.28, 1.6)
    draught, up, wide = draw.near(0.3 * size, 0.3), 0.0, size
    for i in range(draw.randint(1, 3)):
        shape, height = draw.choice(["cylinder", "cylinder", "cone", "ball"]), wide * draw.number(0.3, 1.3)
        below = draught if i == 0 else 0.0
        if shape == "ball":
            height = 0.8 * wide
            assembly.ball(wide, [0, 0, up - (0.4 * wide if i == 0 else 0.15 * wide)], colours[i])
        else:
            assembly.round(shape, wide, height + below, [0, 0, up - below], colours[i])
        up += height * (0.6 if shape == "cone" else 0.75 if shape == "ball" else 1.0)
        wide *= draw.number(0.45, 0.95)
    if draw.chance(0.5):
        tall = size * draw.number(0.3, 1.2)
        assembly.round("cylinder", 0.06 * size + 0.01, tall, [0, 0, up], colours[3])
        topmark(assembly, size * draw.number(0.2, 0.5), [0, 0, up + tall], colours[3])
        up += tall
    return thing_of(assembly, size / 2, max(up, 0.6 * size))
