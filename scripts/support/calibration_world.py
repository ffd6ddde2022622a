"""A world in which a checkerboard rests in one pose after another before a camera, a LiDAR and a 2-D scanner."""
import math
import random

BOARD = "8x6x0.1"  # as calibrate_lidar_camera takes it
WIDE, HIGH = 1.0, 0.8  # m, of the plate: 9 x 7 squares and a margin
REST = 1.6  # s in each pose
HEIGHT = 0.6  # m of the scanner, where a 2-D scan must meet the boards


def _turn(roll, pitch):
    """Ry(pitch) Rx(roll), row by row."""
    a, b, c, d = math.cos(pitch), math.sin(pitch), math.cos(roll), math.sin(roll)
    return ((a, b * d, b * c), (0, c, -d), (-b, a * d, a * c))


def _board(index, draw):
    """A board that comes from afar, stays for its turn and goes again: to the sensors one board that is carried on. Bodies
    turn about z alone, so that its tilt is of the part."""
    roll, pitch = (math.radians(draw.uniform(-limit, limit)) for limit in (30, 35))
    away = draw.uniform(1.4, 2.9)
    aside = draw.uniform(-1, 1) * (math.radians(36) - math.atan(0.55 / away))
    place = [0.3 + away * math.cos(aside), away * math.sin(aside)]
    yaw = 180 + math.degrees(aside) + draw.uniform(-40, 40)
    middle = (0, 0, HEIGHT + draw.uniform(-0.12, 0.12))
    foot = [at - row[2] * HIGH / 2 for at, row in zip(middle, _turn(roll, pitch))]  # the plate's lower edge
    afar = {"at": [-80 - 2 * index, 0], "yaw_deg": yaw}
    return {"name": f"board_{index + 1}",
            "parts": [{"shape": "checkerboard", "params": {"width": WIDE, "height": HIGH},
                       "at": [*foot, math.degrees(roll), math.degrees(pitch), 0]}],
            "motion": {"points": [{**afar, "pause": index * REST + 0.05}, {"at": place, "yaw_deg": yaw, "pause": REST - 0.1}, afar],
                       "speed": 1e3, "acceleration": 1e6, "turn_rate_deg": 1e6}}


def world(name, seed, poses):
    draw = random.Random(seed)
    wall = lambda name, length, pose: {"name": name, "shape": "wall", "params": {"length": length, "height": 3}, "pose": pose}
    return {
        "name": name,
        "ground": {"kind": "plane", "material": {"colour": [0.4, 0.4, 0.38], "reflectivity": 0.4}},
        "light": {"sun": 0.3, "sky": 0.8},
        "bodies": [wall("ahead", 12, [6, 0, 90]), wall("left", 14, [0, 6, 0]), wall("right", 14, [0, -6, 0]),
                   *(_board(i, draw) for i in range(poses))],
        "robot": {"name": "rig", "pose": [0, 0, 0], "mounts": [
            {"name": "lidar", "model": "vlp16", "pose": [0.05, 0, HEIGHT + 0.1]},
            {"name": "scan", "model": "rplidar_a3", "pose": [0.05, 0, HEIGHT]},
            {"name": "camera", "model": "wide_105", "pose": [0.3, 0, HEIGHT - 0.1, 0, 3, 0], "rate": 4.0, "samples": 2}]}}
