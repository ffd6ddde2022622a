"""The lane that a car drives through, and what counts as false in it."""
import math

import lane_score
import numpy
import pytest
from kitti_labels import BadFile, Body, Calibration

UP = numpy.array([0.0, 0.0, 1.0])
# a camera where the LiDAR is; 100 px a unit of slope, middle at 0, 0
CALIBRATION = Calibration(numpy.array([[100.0, 0, 0, 0], [0, 100, 0, 0], [0, 0, 1, 0]]),
                          numpy.array([[0.0, -1, 0, 0], [0, 0, -1, 0], [1, 0, 0, 0], [0, 0, 0, 1]]))


def pose(x, y, yaw=0.0):
    T = numpy.eye(4)
    T[:2, :2] = [[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]]
    T[:2, 3] = x, y
    return T


def straight(metres=21):
    return [pose(float(x), 0.0) for x in range(metres)]


def lane(poses=None, frame=0):
    return lane_score.Lane(lane_score.way_ahead(poses or straight(), frame), UP, 1.7)


def contains(lane, x, y, above=1.0):
    return bool(lane.contains(numpy.array([[x, y, above - 1.7]]))[0])


def test_lane_goes_from_three_metres_ahead_to_the_end_and_one_to_each_side():
    here = lane()
    assert all(contains(here, x, y) for x, y in ((3.01, 0), (19.99, 0), (10, 0.99), (10.5, -0.99)))
    assert not any(contains(here, x, y) for x, y in ((2.99, 0), (20.01, 0), (10, 1.01), (10, -1.01), (-5, 0)))


def test_lane_has_a_floor_and_a_ceiling():
    assert [contains(lane(), 10, 0, above) for above in (0.29, 0.31, 2.19, 2.21)] == [False, True, True, False]


def test_lane_is_seen_from_where_the_car_is():
    poses = [pose(0.0, float(y), math.pi / 2) for y in range(21)]  # drives along y of the first frame
    here = lane(poses, 10)
    assert contains(here, 9.99, 0) and not contains(here, 10.01, 0) and not contains(here, 0, 5)


def test_lane_follows_a_bend():
    angles = numpy.linspace(0.0, math.pi / 2, 40)  # a quarter of a circle of 20 m
    here = lane([pose(20 * math.sin(a), 20 - 20 * math.cos(a), a) for a in angles])

    def at(radius):
        return radius * math.sin(1.0), 20 - radius * math.cos(1.0)

    assert contains(here, *at(20)) and contains(here, *at(19.03)) and not contains(here, *at(21.02))
    assert not contains(here, 15, 0)


def test_car_that_stands_or_is_about_to_stop_has_no_lane():
    assert len(lane_score.way_ahead([pose(0, 0)] * 5, 0)) == 0
    assert len(lane_score.way_ahead(straight(), 18)) == 0 and len(lane_score.way_ahead([], 0)) == 0
    assert len(lane_score.way_ahead(straight(), 16)) == 2


def points(x, y, count=10):
    return numpy.stack([numpy.full(count, x), numpy.full(count, y), numpy.full(count, -0.7)], axis=1)


def false(obstacle_points, bodies=(), middle=None):
    middle = obstacle_points.mean(axis=0) if middle is None else numpy.array(middle)
    return lane_score.false_obstacles(lane(), [(obstacle_points, middle)], list(bodies), CALIBRATION) == [0]


def test_obstacle_in_the_lane_is_false_and_beside_it_is_not():
    assert false(points(10, 0)) and not false(points(10, 3))


@pytest.mark.parametrize("inside, expected", [(5, True), (4, False)])
def test_half_of_the_points_make_it_one_in_the_lane(inside, expected):
    spread = numpy.concatenate([points(10, 0, inside), points(10, 4, 10 - inside)])
    assert false(spread, middle=[10, 4, -0.7]) is expected


def test_middle_of_the_box_makes_it_one_in_the_lane():
    assert false(numpy.concatenate([points(10, -2), points(10, 2)]), middle=[10, 0, -0.7])


def labelled(x, y, kind="Car", image_box=(0, 0, 0, 0)):
    return Body(kind, 0, image_box, numpy.array([x, y, -0.7]), numpy.array([4.0, 2.0, 1.5]), numpy.eye(3))


def test_labelled_body_may_be_in_the_lane_and_half_a_metre_about_it():
    assert not false(points(10, 0), [labelled(10, 0)]) and not false(points(12.4, 0), [labelled(10, 0)])
    assert false(points(12.6, 0), [labelled(10, 0)])


def test_area_without_labels_excuses():
    # at 10 m: 0 px across, 7 px down
    assert not false(points(10, 0), [labelled(0, 0, "DontCare", (-5, 0, 5, 10))])
    assert false(points(10, 0), [labelled(0, 0, "DontCare", (5, 0, 15, 10))])


def test_poses_are_read_and_a_fault_is_named(tmp_path):
    file = tmp_path / "poses.csv"
    file.write_text("frame,r00\n000007,1,0,0,4,0,1,0,5,0,0,1,6\n")
    poses = lane_score.read_poses(file)
    assert list(poses) == ["000007"] and list(poses["000007"][:, 3]) == [4, 5, 6, 1]
    file.write_text("frame,r00\n000007,1,0\n")
    with pytest.raises(BadFile, match="poses.csv:2"):
        lane_score.read_poses(file)


def test_stillest_body_is_the_one_that_wanders_least():
    poses = straight()
    parked = [(frame, labelled(30 - frame + 0.1 * (-1) ** frame, 5, "Van")) for frame in range(20)]
    ahead = [(frame, labelled(10, 0)) for frame in range(20)]
    track, kind, frames, wander = lane_score.stillest({1: ahead, 2: parked, 3: parked[:3]}, poses)
    assert (track, kind, frames) == (2, "Van", 20) and wander == pytest.approx(0.1)
    assert lane_score.stillest({3: parked[:3]}, poses) is None
