"""`kitti_tracking` and recordings like it: the clusters of the LiDAR alone against labelled bodies, frame by frame.

Counted are bodies with at least 50 points, of those that the filter lets through, in the labelled box. What found,
split and merged mean: body_score. Range: horizontal, from the LiDAR to the nearest of the labelled box against that of
the cluster's box turned to fit (a corner where two sides are seen: where bodies are round there is no surface); beside
it, against what 1 % of the cluster's points are nearer than. Azimuth: middle of the sector that the box fills, seen from the LiDAR, against that of the
cluster. Centre: horizontal, of the labelled box against the turned and the axis-aligned box of the cluster; a LiDAR
sees one or two sides, so the boxes end where the sides do.
"""
import math

import numpy

import body_score
import figures
import ground_reference
import kitti_labels
import kitti_run
import lane_score
import stage_run
from kitti_data import LIDAR_HEIGHT
from kitti_messages import Clusters, lidar_points, xyz
from poses import vector
from ros_session import SessionError

FEWEST = 50  # points in the box of a body that counts
FARTHEST = 40.0  # m, of the headline
BANDS = ((0, 10), (10, 20), (20, 30), (30, 50))  # m, horizontal
COLUMNS = ("frame", "track", "kind", "distance_m", "points", "found", "split", "merged", "range_error_m",
           "points_range_error_m", "azimuth_error_deg", "centre_error_m", "aligned_centre_error_m")
TOUCH = 0.2  # m about a labelled body where no point is called ground


class Recording:
    """Labels, calibrations and poses of a folder, by place of the frame. Raises BadFile."""

    def __init__(self, folder, poses_file):
        self.names = kitti_run.names_of(folder)
        self.calibrations = [kitti_labels.read_calibration(kitti_labels.calibration_file(folder, name))
                             for name in self.names]
        if not all(name.isdigit() for name in self.names):
            raise kitti_labels.BadFile(f"{folder / 'velodyne'}: the clouds' names should be the numbers of their frames")
        place_of = {int(name): place for place, name in enumerate(self.names)}
        labels = kitti_labels.read_tracking_labels(
            folder / "label.txt", lambda frame: self.calibrations[place_of.get(frame, 0)])
        if not labels.keys() & place_of.keys():
            raise kitti_labels.BadFile(f"{folder / 'label.txt'}: no frame has the number of a cloud in velodyne/")
        self.bodies = [labels.get(int(name), []) for name in self.names]
        self.poses = self._poses(folder, poses_file)

    @staticmethod
    def _poses(folder, file):
        """Of all frames, empty where the way cannot be found: the rest is scored without."""
        try:
            stage_run.tool("kitti_poses", folder, file)
        except SessionError as error:
            print(f"no lane to score, {error}")
            return []
        return list(lane_score.read_poses(file).values())

    def tracks(self):
        tracks = {}
        for place, bodies in enumerate(self.bodies):
            for body in bodies:
                if body.kind != kitti_labels.DONT_CARE:
                    tracks.setdefault(body.track, []).append((place, body))
        return tracks


class Score:
    """Adds up frames."""

    def __init__(self, recording):
        self.recording = recording
        self.outcomes = []  # (place of the frame, body_score.Outcome)
        self.false = []  # in the lane, a number a frame that has a lane
        self.ground = numpy.zeros((len(BANDS), 2), int)  # reference points; of these, points in clusters

    def add(self, place, answer):
        cloud, clusters = xyz(answer["/points_filtered"]), Clusters(answer["/clusters"])
        places = body_score.places_of(cloud, xyz(answer["/points_obstacle"]), clusters.points, clusters.places)
        bodies = self.recording.bodies[place]
        self.outcomes += [(place, outcome)
                          for outcome in body_score.score(bodies, cloud, places, clusters.shapes, FEWEST)]
        self._add_ground(cloud, places, bodies)
        self._add_lane(place, answer, clusters)

    def _add_ground(self, cloud, places, bodies):
        ground = ground_reference.is_ground(cloud, LIDAR_HEIGHT)
        for body in bodies:
            if body.kind != kitti_labels.DONT_CARE:
                ground &= ~body.contains(cloud, TOUCH)
        distance = numpy.hypot(cloud[:, 0], cloud[:, 1])
        for row, (near, far) in zip(self.ground, BANDS):
            here = ground & (distance >= near) & (distance < far)
            row += numpy.count_nonzero(here), numpy.count_nonzero(here & (places >= 0))

    def _add_lane(self, place, answer, clusters):
        way = lane_score.way_ahead(self.recording.poses, place)
        if len(way) < 2:
            return  # the car stands, or the recording ends
        plane = answer["/ground_plane"]
        normal, height = (vector(plane.normal), plane.height) if plane.found else (numpy.eye(3)[2], LIDAR_HEIGHT)
        obstacles = answer["/obstacles"].obstacles
        seen = [(lidar_points(obstacle, obstacles, clusters), vector(obstacle.position)) for obstacle in obstacles]
        seen = [(points, middle) for points, middle in seen if points is not None]
        false = lane_score.false_obstacles(lane_score.Lane(way, normal, height), seen, self.recording.bodies[place],
                                           self.recording.calibrations[place])
        self.false.append(len(false))
        for x, y, z in (seen[i][1] for i in false):
            print(f"frame {self.recording.names[place]}: false obstacle in the lane at {x:.1f} {y:.1f} {z:.1f} m")

    def rows(self):
        for place, o in self.outcomes:
            yield (self.recording.names[place], o.body.track, o.body.kind, o.body.distance, o.points, int(o.found),
                   int(o.split), int(o.merged), o.range_error, o.points_range_error,
                   math.degrees(o.azimuth_error), o.centre_error, o.aligned_centre_error)

    def report(self):
        """The lines of the figures."""
        yield self._about()
        outcomes = [outcome for _, outcome in self.outcomes]
        yield from body_figures([o for o in outcomes if o.body.distance <= FARTHEST], "")
        for near, far in BANDS:
            yield from body_figures([o for o in outcomes if near <= o.body.distance < far], f"/{near}-{far}m")
        rate = sum(self.false) / len(self.false) if self.false else math.nan
        yield figures.line("kitti/tracking/false_in_lane", rate, "a-frame", len(self.false),
                           figures.bootstrap(self.false, lambda counts: sum(counts) / len(counts)))
        yield figures.share("kitti/tracking/ground_left", self.ground[:, 1].sum(), self.ground[:, 0].sum())
        for (near, far), (points, left) in zip(BANDS, self.ground):
            yield figures.share(f"kitti/tracking/ground_left/{near}-{far}m", left, points)

    def _about(self):
        bodies = {outcome.body.track for _, outcome in self.outcomes}
        about = (f"{len(self.outcomes)} boxes of {len(bodies)} labelled bodies count; boxes of one body are much alike, "
                 "so the intervals are narrower than other bodies would show")
        still = self.recording.poses and lane_score.stillest(self.recording.tracks(), self.recording.poses)
        if still:
            about += "\ntrack {} ({}, {} frames) moves least over ground: {:.2f} m about its mean".format(*still)
        return about


def body_figures(outcomes, band):
    count, found = len(outcomes), [outcome for outcome in outcomes if outcome.found]

    def share(name, holds):
        return figures.share(f"kitti/tracking/{name}{band}", sum(map(holds, outcomes)), count)

    def median(name, unit, error):
        return figures.median(f"kitti/tracking/{name}_median_error{band}",
                              [value for value in map(error, found) if math.isfinite(value)], unit)

    yield share("recall", lambda o: o.found)
    yield share("split_merge_rate", lambda o: o.split or o.merged)
    yield share("split_rate", lambda o: o.split)
    yield share("merge_rate", lambda o: o.merged)
    yield median("range", "m", lambda o: abs(o.range_error))
    yield median("points_range", "m", lambda o: abs(o.points_range_error))
    yield median("azimuth", "deg", lambda o: math.degrees(abs(o.azimuth_error)))
    yield median("centre", "m", lambda o: o.centre_error)
    yield median("aligned_centre", "m", lambda o: o.aligned_centre_error)


def run(session, folder, out, every):
    from field_fusion.msg import GroundPlane
    from sensor_msgs.msg import PointCloud2

    also = {"/points_filtered": PointCloud2, "/points_obstacle": PointCloud2, "/ground_plane": GroundPlane}
    out.mkdir(parents=True, exist_ok=True)
    score = Score(Recording(folder, out / "poses.csv"))
    for place, answer in kitti_run.play(session, folder, out, every=every, also=also):
        score.add(place, answer)
    return score
