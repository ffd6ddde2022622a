"""The reference for ground, on ground that is known."""
import numpy
import pytest
from ground_reference import is_ground

HEIGHT = 1.7  # m of the LiDAR


def surface(height, spacing=0.4):
    """Points of a road 40 m long and 12 m wide; `height(x, y)` [m] over the wheels."""
    x, y = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(3, 43, spacing), numpy.arange(-6, 6, spacing)))
    return numpy.stack([x, y, height(x, y) - HEIGHT], axis=1)


def block(x, z, size=1.0):
    """A wall of points, `size` high from `z` over the wheels."""
    y, up = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(-1, 1, 0.1), numpy.arange(0.0, size, 0.05)))
    return numpy.stack([numpy.full(len(y), x), y, z + up - HEIGHT], axis=1)


@pytest.mark.parametrize("height", [
    lambda x, y: 0.0 * x,  # flat
    lambda x, y: 0.08 * numpy.maximum(x - 10.0, 0.0),  # a ramp of 8 % that begins at 10 m
    lambda x, y: -0.05 * x,  # downhill
    lambda x, y: 0.12 * (y > 3.0),  # a kerb
    lambda x, y: 0.15 - 0.02 * numpy.abs(y)])  # a crowned road
def test_ground_is_followed(height):
    assert is_ground(surface(height), HEIGHT).mean() > 0.99


def test_wall_on_a_ramp_is_not_climbed():
    ramp = surface(lambda x, y: 0.08 * numpy.maximum(x - 10.0, 0.0))
    wall = block(25.05, 0.08 * 15.05)
    ground = is_ground(numpy.concatenate([ramp, wall]), HEIGHT)
    assert ground[:len(ramp)].mean() > 0.99
    above = wall[:, 2] + HEIGHT - 0.08 * 15.05 > 0.2
    assert not ground[len(ramp):][above].any()


def test_platform_half_a_metre_high_is_no_ground():
    points = surface(lambda x, y: 0.5 * (x > 20.0))
    assert (is_ground(points, HEIGHT) == (points[:, 0] <= 20.0)).all()


def test_mirror_images_below_the_road_are_no_ground_and_do_not_pull_it_down():
    road = surface(lambda x, y: 0.0 * x)
    mirrored = block(15.05, -1.5)
    ground = is_ground(numpy.concatenate([road, mirrored]), HEIGHT)
    assert ground[:len(road)].all() and not ground[len(road):][mirrored[:, 2] + HEIGHT < -0.2].any()


def test_rings_up_to_four_cells_apart_are_joined():
    road = surface(lambda x, y: 0.0 * x)
    near, far = road[road[:, 0] < 12.0], road[road[:, 0] > 15.5]
    assert is_ground(numpy.concatenate([near, far]), HEIGHT).all()


def test_nothing_at_the_height_of_the_wheels_is_no_ground():
    assert not is_ground(block(8.0, 1.0), HEIGHT).any()
    assert is_ground(numpy.empty((0, 3)), HEIGHT).shape == (0,)
