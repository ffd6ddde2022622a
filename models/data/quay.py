"""A quay or a jetty across the view, with bodies on it."""
import math

from data import bodies
from data.thing import shaped

ASHORE = {"bollard": 3, "person": 2, "car": 1.5, "box": 1.5, "cone": 2, "stool": 1.5, "chair": 1.5, "puppet": 1.2,
          "balloon_car": 1, "ball": 1.5}
WIDEST = 3.0  # m, radius of what stands on it


class Quay:
    def __init__(self, draw):
        self.jetty = draw.chance(0.4)
        sizes = ((6, 15), (1.8, 3), (0.3, 0.7)) if self.jetty else ((15, 60), (5, 14), (0.8, 2.2))
        self.length, self.width, self.height = (draw.number(*limits) for limits in sizes)
        distance, angle = draw.spread(4, 25), draw.uniform(-0.5, 0.5)
        self.turn = angle + draw.uniform(-0.5, 0.5)  # from the robot across it; its face looks back, about
        self.x = distance * math.cos(angle) + self.width / 2 * math.cos(self.turn)
        self.y = distance * math.sin(angle) + self.width / 2 * math.sin(self.turn)

    def place(self, along, out):
        """`along` the face and `out` towards it, from the middle."""
        c, s = math.cos(self.turn), math.sin(self.turn)
        return self.x - along * s - out * c, self.y + along * c - out * s

    def outline(self):
        return [self.place(self.length * (i / 40 - 0.5), out) for i in range(41) for out in (-self.width / 2, 0, self.width / 2)]

    def body(self, draw):
        size = {"length": self.length, "width": self.width, "height": self.height}
        return shaped("box" if self.jetty else "quay", size,
                      draw.material(draw.colour((0.2, 0.7), (0, 0.4), (0.0, 0.2)), (0.1, 1.0)))


def find_place(scene, quay, thing, taken):
    """(along, out) that is free; bollards stand at the edge."""
    draw, radius = scene.draw, thing.radius
    long, deep = quay.length / 2 - radius, quay.width / 2 - 0.3 - radius
    if long <= 0 or deep <= 0 or radius > WIDEST:
        return None
    for _ in range(20):
        along, out = draw.uniform(-long, long), deep if thing.label == "bollard" else draw.uniform(-deep, deep)
        apart = all(math.hypot(along - a, out - o) > radius + r for a, o, r in taken)
        if apart and math.hypot(*quay.place(along, out)) < scene.farthest(thing):
            return along, out
    return None


def put_quay(scene, count):
    draw = scene.draw
    quay, taken = Quay(draw), []
    if not all(scene.free(x, y, 0.8) for x, y in quay.outline()):
        return
    scene.take([(x, y, quay.width / 2) for x, y in quay.outline()])
    scene.add(quay.body(draw), quay.x, quay.y, 0, quay.turn + math.pi / 2)
    for _ in range(count):
        thing = bodies.labelled(draw, draw.one_of(ASHORE)) if draw.chance(0.85) else bodies.fixture(draw)
        if thing.label == "person":
            thing.keys["params"]["speed"] = 0  # or it would walk into the water
        found = find_place(scene, quay, thing, taken)
        if found:
            taken.append((*found, thing.radius))
            scene.add_anyhow(thing, *quay.place(*found), quay.height)
