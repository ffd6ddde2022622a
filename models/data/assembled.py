"""Bodies of simple solids put together at random: more shapes of a class than the library of shapes has."""
import math

from data.part import Assembly
from data.thing import Thing


def thing_of(assembly, radius, extent):
    return Thing({"parts": assembly.parts}, radius, extent)


def paints(draw, count, size):
    return draw.alike(count, size, (0, 0.25))


def legs(assembly, length, width, height, paint):
    """Below a seat of that size: three or four legs, a column on a foot or with arms, or two runners."""
    draw, thick = assembly.draw, assembly.draw.number(0.02, 0.06)
    kind, square = draw.choice(["four", "four", "three", "column", "star", "runners"]), draw.chance(0.5)
    if kind == "four":
        lean = draw.number(0, 10)
        for sx in (-1, 1):
            for sy in (-1, 1):
                out = math.tan(math.radians(lean)) * height
                at = [sx * (length / 2 - thick / 2 + out), sy * (width / 2 - thick / 2 + out), 0]
                assembly.bar(thick, height, at, paint, square, (sy * lean, -sx * lean, 0))
        if draw.chance(0.4):
            for sy in (-1, 1):
                assembly.box(length, thick * 0.6, thick * 0.6, [0, sy * (width / 2 - thick / 2), 0.3 * height], paint)
    elif kind == "three":
        for i in range(3):
            angle = 2 * math.pi * i / 3
            assembly.bar(thick, height, [0.42 * length * math.cos(angle), 0.42 * width * math.sin(angle), 0], paint, square)
    elif kind in ("column", "star"):
        assembly.bar(draw.number(0.04, 0.12), height, [0, 0, 0], paint, square)
        if kind == "column":
            assembly.round("cylinder", draw.number(0.7, 1.1) * length, 0.03, [0, 0, 0], paint)
        else:
            for i in range(draw.randint(2, 3)):
                assembly.box(1.2 * length, 0.05, 0.05, [0, 0, 0.02], paint, (0, 0, 60 * i))
    else:
        for sy in (-1, 1):
            assembly.box(length, thick, thick, [0, sy * (width / 2 - thick / 2), 0], paint)
            for sx in (-0.7, 0.7):
                assembly.bar(thick, height, [sx * length / 2, sy * (width / 2 - thick / 2), 0], paint, square)


def seat_of(assembly, length, width, height, paint):
    thick = assembly.draw.number(0.02, 0.12)
    if assembly.draw.chance(0.35):
        assembly.round("cylinder", max(length, width), thick, [0, 0, height - thick], paint)
    else:
        assembly.box(length, width, thick, [0, 0, height - thick], paint)


def stool(draw):
    assembly, (seat, leg) = Assembly(draw), paints(draw, 2, (0.03, 0.15))
    length, height = draw.number(0.26, 0.5), draw.number(0.32, 0.85)
    width = length if draw.chance(0.6) else draw.near(length, 0.3)
    if draw.chance(0.12):
        assembly.round("cylinder", length, height, [0, 0, 0], leg)
    else:
        legs(assembly, length, width, height, leg)
    seat_of(assembly, length, width, height, seat)
    return thing_of(assembly, length * 0.7, height)


def back_of(assembly, length, width, low, high, paint):
    draw, lean = assembly.draw, -assembly.draw.number(0, 18)
    x, kind, thick = -length / 2 + 0.02, draw.choice(["panel", "half", "slats", "rungs", "frame"]), draw.number(0.015, 0.05)
    tall = high - low
    if kind == "panel":
        assembly.box(thick, width, tall, [x, 0, low], paint, (0, lean, 0))
        return
    rise = 0.5 * tall if kind == "half" else 0.0
    for side in (-1, 1):
        assembly.box(thick, thick, tall, [x, side * (width / 2 - thick / 2), low], paint, (0, lean, 0))
    back = math.tan(math.radians(lean))
    if kind == "half":
        assembly.box(thick, width, tall - rise, [x + back * rise, 0, low + rise], paint, (0, lean, 0))
        return
    assembly.box(thick, width, 0.12 * tall, [x + 0.88 * back * tall, 0, low + 0.88 * tall], paint, (0, lean, 0))
    count = draw.randint(2, 6)
    for i in range(count if kind != "frame" else 0):
        if kind == "slats":
            y = width * ((i + 0.5) / count - 0.5)
            assembly.box(thick * 0.6, 0.4 * width / count, tall, [x, y, low], paint, (0, lean, 0))
        else:
            up = tall * (i + 0.5) / (count + 1)
            assembly.box(thick * 0.6, width, 0.4 * tall / count, [x + back * up, 0, low + up], paint, (0, lean, 0))


def chair(draw):
    assembly, (seat, back, leg) = Assembly(draw), paints(draw, 3, (0.03, 0.15))
    length, width, height = draw.number(0.36, 0.56), draw.number(0.38, 0.6), draw.number(0.38, 0.52)
    legs(assembly, length, width, height, leg)
    seat_of(assembly, length, width, height, seat)
    back_of(assembly, length, width, height, height + draw.number(0.3, 0.75), back)
    if draw.chance(0.35):
        up = height + draw.number(0.15, 0.28)
        for side in (-1, 1):
            assembly.box(0.9 * length, 0.05, 0.03, [0, side * width / 2, up], leg)
            assembly.box(0.03, 0.03, up - height, [0.35 * length, side * width / 2, height], leg)
    return thing_of(assembly, 0.4, 0.95)


def box(draw):
    """With a lid, ledges, handles, feet, planks or wheels."""
    assembly, (body, second) = Assembly(draw), paints(draw, 2, (0.03, 0.4))
    length, width, height = (draw.spread(0.22, 1.2) for _ in range(3))
    foot = draw.number(0.05, 0.12) if draw.chance(0.3) else 0.0
    assembly.box(length, width, height, [0, 0, foot], body)
    for side in (-1, 1) if foot else ():
        assembly.box(0.15 * length, width, foot, [side * 0.35 * length, 0, 0], second)
    if draw.chance(0.4):
        assembly.box(0.9 * length, 0.9 * width, 0.08 * height, [0, 0, foot + height], second)
    if draw.chance(0.4):
        for i in range(draw.randint(1, 3)):
            up = foot + height * draw.number(0.05, 0.85)
            assembly.box(length + 0.02, width + 0.02, 0.08 * height, [0, 0, up], second)
    if draw.chance(0.4):
        for side in (-1, 1):
            assembly.box(0.25 * length, 0.02, 0.12 * height, [0, side * (width / 2 + 0.01), foot + 0.6 * height], second)
    if draw.chance(0.25):
        for i in range(draw.randint(2, 4)):
            x = length * draw.number(-0.45, 0.45)
            assembly.box(0.06 * length, width + 0.02, height, [x, 0, foot], second)
    return thing_of(assembly, math.hypot(length, width) / 2, height)


def bollard(draw):
    assembly, (body, second) = Assembly(draw), paints(draw, 2, (0.05, 0.3))
    size = draw.number(0.09, 0.55)
    height, square = size * draw.number(1.1, 2.2) if size > 0.25 else draw.number(0.6, 1.15), draw.chance(0.3)
    if draw.chance(0.5):
        assembly.bar(size * draw.number(1.3, 2.0), 0.06 * height, [0, 0, 0], second, draw.chance(0.5))
    assembly.bar(size, height, [0, 0, 0], body, square)
    top = draw.choice(["none", "ball", "cap", "cone", "waist"])
    if top == "ball":
        assembly.ball(1.02 * size, [0, 0, height - 0.51 * size], second)
    elif top == "cap":
        assembly.bar(size * draw.number(1.1, 1.6), 0.18 * height, [0, 0, height], second, square)
    elif top == "cone":
        assembly.round("cone", size * 1.05, 0.4 * size, [0, 0, height], second)
    elif top == "waist":
        assembly.round("cone", size * 1.7, 0.8 * height, [0, 0, 0], body)
        assembly.round("cylinder", size * 1.3, 0.12 * height, [0, 0, height], second)
    for _ in range(draw.randint(0, 2)):
        assembly.bar(size * 1.06, height * draw.number(0.06, 0.2), [0, 0, height * draw.number(0.3, 0.8)], second, square)
    return thing_of(assembly, size, height)
