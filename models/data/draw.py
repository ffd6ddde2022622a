"""Random numbers of one world: the same seed gives the same world on any machine."""
import colorsys
import math
import random

PATTERNS = {False: {"noise": 3, "blotches": 2, "stripes": 1, "planks": 1, "checker": 1},
            True: {"noise": 2, "slants": 1, "dots": 1, "grid": 1, "bricks": 1}}


class Draw(random.Random):
    """`held_out` worlds are drawn from shapes, patterns and skies that the others do not have."""

    def __init__(self, split, seed):
        super().__init__(f"{split}/{seed}")
        self.held_out = split == "held_out"

    def number(self, low, high, digits=3):
        return round(self.uniform(low, high), digits)

    def spread(self, low, high, digits=3):
        """Evenly over the logarithm: as many from 2 to 4 as from 20 to 40."""
        return round(math.exp(self.uniform(math.log(low), math.log(high))), digits)

    def chance(self, share):
        return self.random() < share

    def near(self, value, share=0.15):
        return round(value * self.uniform(1 - share, 1 + share), 3)

    def one_of(self, weights):
        """A key, as often as its weight says."""
        return self.choices(list(weights), list(weights.values()))[0]

    def kind(self, usual, held_out):
        return self.one_of(held_out if self.held_out else usual)

    def colour(self, value=(0.08, 0.9), saturation=(0.0, 1.0), hue=(0.0, 1.0)):
        """Linear red, green, blue."""
        r, g, b = colorsys.hsv_to_rgb(self.uniform(*hue) % 1.0, self.uniform(*saturation), self.uniform(*value))
        return [round(c ** 2.2, 4) for c in (r, g, b)]

    def like(self, colour, share=0.25):
        """Near it: what was painted the same, elsewhere and later."""
        factor = self.uniform(1 - share, 1 + share)
        return [round(min(1.0, max(0.0, c * factor * self.uniform(1 - share / 3, 1 + share / 3))), 4) for c in colour]

    def alike(self, count, size, gloss):
        """Materials of one body's parts, more often than not of about one colour."""
        colour = self.colour()
        return [self.material(self.like(colour) if self.chance(0.5) else None, size, 0.6, gloss) for _ in range(count)]

    def material(self, colour=None, size=(0.05, 0.6), plain=0.5, gloss=None, wear=0.6):
        """One colour or a pattern of two, more or less dirty."""
        colour = colour or self.colour()
        out = {"colour": colour, "texture": "plain", "wear": self.number(0, wear)}
        if not self.chance(plain):
            out["texture"] = self.one_of(PATTERNS[self.held_out])
            out["texture_size"] = self.spread(*size)
            out["colour2"] = self.like(colour, 0.5) if self.chance(0.7) else self.colour()
        if gloss:
            out["gloss"] = self.number(*gloss)
        return out
