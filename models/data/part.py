"""Simple solids from which bodies are put together."""


class Assembly:
    """Parts of one body; places are x, y, z of a part's foot, angles in degrees."""

    def __init__(self, draw):
        self.draw, self.parts = draw, []

    def solid(self, shape, params, at, paint, tilt=(0, 0, 0)):
        turned = [round(float(angle), 2) for angle in tilt] if any(tilt) else []
        self.parts.append({"shape": shape, "params": {key: round(max(0.004, size), 4) for key, size in params.items()},
                           "at": [round(float(value), 4) for value in at] + turned, "material": paint})

    def box(self, length, width, height, at, paint, tilt=(0, 0, 0)):
        self.solid("box", {"length": length, "width": width, "height": height}, at, paint, tilt)

    def round(self, shape, diameter, height, at, paint, tilt=(0, 0, 0)):
        """`shape`: cylinder or cone."""
        self.solid(shape, {"diameter": diameter, "height": height}, at, paint, tilt)

    def bar(self, thick, height, at, paint, square, tilt=(0, 0, 0)):
        if square:
            self.box(thick, thick, height, at, paint, tilt)
        else:
            self.round("cylinder", thick, height, at, paint, tilt)

    def ball(self, diameter, at, paint):
        self.solid("sphere", {"diameter": diameter}, at, paint)
