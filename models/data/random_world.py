#!/usr/bin/env python3
"""Draws a random world to learn from: models/data/random_world.py OUT.yaml --seed N --split train."""
import argparse
import math
import pathlib

import yaml

from data import bodies, surroundings
from data.draw import Draw
from data.thing import shaped

FRAMES = 3  # pictures of a world
PAUSE = 2.0  # s between them
AFLOAT = {"cage": 3, "boat": 3, "buoy": 3, "box": 0.3}
ASHORE = {"bollard": 3, "person": 2, "car": 1.5, "box": 1.5, "cone": 2, "stool": 1.5, "chair": 1.5, "puppet": 1.2,
          "balloon_car": 1, "ball": 1}
ON_LAND = {"car": 1.6, "balloon_car": 2.2, "puppet": 2.2, "person": 1.6, "box": 1.4, "cone": 1.6, "ball": 1.6,
           "stool": 2, "chair": 2, "bollard": 1.2, "boat": 0.5, "cage": 0.5, "buoy": 0.4}
SMALLEST = 9  # px that a body is high or wide where it is put


class Scene:
    """Bodies beside each other and beside the robot's way."""

    def __init__(self, draw, places, camera):
        self.draw, self.places, self.camera = draw, places, camera
        self.circles, self.bodies = [], []

    def free(self, x, y, radius):
        apart = lambda other: math.hypot(x - other[0], y - other[1]) > radius + other[2]
        return all(map(apart, self.circles)) and all(
            math.hypot(x - px, y - py) > radius + 0.6 for px, py in self.along_way())

    def along_way(self):
        for (ax, ay, _), (bx, by, _) in zip(self.places, self.places[1:] or self.places):
            for i in range(9):
                yield ax + (bx - ax) * i / 8, ay + (by - ay) * i / 8

    def add(self, thing, x, y, z, yaw, **more):
        kind = thing.label or thing.keys["shape"]
        keys = {"name": f"{kind}_{len(self.bodies)}", **thing.keys, **more}
        if thing.label:
            keys["label"] = thing.label
        speed = keys["params"].get("speed") if keys["shape"] == "person" else 0
        if speed:
            far = 8 * speed
            end = [round(x + far * math.cos(yaw), 3), round(y + far * math.sin(yaw), 3), z]
            keys["motion"] = {"points": [{"at": [round(x, 3), round(y, 3), z]}, {"at": end}], "speed": speed}
        else:
            keys["pose"] = [round(x, 3), round(y, 3), z, round(math.degrees(yaw), 1)]
        self.bodies.append(keys)

    def farthest(self, thing):
        return min(60.0, self.camera["fx"] * thing.extent / SMALLEST)

    def try_in_view(self, thing, **more):
        """Somewhere in sight from one of the robot's places; thirty tries."""
        half = 1.05 * math.atan(0.5 * self.camera["width"] / self.camera["fx"])
        near, far = thing.radius + 1.2, self.farthest(thing)
        for _ in range(30 if far > near else 0):
            px, py, heading = self.draw.choice(self.places)
            distance, angle = self.draw.spread(near, far), heading + self.draw.uniform(-half, half)
            x, y = px + distance * math.cos(angle), py + distance * math.sin(angle)
            if self.free(x, y, thing.radius):
                self.circles.append((x, y, thing.radius))
                self.add(thing, x, y, 0, self.draw.uniform(-math.pi, math.pi), **more)
                return


def put_quay(scene, weights, count):
    """A quay or a jetty across the view, with bodies on it."""
    draw = scene.draw
    jetty = draw.chance(0.4)
    length, width, height = (draw.number(6, 15), draw.number(1.8, 3), draw.number(0.3, 0.7)) if jetty else (
        draw.number(15, 60), draw.number(5, 14), draw.number(0.8, 2.2))
    distance, angle = draw.spread(4, 25), draw.uniform(-0.5, 0.5)
    turn = angle + draw.uniform(-0.5, 0.5)  # its face looks back at the robot, about
    cx, cy = distance * math.cos(angle) + width / 2 * math.cos(turn), distance * math.sin(angle) + width / 2 * math.sin(turn)
    local = lambda u, v: (cx - u * math.sin(turn) - v * math.cos(turn), cy + u * math.cos(turn) - v * math.sin(turn))
    across = [local(length * i / 40 - length / 2, v) for i in range(41) for v in (-width / 2, 0, width / 2)]
    if not all(scene.free(x, y, 0.8) for x, y in across):
        return
    scene.circles += [(x, y, width / 2) for x, y in across]
    shape = "box" if jetty else "quay"
    quay = shaped(shape, {"length": length, "width": width, "height": height},
                  draw.material(draw.colour((0.2, 0.7), (0, 0.4), (0.0, 0.2)), (0.1, 1.0)))
    scene.add(quay, cx, cy, 0, turn + math.pi / 2)
    put_on(scene, local, (length, width, height), weights, count)


def put_on(scene, local, size, weights, count):
    draw, taken = scene.draw, []
    for _ in range(count):
        label = draw.one_of(weights)
        thing = bodies.labelled(draw, label) if draw.chance(0.85) else bodies.fixture(draw)
        half_length, half_width = size[0] / 2 - thing.radius, size[1] / 2 - 0.3
        if half_length <= 0 or thing.radius > half_width or thing.radius > 3:
            continue
        for _ in range(20):
            u = draw.uniform(-half_length, half_length)
            v = half_width - thing.radius if thing.label == "bollard" else draw.uniform(thing.radius - half_width, half_width - thing.radius)
            x, y = local(u, v)
            if math.hypot(x, y) > scene.farthest(thing) or any(math.hypot(u - a, v - b) < thing.radius + r for a, b, r in taken):
                continue
            taken.append((u, v, thing.radius))
            thing.keys.get("params", {}).update({"speed": 0} if thing.label == "person" else {})
            scene.add(thing, x, y, round(size[2], 3), draw.uniform(-math.pi, math.pi))
            break


def fill(scene, wet, empty):
    draw = scene.draw
    count = draw.randint(3, 15)
    if wet and draw.chance(0.6):
        put_quay(scene, ASHORE, 0 if empty else draw.randint(3, 12))
    for _ in range(0 if empty else count):
        thing = bodies.labelled(draw, draw.one_of(AFLOAT if wet else ON_LAND))
        scene.try_in_view(thing, **({"floats": True} if wet else {"leans": draw.chance(0.3)}))
    for _ in range(draw.randint(0, 3) if wet else draw.randint(1, 8)):
        scene.try_in_view(bodies.fixture(draw, wet))


def random_world(split, seed):
    """As a dictionary, ready to be written."""
    draw = Draw(split, seed)
    wet, empty = draw.chance(0.55), draw.chance(0.07)
    camera = surroundings.camera(draw, draw.chance(0.75))
    places, keys = surroundings.way(draw, wet, FRAMES)
    scene = Scene(draw, places, camera)
    fill(scene, wet, empty)
    ground = surroundings.water(draw) if wet else surroundings.land(draw)
    return {"name": f"{split}_{seed}", "ground": ground, "light": surroundings.light(draw), "bodies": scene.bodies,
            "robot": {"name": "robot", **keys, "mounts": [camera]}}


def write(file, split, seed):
    text = yaml.safe_dump(random_world(split, seed), sort_keys=False, default_flow_style=None, width=1000)
    pathlib.Path(file).write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out")
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--split", choices=("train", "val", "held_out"), default="train")
    args = parser.parse_args()
    write(args.out, args.split, args.seed)


if __name__ == "__main__":
    main()
