"""Points of a depth image in the map, and whose contour they are, by analysis."""
import math
from types import SimpleNamespace

import genpy
import numpy
import pytest
from geometry_msgs.msg import PoseStamped, TransformStamped
from sensor_msgs.msg import CameraInfo, Image
from tf2_msgs.msg import TFMessage

import contour_error
import depth_cloud
import poses
import quad_score
import quad_stack
import sim_bag


def test_a_pixel_is_a_point_as_far_ahead_as_its_depth():
    pixels = numpy.zeros((4, 6), numpy.uint16)
    pixels[2, 4], pixels[2, 0], pixels[1, 1] = 2000, 500, 700
    image = Image(height=4, width=6, step=12, data=pixels.tobytes())
    info = CameraInfo(K=[100.0, 0.0, 2.0, 0.0, 50.0, 1.0, 0.0, 0.0, 1.0])
    assert depth_cloud.points(image, info, 2) == pytest.approx(numpy.array([[-0.01, 0.01, 0.5], [0.04, 0.04, 2.0]]))
    assert len(depth_cloud.points(Image(height=4, width=6, step=12, data=bytes(48)), info, 1)) == 0


def link(parent, child, x):
    out = TransformStamped()
    out.header.frame_id, out.child_frame_id = parent, child
    out.transform.translation.x, out.transform.rotation.w = x, 1.0
    return out


def test_frames_hang_on_the_base_by_a_chain():
    static = TFMessage(transforms=[link("a", "b", 1.0), link("base", "a", 0.5)])
    assert sim_bag.chained(static.transforms, "base", "b")[:3, 3] == pytest.approx([1.5, 0.0, 0.0])
    assert sim_bag.chained(static.transforms, "base", "base") == pytest.approx(numpy.eye(4))


def test_between_poses_of_the_path_the_odometry_goes_on():
    """Odometry drives along its x at 1 m/s; the map is turned by 90 degrees against it, and shifted."""
    path = SimpleNamespace(poses=[PoseStamped(), PoseStamped()])
    for pose, (time, y) in zip(path.poses, ((10.0, 0.0), (11.0, 1.1))):
        pose.header.stamp = genpy.Time.from_sec(time)
        pose.pose.position.x, pose.pose.position.y = 5.0, y
        pose.pose.orientation.z = pose.pose.orientation.w = math.sqrt(0.5)
    at = depth_cloud.transforms(path, SimpleNamespace(at=lambda time: poses.planar(time - 10.0, 0.0, 0.0)))
    assert at(10.5)[:3, 3] == pytest.approx([5.0, 0.5, 0.0])
    assert at(11.5)[:3, 3] == pytest.approx([5.0, 1.6, 0.0])
    assert poses.yaw(at(11.5)) == pytest.approx(math.pi / 2)


def test_each_body_is_scored_by_its_own_points_in_the_maps_frame():
    """Two boxes of 0.2 m; the map sees the near side of the first alone, and has its origin at (1, 2), turned."""
    body = lambda name, x: quad_score.Body(name, "box", poses.planar(x, 0.0, 0.0), numpy.array([0.2, 0.2, 1.0]))
    bodies = [body("near", 0.0), body("far", 2.0)]
    side = lambda x: numpy.c_[numpy.full(21, x), numpy.linspace(-0.1, 0.1, 21)]
    outline = SimpleNamespace(outline=numpy.concatenate([side(-0.1), side(0.1), side(1.9), side(2.1)]),
                              seen=numpy.concatenate([side(-0.1), side(1.9)]))
    T_world_own = poses.planar(1.0, 2.0, 0.3)
    points = poses.apply(numpy.linalg.inv(T_world_own), numpy.c_[side(-0.13), numpy.zeros(21)])[:, :2]
    rows = quad_stack.scores(7, "pmf", quad_stack.Drawn(points, T_world_own, 0.05), outline, bodies)
    assert [(row.seed, row.form, row.body) for row in rows] == [(7, "pmf", "near"), (7, "pmf", "far")]
    assert rows[0].score.error == pytest.approx(0.03, abs=1e-3) and rows[0].score.completeness == 1.0
    assert rows[1].score.points == 0 and math.isnan(rows[1].score.error) and rows[1].score.completeness == 0.0


def test_a_body_that_is_not_there_counts_for_completeness_alone():
    rows = [quad_stack.Row(1, "pmf", "a", contour_error.Score(5, 0.02, 0.5)), quad_stack.Row(1, "pmf", "b", contour_error.Score(0, math.nan, 0.0))]
    error, share = list(quad_stack.lines("stack", rows, {"pmf": "PMF"}))
    assert error.startswith("figure pmf/contour/stack/pmf_error 0.02 m n=1 ")
    assert share.startswith("figure pmf/contour/stack/pmf_completeness 0.25 - n=2 ")
    told = "\n".join(quad_stack.table("heaps", rows, {"pmf": "PMF"}))
    assert "20 mm, 0.50" in told and "not there" in told
