"""Found, split and merged on clusters laid out by hand."""
import math

import body_score
import numpy
import pytest
from body_score import GROUND, UNCLUSTERED, Shape
from kitti_labels import Body

SHAPE = Shape(numpy.array([10.0, 0.3]), numpy.array([10.4, 0.0]), 8.5)


def body(x=10.0, y=0.0, kind="Car"):
    """4 m long, 2 m wide, 2 m high, along x."""
    return Body(kind, 0, (0, 0, 0, 0), numpy.array([x, y, 0.0]), numpy.array([4.0, 2.0, 2.0]), numpy.eye(3))


def row(count, x, y=0.0):
    """Points one above the other."""
    return numpy.stack([numpy.full(count, x), numpy.full(count, y), numpy.linspace(-0.9, 0.9, count)], axis=1)


def score(bodies, *groups, fewest=1):
    """`groups`: (place, points)."""
    points = numpy.concatenate([points for _, points in groups])
    places = numpy.concatenate([numpy.full(len(points), place) for place, points in groups])
    return body_score.score(bodies, points, places, [SHAPE] * (places.max() + 1), fewest)


def test_one_cluster_on_one_body_is_found_whole():
    outcome, = score([body()], (0, row(10, 9)))
    assert (outcome.found, outcome.split, outcome.merged, outcome.points) == (True, False, False, 10)


@pytest.mark.parametrize("clustered, found", [(5, True), (4, False)])
def test_found_is_half_of_the_points_that_are_not_ground(clustered, found):
    outcome, = score([body()], (0, row(clustered, 9)), (UNCLUSTERED, row(10 - clustered, 10)), (GROUND, row(30, 11)))
    assert outcome.found is found and outcome.points == 40
    assert math.isnan(outcome.range_error) is not found


def test_body_without_cluster_is_not_found():
    outcome, = score([body()], (UNCLUSTERED, row(10, 9)))
    assert (outcome.found, outcome.split, outcome.merged, outcome.main) == (False, False, False, -1)


@pytest.mark.parametrize("within, split", [(6, True), (5, False)])
def test_split_is_another_cluster_with_most_of_its_points_in_the_box(within, split):
    outcome, = score([body()], (0, row(20, 9)), (1, numpy.concatenate([row(within, 11), row(10 - within, 13)])))
    assert outcome.split is split and outcome.found


@pytest.mark.parametrize("beyond, merged", [(3, True), (2, False)])
def test_merged_is_a_cluster_that_reaches_far_beyond_the_box(beyond, merged):
    outcome, = score([body()], (0, numpy.concatenate([row(10 - beyond, 9), row(beyond, 12.6)])))
    assert outcome.merged is merged


def test_points_close_to_the_box_are_no_merge():
    outcome, = score([body()], (0, numpy.concatenate([row(5, 9), row(5, 12.4)])))
    assert not outcome.merged


def test_two_bodies_of_one_cluster_are_merged_both():
    outcomes = score([body(y=0.0), body(y=2.2)], (0, numpy.concatenate([row(10, 9, 0.0), row(10, 9, 2.2)])))
    assert [outcome.merged for outcome in outcomes] == [True, True]


def test_bodies_of_few_points_and_areas_without_labels_do_not_count():
    assert score([body(), body(kind="DontCare")], (0, row(9, 9)), fewest=10) == []


def test_errors_are_estimate_minus_truth():
    outcome, = score([body(y=2.0)], (0, numpy.concatenate([row(10, 8.2, 1.5), row(10, 8.2, 2.5)])))
    assert outcome.range_error == pytest.approx(8.5 - math.hypot(8, 1))
    assert outcome.points_range_error == pytest.approx(math.hypot(8.2, 1.5) - math.hypot(8, 1))
    truth = (math.atan2(1, 12) + math.atan2(3, 8)) / 2
    assert outcome.azimuth_error == pytest.approx((math.atan2(1.5, 8.2) + math.atan2(2.5, 8.2)) / 2 - truth)
    assert outcome.centre_error == pytest.approx(1.7) and outcome.aligned_centre_error == pytest.approx(math.hypot(0.4, 2))


def test_single_returns_before_a_body_do_not_make_its_range():
    assert body_score.near_range(numpy.concatenate([row(1, 7), row(99, 9)])) == 9
    assert body_score.near_range(row(5, 7)) == 7


def test_places_are_told_by_coordinates():
    cloud = numpy.array([[1, 2, 3], [4, 5, 6], [7, 8, 9], [0.1, 0.2, 0.3]], numpy.float32)
    places = body_score.places_of(cloud, cloud[[3, 0, 1]], cloud[[1, 3]], [4, 0])
    assert list(places) == [UNCLUSTERED, 4, GROUND, 0]
