"""How the office's trajectories are scored."""
import math

import numpy
import pytest

import slam_office

WAY = numpy.array([[0.0, 0.0, 0.0], [4.0, 0.0, math.pi / 2], [4.0, 3.0, math.pi], [1.0, 3.0, -math.pi / 2]])


def turned(way, yaw, x, y):
    c, s = math.cos(yaw), math.sin(yaw)
    return numpy.array([[x + c * px - s * py, y + s * px + c * py, pyaw + yaw] for px, py, pyaw in way])


@pytest.mark.parametrize("lay", [slam_office.laid_first, slam_office.laid_best])
def test_a_rigid_motion_is_no_error(lay):
    laid = lay(turned(WAY, 2.1, -7.0, 5.0), WAY)
    assert laid[:, :2] == pytest.approx(WAY[:, :2], abs=1e-12)
    assert slam_office.rmse(laid, WAY) == pytest.approx(0.0, abs=1e-12)


def test_a_wrong_first_heading_counts_with_the_first_pose_laid_alone():
    found = WAY.copy()
    found[0, 2] = 0.01  # the rest is right
    # the places turn by -0.01 about the first: each is off by twice the sine of half that times its distance from it
    expected = 2 * math.sin(0.005) * math.sqrt(numpy.mean(numpy.sum(WAY[:, :2] ** 2, axis=1)))
    assert slam_office.rmse(slam_office.laid_first(found, WAY), WAY) == pytest.approx(expected)
    assert slam_office.rmse(slam_office.laid_best(found, WAY), WAY) == pytest.approx(0.0, abs=1e-12)


def test_best_lay_leaves_what_no_motion_explains():
    # a square with two opposite corners drawn out by d: neither turn nor shift helps, each of two is off by d
    square = numpy.array([[1.0, 1.0, 0], [-1.0, 1.0, 0], [-1.0, -1.0, 0], [1.0, -1.0, 0]])
    drawn = square.copy()
    d = 0.1 / math.sqrt(2)
    drawn[0, :2] += d
    drawn[2, :2] -= d
    assert slam_office.rmse(slam_office.laid_best(drawn, square), square) == pytest.approx(math.sqrt(2 * 0.1 ** 2 / 4))


def test_what_sits_on_the_robot_moves_with_it():
    at = slam_office.moved(numpy.array([[1.0, 2.0, math.pi / 2]]), numpy.array([0.2, 0.0, 0.1]))
    assert at == pytest.approx(numpy.array([[1.0, 2.2, math.pi / 2 + 0.1]]))
