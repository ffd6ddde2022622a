"""How far the points of a scan lie off the walls that they came from."""
import numpy

import poses
import walk_bag

WRONG = 0.2  # m between a range and the true one: of two surfaces at once, or nonsense. No deskewing mends that


class Room:
    """Upright walls, {name of the body: (normal x, normal y, distance)}: the inner face has normal . p = distance."""

    def __init__(self, walls):
        self.walls = walls

    def measured(self, walk, scan):
        """Of the returns that a wall gave and whose range is no nonsense: beam, index among the scan's returns, the wall's
        normal n x 2 and distance."""
        seen, _ = walk_bag.returns(scan.message)
        true, body = (numpy.array(values)[seen] for values in (scan.truth.ranges, scan.truth.intensities))
        names = [walk.bodies.get(int(i)) for i in body]
        ranges = numpy.array(scan.message.ranges)[seen]
        good = numpy.array([name in self.walls for name in names]) & (numpy.abs(ranges - true) < WRONG)
        index = numpy.flatnonzero(good)
        faces = numpy.array([self.walls[names[i]] for i in index]).reshape(-1, 3)
        return seen[index], index, faces[:, :2], faces[:, 2]

    def errors(self, walk, scan, points):
        """[m] of `points`, those of the scan's returns in their order, in the scanner's frame at the stamp."""
        _, index, normals, distances = self.measured(walk, scan)
        in_world = poses.apply(T_world_scan(walk, scan), points[index])
        return (in_world[:, :2] * normals).sum(axis=1) - distances

    def noise(self, walk, scan):
        """[m] The same of points at which only the range is wrong."""
        beams, _, normals, _ = self.measured(walk, scan)
        wrong = (numpy.array(scan.message.ranges) - numpy.array(scan.truth.ranges))[beams]
        ways = walk_bag.directions(scan.message)[beams] @ T_world_scan(walk, scan)[:3, :3].T
        return wrong * (ways[:, :2] * normals).sum(axis=1)


def T_world_scan(walk, scan):
    """Where the scanner truly was when the first beam left."""
    return walk.truth.at(scan.begin) @ walk.T_base_scan_true


def rms(errors):
    errors = numpy.concatenate(errors)
    return float(numpy.sqrt(numpy.mean(errors ** 2))) if len(errors) else float("nan")
