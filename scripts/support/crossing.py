"""A single boat that crosses ahead of a vessel that lies still: where it truly is at each cloud."""
import math
import typing

import numpy

import outline
from kitti_messages import fields

SPEED = 3.0  # m/s
ASIDE = math.radians(40.0)  # beyond, the picture may cut it
NEAR = 3.0  # m, half its length: an obstacle that is farther off is not the boat
FEWEST = 10  # returns: cluster's min_points


class Moment(typing.NamedTuple):
    """Of one cloud. Places are horizontal, in the LiDAR's true frame."""
    stamp: object
    middle: numpy.ndarray  # m
    velocity: numpy.ndarray  # m/s
    seen_after: float  # s from the stamp to the beams that met it, their median

    def azimuth_rate(self):
        """rad/s."""
        (x, y), (u, v) = self.middle, self.velocity
        return (x * v - y * u) / (x * x + y * y)

    def found(self, obstacles):
        """The obstacle that stands for the boat, rather one that both sensors see; None without."""
        away = lambda o: math.hypot(o.position.x - self.middle[0], o.position.y - self.middle[1])
        near = [o for o in obstacles if away(o) <= NEAR]
        return min(near, key=lambda o: (o.source != o.SOURCE_BOTH, away(o)), default=None)


def moments(frames, settled):
    """Of the clouds in which the boat goes at its full speed and the LiDAR sees enough of it, later than `settled` [s] after
    the first."""
    middles = [outline.middle(_boat(frame)[1])[:2] for frame in frames]
    seconds = [(frame.stamp - frames[0].stamp).to_sec() for frame in frames]
    velocities = numpy.gradient(numpy.array(middles), seconds, axis=0)
    out = []
    for frame, after, middle, velocity in zip(frames, seconds, middles, velocities):
        number, _ = _boat(frame)
        returns = fields(frame.cloud, "time")[frame.points["body"] == number]
        full = abs(numpy.linalg.norm(velocity) - SPEED) < 0.1 * SPEED
        if after >= settled and full and abs(math.atan2(middle[1], middle[0])) <= ASIDE and len(returns) >= FEWEST:
            out.append(Moment(frame.stamp, middle, velocity, float(numpy.median(returns))))
    return out


def _boat(frame):
    return next((number, body) for number, body in frame.bodies.items() if body.label == "boat")
