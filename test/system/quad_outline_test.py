"""How much of an outline a map of the quadruped shows, by analysis."""
import csv

import numpy
import pytest

from conftest import rosrun

import quad_hard
import quad_outline
import quad_score

CELL = 0.5  # m


def grid(occupied, width=4, height=3):
    from nav_msgs.msg import OccupancyGrid

    out = OccupancyGrid()
    out.info.resolution, out.info.width, out.info.height = CELL, width, height
    cells = numpy.zeros((height, width), dtype=int)
    for column, row in occupied:
        cells[row, column] = 100
    out.data = cells.ravel().tolist()
    return out


def outline(*places):
    rows = [(x, y, outline, camera, scanner) for x, y, outline, camera, scanner in places]
    return quad_outline.of_rows(numpy.array(rows, dtype=float).reshape(-1, 5))


def test_of_an_outline_only_what_some_sensor_sees_counts():
    read = outline((0, 0, 1, 1, 0), (1, 0, 1, 0, 1), (2, 0, 1, 0, 0), (3, 0, 0, 0, 0))
    assert read.seen.tolist() == [[0, 0], [1, 0]] and len(read.surface) == 4


def test_of_one_body_what_lies_at_its_box_counts():
    T = numpy.eye(4)
    T[:3, 3] = 1.0, 0.0, 0.2
    box = quad_score.Body("box", "box", T, numpy.array([0.4, 0.2, 0.4]))
    places = outline((0.79, 0.0, 1, 1, 0), (0.7, 0.0, 1, 1, 0), (1.2, 0.1, 1, 0, 1), (1.0, 0.0, 1, 0, 0))
    assert quad_outline.of_bodies(places, [box]).seen.tolist() == [[0.79, 0.0], [1.2, 0.1]]
    assert len(quad_outline.of_bodies(places, []).seen) == 0


def test_a_place_is_shown_by_its_cell_and_by_the_eight_around():
    places = outline(*((x, 0.75, 1, 1, 0) for x in (0.25, 0.75, 1.25, 1.75)))
    assert quad_outline.shown(grid([(1, 1)]), numpy.eye(4), places).tolist() == [True, True, True, False]
    assert quad_outline.shown(grid([(0, 2)]), numpy.eye(4), places).tolist() == [True, True, False, False]
    assert not quad_outline.shown(grid([]), numpy.eye(4), places).any()


def test_beside_the_map_a_place_is_shown_by_the_cell_at_its_edge_alone():
    places = outline((-0.1, 0.75, 1, 1, 0), (-0.6, 0.75, 1, 1, 0), (2.1, 0.75, 1, 1, 0), (90.0, 0.75, 1, 1, 0))
    assert quad_outline.shown(grid([(0, 1)]), numpy.eye(4), places).tolist() == [True, False, False, False]
    assert quad_outline.shown(grid([(3, 1)]), numpy.eye(4), places).tolist() == [False, False, True, False]


def test_the_map_may_lie_turned_in_the_world():
    T = numpy.array([[0.0, -1, 0, 10], [1, 0, 0, 20], [0, 0, 1, 0], [0, 0, 0, 1]])  # x of the map is north
    places = outline((9.25, 20.75, 1, 1, 0))  # (0.75, 0.75) in the map
    assert quad_outline.shown(grid([(1, 1)]), T, places).all()
    assert quad_outline.missed(grid([]), T, places) == pytest.approx(numpy.array([[0.75, 0.75]]))


def test_phantoms_are_far_from_every_surface():
    surfaces = outline((0, 0, 1, 0, 0), (1, 0, 0, 0, 0))
    assert quad_outline.phantoms(numpy.array([[0.1, 0.0], [0.5, 0.0], [1.16, 0.0], [1.0, 0.14]]), surfaces, 0.15) == 2
    assert quad_outline.phantoms(numpy.zeros((0, 2)), surfaces, 0.15) == 0


def test_four_legs_are_one_obstacle_and_each_must_be_there():
    def body(name, x, z=0.3, size=(0.02, 0.02, 0.6)):
        T = numpy.eye(4)
        T[:3, 3] = x, 0, z
        return quad_score.Body(name, "" if name == "seat" else name.rstrip("_1234"), T, numpy.array(size))

    bodies = [body("rod", 0.0), *(body(f"thin_legs_{i}", float(i)) for i in (1, 2, 3, 4)), body("seat", 2.5, 0.77, (4, 1, 0.04))]
    legs = [[float(i), 0.02] for i in (1, 2, 3, 4)]
    assert quad_hard.found(numpy.array(legs), bodies, 0.05) == ["thin_legs"]
    assert quad_hard.found(numpy.array([[0.0, 0.0], *legs[:3]]), bodies, 0.05) == ["rod"]


def test_the_simulator_tells_what_could_be_seen(tmp_path):
    """The barrel of quad_obstacles at (3.6, 1.5), 0.58 m wide: of it, what faces some place of the camera on its way."""
    done = rosrun("seen_outline", "quad_obstacles", tmp_path / "out.csv", "--seconds", "26")
    assert done.returncode == 0, done.stderr
    with open(tmp_path / "out.csv") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    near = lambda row: numpy.hypot(row["x"] - 3.6, row["y"] - 1.5)
    barrel = [row for row in rows if near(row) < 0.35 and row["outline"]]
    assert max(near(row) for row in barrel) <= 0.29 + 0.01, "a circle of 0.58 m"
    camera, scanner = ([row for row in barrel if row[sensor]] for sensor in ("camera", "scanner"))
    assert camera and scanner
    eyes = numpy.array([[x, y] for x in numpy.arange(-4.4, 4.7, 0.05) for y in (-0.05, 0.05)])  # it sways

    def faces(row):
        normal = numpy.array([row["x"] - 3.6, row["y"] - 1.5]) / near(row)
        return numpy.max((eyes - (3.6, 1.5)) @ normal) - 0.29 > -0.2  # hoops and cells of 1 cm: some degrees round

    assert all(map(faces, camera))
    assert not all(map(faces, barrel)), "it has a back"
    walls = [row for row in rows if row["x"] < -5.4]
    assert walls and not any(row["camera"] for row in walls), "behind the robot"
    assert any(row["scanner"] for row in walls)


def test_a_world_that_is_not_there_is_named(tmp_path):
    done = rosrun("seen_outline", "nowhere", tmp_path / "out.csv")
    assert done.returncode == 1 and "no world nowhere" in done.stderr
    done = rosrun("seen_outline", "quad_obstacles", "/nowhere/out.csv", "--seconds", "0.1")
    assert done.returncode == 1 and "/nowhere/out.csv" in done.stderr
