"""Bodies beside each other and beside the robot's way."""
import math

SMALLEST = 12  # px that a body is high or wide where it is put
FARTHEST = 60.0  # m
WALK = 8.0  # s
PASSING = 1.0  # m from the robot's way


class Scene:
    def __init__(self, draw, places, camera):
        self.draw, self.places, self.camera = draw, places, camera  # places: x, y, heading of the robot
        self.circles, self.bodies = [], []

    def free(self, x, y, radius):
        apart = lambda other: math.hypot(x - other[0], y - other[1]) > radius + other[2]
        return all(map(apart, self.circles)) and all(
            math.hypot(x - px, y - py) > radius + 0.6 for px, py in self.along_way())

    def along_way(self):
        for (ax, ay, _), (bx, by, _) in zip(self.places, self.places[1:] or self.places):
            for i in range(9):
                yield ax + (bx - ax) * i / 8, ay + (by - ay) * i / 8

    def take(self, circles):
        self.circles += circles

    def walks_into_robot(self, x, y, yaw, length):
        places = [(x + length * i / 20 * math.cos(yaw), y + length * i / 20 * math.sin(yaw)) for i in range(21)]
        return any(math.hypot(px - rx, py - ry) < PASSING for px, py in places for rx, ry in self.along_way())

    def add(self, thing, x, y, z, yaw, **more):
        """People who walk set out from there; who would walk into the robot stand."""
        x, y = round(x, 3), round(y, 3)
        params = thing.keys.get("params", {})
        if params.get("speed") and self.walks_into_robot(x, y, yaw, WALK * params["speed"]):
            params["speed"] = 0
        keys = {"name": f"{thing.label or thing.keys['shape']}_{len(self.bodies)}", **thing.keys, **more}
        if thing.label:
            keys["label"] = thing.label
        speed = params.get("speed", 0)
        if speed:
            end = [round(x + WALK * speed * math.cos(yaw), 3), round(y + WALK * speed * math.sin(yaw), 3), z]
            keys["motion"] = {"points": [{"at": [x, y, z]}, {"at": end}], "speed": speed}
        else:
            keys["pose"] = [x, y, z, round(math.degrees(yaw), 1)]
        self.bodies.append(keys)

    def add_anyhow(self, thing, x, y, z, **more):
        self.add(thing, x, y, z, self.draw.uniform(-math.pi, math.pi), **more)

    def farthest(self, thing):
        return min(FARTHEST, self.camera["fx"] * thing.extent / SMALLEST)

    def try_in_view(self, thing, **more):
        """Somewhere in sight from one of the robot's places, if thirty tries find room."""
        half = 1.05 * math.atan(0.5 * self.camera["width"] / self.camera["fx"])
        near, far = thing.radius + 1.2, self.farthest(thing)
        for _ in range(30 if far > near else 0):
            px, py, heading = self.draw.choice(self.places)
            distance = near * (far / near) ** (self.draw.random() ** 1.3)  # rather near than far
            angle = heading + self.draw.uniform(-half, half)
            x, y = px + distance * math.cos(angle), py + distance * math.sin(angle)
            if self.free(x, y, thing.radius):
                self.take([(x, y, thing.radius)])
                return self.add_anyhow(thing, x, y, 0, **more)
        return None
