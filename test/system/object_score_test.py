"""Which obstacle stands for a labelled body, and what is counted then."""
import math

import numpy
import object_score
import pytest
from kitti_labels import Body
from object_score import Candidate


def body(kind="Car", image_box=(100, 100, 200, 150), x=10.0):
    """4 m long, 2 m wide, 2 m high, along x."""
    return Body(kind, -1, image_box, numpy.array([x, 0.0, 0.0]), numpy.array([4.0, 2.0, 2.0]), numpy.eye(3))


def lidar(inside, outside=0, label="", by="lidar", near=8.1):
    points = numpy.zeros((inside + outside, 3)) + [10, 0, 0]
    points[inside:] += [5, 0, 0]
    return Candidate(by, label, points, None, near, 0.01)


def camera(image_box=(100, 100, 200, 150), label="car", near=9.0):
    return Candidate("camera", label, None, image_box, near, 0.02)


def test_overlap_of_boxes_in_the_image():
    assert object_score.overlap((0, 0, 10, 10), (0, 0, 10, 10)) == 1
    assert object_score.overlap((0, 0, 10, 10), (5, 0, 15, 10)) == pytest.approx(50 / 150)
    assert object_score.overlap((0, 0, 10, 10), (10, 0, 20, 10)) == 0


def test_lidar_obstacle_stands_for_the_body_that_has_most_of_its_points():
    assert object_score.stands_for(body(), [lidar(6, 5)]) and not object_score.stands_for(body(), [lidar(5, 5)])


def test_the_largest_part_stands_for_a_body_and_points_count_before_pixels():
    small, large = lidar(4), lidar(9)
    assert object_score.stands_for(body(), [camera(), small, large]) is large
    alone = camera()
    assert object_score.stands_for(body(), [lidar(1, 8), alone]) is alone


def test_camera_obstacle_must_overlap_by_half():
    assert object_score.stands_for(body(), [camera((100, 100, 160, 150))])
    assert not object_score.stands_for(body(), [camera((100, 100, 145, 150))])
    assert object_score.stands_for(body(), []) is None


def outcome(fused, kind="Car", image_box=(100, 100, 200, 150), raw=50, camera_only=None):
    found = {"": fused, "camera_only/": camera_only, "lidar_only/": None}
    return object_score.Outcome("000000", body(kind, image_box), raw, found)


def figures(outcomes):
    lines = [line.split() for line in object_score.system_figures(outcomes, "")]
    return {name: (float(value), int(n[2:])) for _, name, value, _, n, _ in lines}


def test_figures_count_bodies_that_nothing_stands_for():
    seen = figures([outcome(lidar(9, label="car", by="both")), outcome(None)])
    assert seen["kitti/object/obstacle_recall"] == (0.5, 2)
    assert seen["kitti/object/class_accuracy"] == (0.5, 2)
    assert seen["kitti/object/range_max_error"] == (pytest.approx(0.1), 1)
    assert seen["kitti/object/azimuth_max_error"] == (pytest.approx(math.degrees(0.01), rel=1e-3), 1)


def test_range_that_is_not_known_does_not_flatter():
    value, n = figures([outcome(lidar(9)), outcome(camera(near=math.nan))])["kitti/object/range_max_error"]
    assert math.isnan(value) and n == 2


@pytest.mark.parametrize("kind, label, right", [("Van", "truck", True), ("Car", "truck", False), ("Cyclist", "bicycle", True),
                                                ("Person_sitting", "person", True), ("Tram", "train", True), ("Car", "", False)])
def test_class_names_of_both_worlds(kind, label, right):
    assert outcome(camera(label=label), kind).named("") is right


def test_class_of_low_boxes_and_of_kinds_without_name_is_not_asked():
    outcomes = [outcome(camera(), image_box=(0, 0, 99, 39)), outcome(camera(), kind="Misc")]
    assert figures(outcomes)["kitti/object/class_accuracy"][1] == 0


def test_far_bodies_and_areas_without_labels_do_not_count():
    candidates = dict.fromkeys(object_score.SYSTEMS, [])
    bodies = [body(), body(x=70.1), body("DontCare")]
    counted, = object_score.outcomes_of("000000", bodies, numpy.array([[9.0, 0, 0], [5, 0, 0]]), candidates)
    assert (counted.body, counted.raw_points) == (bodies[0], 1)


def test_report_says_where_no_sensor_can_tell():
    lines = "\n".join(object_score.report([outcome(None, raw=9), outcome(None, raw=10),
                                           outcome(None, raw=3, camera_only=camera())]))
    assert lines.count("physics forbids") == 1 and "9 points, 50 px high" in lines
