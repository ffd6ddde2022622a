"""How the USV experiment scores: truth, degraded worlds, the stand-in for the detector, matches in the harbour."""
import math
from types import SimpleNamespace

import figures
import numpy
import pytest

import outline
import poses
import sim_world
import stand_in
import usv_harbour
import usv_positions
import usv_report
from sim_bag import Body


def body(label, centre, size, ground=None, turn=0.0):
    T = numpy.eye(4)
    T[:2, :2] = [[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]]
    T[:3, 3] = centre
    return Body("b", label, T, numpy.array(size), size[2] / 2 if ground is None else ground)


def test_the_face_of_a_round_body_is_that_of_its_cylinder():
    assert outline.face_range(body("cage", (5, 0, 0), (2, 2, 1))) == pytest.approx(4)
    assert outline.face_range(body("cage", (3, 4, -2.5), (2, 2, 1))) == pytest.approx(math.hypot(4, 2))  # its upper rim
    assert outline.face_range(body("cage", (0.2, 0, -2), (2, 2, 1))) == pytest.approx(1.5)  # from above


def test_the_face_of_a_box_is_its_nearest_point():
    assert outline.face_range(body("boat", (10, 0, 0), (4, 2, 1))) == pytest.approx(8)
    assert outline.face_range(body("boat", (10, 0, 0), (4, 2, 1), turn=math.pi / 2)) == pytest.approx(9)


def test_what_is_below_the_water_does_not_count():
    # 3 m high, 1 m of it over the water
    floating = body("cage", (5, 0, -1.8), (2, 2, 3), ground=-0.5)
    assert outline.span(floating) == (0.5, 1.5)
    assert outline.middle(floating) == pytest.approx([5, 0, -0.8])
    assert outline.face_range(floating) == pytest.approx(math.hypot(4, 0.3))


def test_poses_between_two_are_rigid():
    q = SimpleNamespace(x=0, y=0, z=math.sin(0.2), w=math.cos(0.2))
    a, b = numpy.eye(4), poses.matrix(SimpleNamespace(x=1, y=2, z=3), q)
    assert poses.between(a, b, 0.0) == pytest.approx(a) and poses.between(a, b, 1.0) == pytest.approx(b)
    half = poses.between(a, b, 0.5)
    assert half[:3, :3] @ half[:3, :3].T == pytest.approx(numpy.eye(3))
    assert math.atan2(half[1, 0], half[0, 0]) == pytest.approx(0.2)
    assert poses.apply(b, numpy.zeros(3)) == pytest.approx([1, 2, 3])


def test_mean_of_what_was_not_measured_is_no_number():
    assert figures.mean("a", [1.0, 3.0], "m").startswith("figure a 2 m n=2 ci=[1,3]")
    assert figures.mean("a", [1.0, math.nan], "m").startswith("figure a nan m n=2")
    assert figures.mean("a", [], "m").startswith("figure a nan m n=0")


@pytest.fixture
def package(monkeypatch):
    """The package's folder as rospack would find it."""
    from conftest import ROOT

    monkeypatch.setattr("stage_run.package", lambda: ROOT)


def placed(place, found, error, paper_found=100):
    errors = usv_positions.Errors(*[error] * 3, *[0.25 if paper_found else math.nan] * 2)
    return usv_positions.Row(place, 1, 100, found, paper_found, 2.0, 2.3, 0.0, errors, errors)


def test_a_missed_place_is_told_and_in_no_error():
    rows = [placed("0200", 100, 0.01), placed("0410", 0, math.nan, 0), placed("0510", 50, -0.03)]
    lines = list(usv_report.lines(usv_positions.TABLE, rows))
    assert lines[0] == "FOUND IN NO CLOUD, and so in no error below: 0410 seed 1"
    assert lines[1].startswith("figure usv/table1/found 0.5 - n=300 ") and lines[2].startswith("figure usv/table1/places_found 0.6667 - n=3 ")
    assert "figure usv/table1/face_mae 0.02 m n=2 ci=[0.01,0.03]" in lines
    assert "figure usv/table1/paper_distance_mae/paper_method 0.25 m n=2 ci=[0.25,0.25]" in lines
    table = {line.split()[0]: line for line in usv_report.table(rows)}
    assert "50 of 100" in table["0510"] and "0.030 m" in table["0510"] and "0 of 100         -" in table["0410"]
    assert "nan" not in "".join(table.values())
    far = list(usv_report.far_table(rows))
    assert "nan" not in "".join(far) and far[3].endswith("0 of 100")


def test_a_table_of_nothing_found_has_no_figure():
    rows = [placed("0200", 0, math.nan, 0)]
    assert "figure usv/far/face_mae nan m n=0 ci=[nan,nan]" in usv_report.lines(usv_positions.FURTHER, rows)
    assert not any("nan" in line for line in usv_report.table(rows))


def test_a_degraded_sensor_has_its_errors_multiplied_and_no_other(package):
    world = sim_world.shipped("usv_cages")
    worse = sim_world.degraded(world, {"lidar": 10.0})
    lidar, camera = worse["robot"]["mounts"]
    assert (lidar["range_noise"], lidar["range_bias"], lidar["angle_noise"]) == pytest.approx((0.1, 0.1, 0.1))
    assert lidar["mount_error"] == {"angle_deg": 2.0, "place": 0.05} and lidar["clock_error"] == 0.02
    assert camera == world["robot"]["mounts"][1]
    assert "range_noise" not in world["robot"]["mounts"][0]  # the world given is as before
    with pytest.raises(ValueError, match="no sensor sonar; there are camera, lidar"):
        sim_world.degraded(world, {"sonar": 2.0})


def test_every_place_of_the_table_has_its_world(package):
    for place, *_ in usv_positions.PAPER:
        x, y, _, _ = usv_positions.table_world(place, 1)["bodies"][0]["pose"]
        metres, right = int(place[-4:-2]), int(place[-2:]) * (-1 if place.startswith("a") else 1)
        assert math.hypot(x, y) == pytest.approx(metres + 0.25, abs=1e-3)
        assert math.degrees(math.atan2(-y, x)) == pytest.approx(right, abs=0.01)


def test_further_places_are_spread_over_ranges_and_angles(package):
    places = [usv_positions.far_world(place, 1)["bodies"][0]["pose"] for place in usv_positions.FURTHER.places]
    ranges = [math.hypot(x - 0.3, y) - 1.0 for x, y, *_ in places]
    angles = [math.degrees(math.atan2(y, x - 0.3)) for x, y, *_ in places]
    assert 2.0 < min(ranges) < 3.0 and 29.0 < max(ranges) < 30.0
    assert -45.0 <= min(angles) < -40.0 and 40.0 < max(angles) <= 45.0


PARAMETERS = {"class_heights": {"cage": 1.0}, "class_height_spreads": {}, "height_spread": 0.1, "box_pixel_error": 1.5}


def detection(**more):
    ray = SimpleNamespace(x=0.6, y=0.0, z=0.8)
    return SimpleNamespace(**{"id": 7, "label": "cage", "score": 1.0, "cut": 0, "x_min": 10.0, "x_max": 40.0, "y_min": 5.0,
                              "y_max": 30.0, "ray": ray, "RANGE_UNKNOWN": 0, "RANGE_FROM_HEIGHT": 1, **more})


def stood_in(*detections):
    info = SimpleNamespace(K=[250.0, 0, 0, 0, 250.0, 0, 0, 0, 1])
    return stand_in.seen(SimpleNamespace(detections=list(detections)), info, PARAMETERS).detections


def test_the_stand_in_ranges_by_height_as_the_paper_does():
    hidden, small, seen = detection(score=0.1), detection(x_max=12.0), detection(score=0.6)
    (only,) = stood_in(hidden, small, seen)
    assert only.id == 0 and only.score == stand_in.SCORE
    assert only.depth == pytest.approx(250.0 / 25.0) and only.range == pytest.approx(12.5)  # Eq. 3, and along the ray
    assert only.range_sigma == pytest.approx(12.5 * math.hypot(math.sqrt(2) * 1.5 / 25.0, 0.1))
    assert seen.id == 7  # the truth is as before


def test_the_stand_in_knows_no_range_of_what_is_cut_or_of_no_height():
    cut, unknown = stood_in(detection(cut=8), detection(label="walrus"))
    assert math.isnan(cut.range) and math.isnan(unknown.range)


def scene(labels, detected, lidar, camera):
    return SimpleNamespace(labels=labels, detected=detected, seen_by_lidar=lambda: lidar, seen_by_camera=lambda: camera)


def test_a_match_is_right_when_both_halves_stand_for_one_body():
    tally = usv_harbour.Tally()
    truth = scene({1: "cage", 2: "boat", 3: "buoy"}, {0: 1, 1: 2, 2: 3}, {1, 2}, {1, 2, 3})
    tally.pairs(truth, [(1, 1), (2, 1), (None, None), (-2, 3)])
    assert (tally.right, tally.matches) == (1, 4)
    assert (tally.matched, tally.matchable) == (1, 2)  # the LiDAR sees nothing of 3


def test_of_several_that_stand_for_one_body_one_is_right():
    tally = usv_harbour.Tally()
    truth = scene({1: "cage", 2: "boat"}, {}, {1}, {2})
    told = [(1, ""), (1, "cage"), (2, "car"), (-2, ""), (5, ""), (None, "boat")]  # -2: water; 5: a quay
    tally.bodies(truth, told)
    assert (tally.found, tally.asked) == (2, 2)
    assert (tally.correct, tally.told) == (2, 5)
    assert (tally.misnamed, tally.named) == (1, 2)


def test_rates_of_nothing_are_no_numbers():
    assert math.isnan(usv_harbour.rate([usv_harbour.Tally()], "match_precision"))
    assert list(usv_harbour.lines({})) == []
