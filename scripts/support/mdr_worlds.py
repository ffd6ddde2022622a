"""Where deskewing is tried: the corridor of the quadruped paper, and a room that is walked through and turned in."""
import sim_world

MOUNTS = ("--mounts", "scan", "imu", "odom")
LONG, WIDE, THICK = 8.0, 6.0, 0.15  # m, of the room, between its walls
SECONDS = {"corridor": 97.0, "walk": 24.0, "rotation": 9.0}
# Five degrees of roll with each stride and of pitch with each step; it sways and bounces as the preset `gait` does.
STAMPING = [{"frequency": 2.0, "roll_deg": 5.0, "yaw_deg": 0.7, "y": 0.006},
            {"frequency": 4.0, "pitch_deg": 5.0, "x": 0.003, "z": 0.008, "phase_deg": 40}]
WALLS = {"east": (1, 0, LONG / 2), "west": (-1, 0, LONG / 2), "north": (0, 1, WIDE / 2), "south": (0, -1, WIDE / 2)}  # of a Room


def corridor(at_once):
    """The corridor; `at_once`: scanned without distortion, all else, noise included, being the same."""
    world = sim_world.shipped("quad_corridor")
    named = {**world, "name": f"mdr_corridor_{'instant' if at_once else 'swept'}"}
    return sim_world.with_mounts(named, {"scan": {"at_once": at_once}})


def _room(name, motion):
    world = sim_world.shipped("quad_corridor")
    bodies = [{"name": wall, "shape": "wall", "params": {"length": (WIDE if x else LONG) + 2 * THICK, "width": THICK, "height": 2.6},
               "pose": [x * (far + THICK / 2), y * (far + THICK / 2), 90 if x else 0]} for wall, (x, y, far) in WALLS.items()]
    bodies += [{"name": f"pillar_{i}", "shape": "box", "params": {"length": 0.3, "width": 0.3, "height": 2.6}, "pose": pose}
               for i, pose in enumerate(([3.2, 1.2, 0], [-1.0, -2.85, 0], [-3.85, 0.8, 0], [1.0, 2.4, 30]))]
    return {**world, "name": name, "bodies": bodies, "dimensions": [], "robot": {**world["robot"], "motion": motion}}


def walk():
    """At 1 m/s round a room, turning at up to 60 degrees a second, while the body rolls and pitches by 5 degrees."""
    return _room("mdr_walk", {"points": [[-2, -1.5, 0], [2, -1.5], [2, 1.2], [-2, 1.2]], "loop": True, "speed": 1.0, "acceleration": 1.0,
                              "turn_rate_deg": 60, "corner": 0.3, "shake": STAMPING})


def rotation(rate):
    """On the spot, `rate` degrees a second, there and back."""
    turns = [{"at": [0.3, -0.2], "yaw_deg": yaw} for yaw in (0, 170, 0, 170)]
    return _room(f"mdr_rotation_{rate}", {"points": turns, "speed": 1.0, "acceleration": 1.0, "turn_rate_deg": rate, "shake": "gait"})
