"""Which bodies a map of the quadruped shows, by analysis."""
import numpy
import pytest

import quad_score

RESOLUTION = 0.05


def body(name, x, y, yaw=0.0, size=(0.4, 0.2, 0.5), label="box"):
    T = numpy.eye(4)
    c, s = numpy.cos(yaw), numpy.sin(yaw)
    T[:2, :2], T[:2, 3] = [[c, -s], [s, c]], (x, y)
    return quad_score.Body(name, label, T, numpy.array(size))


def test_distance_is_that_from_the_box_as_seen_from_above():
    turned = body("a", 1.0, 2.0, numpy.pi / 2)  # 0.2 along x, 0.4 along y
    points = numpy.array([[1.0, 2.0], [1.3, 2.0], [1.0, 2.5], [1.4, 2.6]])
    assert turned.distance(points) == pytest.approx([0.0, 0.2, 0.3, 0.5])


def test_a_cell_shows_the_body_next_to_it_alone():
    bodies = [body("a", 0.0, 0.0), body("b", 1.0, 0.0), body("wall", 0.5, 2.0, label="")]
    assert quad_score.found(numpy.array([[0.22, 0.0]]), bodies, RESOLUTION) == ["a"]
    assert quad_score.found(numpy.array([[0.26, 0.0]]), bodies, RESOLUTION) == []
    assert quad_score.found(numpy.array([[0.5, 2.0]]), bodies, RESOLUTION) == [], "a wall is no obstacle of the paper"
    assert quad_score.found(numpy.zeros((0, 2)), bodies, RESOLUTION) == []


def test_a_cell_of_a_wall_behind_does_not_show_what_stands_before():
    bodies = [body("a", 0.0, 0.0), body("wall", 0.0, 0.16, size=(2.0, 0.1, 1.0), label="")]  # 1 cm apart
    assert quad_score.found(numpy.array([[0.0, 0.14]]), bodies, RESOLUTION) == []
    assert quad_score.found(numpy.array([[0.0, 0.05]]), bodies, RESOLUTION) == ["a"]


def test_cells_lie_in_the_world_by_their_middles():
    from nav_msgs.msg import OccupancyGrid

    grid = OccupancyGrid()
    grid.info.resolution, grid.info.width, grid.info.height = 0.5, 2, 2
    grid.info.origin.position.x = 10.0
    grid.data = [-1, 0, 49, 50]
    T = numpy.eye(4)
    T[0, 3] = 100.0
    assert quad_score.occupied(grid, T) == pytest.approx(numpy.array([[110.75, 0.75]]))
