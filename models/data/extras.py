"""What lies on bodies or hangs at them, so that no class is told by one outline."""

# On a class: shape, its sizes over the body's height or metres, and where: shares of the half length and width from the
# middle to the side, and of the height.
EXTRAS = {
    "boat": [("cylinder", {"diameter": (0.02, 0.08), "height": (0.3, 1.2)}, (0.6, 0.3, 0.3)),
             ("box", {"length": (0.1, 0.4), "width": (0.1, 0.3), "height": (0.1, 0.3)}, (0.55, 0.35, 0.25)),
             ("cylinder", {"diameter": (0.1, 0.3), "height": (0.15, 0.35)}, (0.5, 0.3, 0.25))],
    "cage": [("cylinder", {"diameter": (0.05, 0.15), "height": (1.0, 2.0)}, (0.85, 0.3, 0.0)),
             ("box", {"length": (0.4, 1.2), "width": (0.4, 1.2), "height": (0.4, 1.3)}, (0.3, 0.3, 0.0)),
             ("cone", {"diameter": (0.5, 1.2), "height": (0.5, 1.4)}, (0.2, 0.2, 0.1))],
    "buoy": [("cylinder", {"diameter": (0.05, 0.15), "height": (0.08, 0.25)}, (0.0, 0.0, 0.93)),
             ("box", {"length": (0.1, 0.25), "width": (0.02, 0.05), "height": (0.1, 0.25)}, (0.1, 0.1, 0.6)),
             ("cylinder", {"diameter": (0.02, 0.06), "height": (0.2, 0.6)}, (0.3, 0.3, 0.3))],
    "car": [("box", {"length": (0.6, 1.0), "width": (0.4, 0.6), "height": (0.1, 0.25)}, (0.1, 0.05, 0.98)),
            ("cylinder", {"diameter": (0.01, 0.02), "height": (0.3, 0.6)}, (0.2, 0.3, 0.95))],
    "bollard": [("ring_float", {"diameter": (0.6, 1.2), "tube": (0.05, 0.12), "draught": (0.001, 0.002)}, (0.1, 0.1, 0.15))],
    "box": [("box", {"length": (0.3, 0.8), "width": (0.3, 0.8), "height": (0.2, 0.6)}, (0.3, 0.3, 0.98))],
    "stool": [("box", {"length": (0.2, 0.5), "width": (0.2, 0.5), "height": (0.05, 0.4)}, (0.2, 0.2, 0.98))],
    "chair": [("box", {"length": (0.15, 0.35), "width": (0.15, 0.35), "height": (0.05, 0.3)}, (0.2, 0.2, 0.5))],
    "cone": [("cylinder", {"diameter": (0.1, 0.2), "height": (0.08, 0.2)}, (0.0, 0.0, 0.96))],
}
SHARE = 0.35  # of the bodies that have some
BY_ITSELF = ("shape", "params", "material", "materials")


def dress(draw, thing):
    """The same body with one to three things on it."""
    known = EXTRAS.get(thing.label)
    if not known or not draw.chance(SHARE):
        return thing
    params = thing.keys["params"]
    size = [params.get("length", params.get("diameter")), params.get("width", params.get("diameter")), params["height"]]
    parts = [{key: thing.keys[key] for key in BY_ITSELF if key in thing.keys}]
    for _ in range(draw.randint(1, 3 if len(known) > 2 else 1)):
        shape, ranges, (ahead, aside, up) = draw.choice(known)
        place = [draw.number(-ahead, ahead) * size[0] / 2, draw.number(-aside, aside) * size[1] / 2, up * size[2]]
        parts.append({"shape": shape, "params": {key: round(draw.number(*limits) * size[2], 4) for key, limits in ranges.items()},
                      "at": [round(value, 3) for value in place], "material": draw.material(size=(0.03, 0.2))})
    thing.keys = {"parts": parts}
    return thing
