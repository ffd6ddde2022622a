"""What was found of a simulated world against its truth."""
import math
from types import SimpleNamespace

import figures
import numpy
import pytest
import scene_report


def body(x, y, size=(1.0, 1.0), source=3, label="car", number=0):
    """Its face is that towards the origin along x."""
    return SimpleNamespace(id=number, source=source, label=label, azimuth=math.atan2(y, x),
                           face=SimpleNamespace(x=x - size[0] / 2, y=y), position=SimpleNamespace(x=x, y=y), size=SimpleNamespace(x=size[0], y=size[1]))


def test_range_is_that_of_the_face_over_ground():
    assert scene_report.near_range(body(10, 0, (4, 2))) == 8
    assert scene_report.near_range(body(10, 5, (2, 2))) == math.hypot(9, 5)
    assert math.isnan(scene_report.near_range(body(10, 0, (math.nan, math.nan))))


def test_an_obstacle_goes_to_the_nearest_body_and_to_one_only():
    near, far = body(10, 0, number=1), body(12, 0, number=2)
    seen = body(11.6, 0)
    assert scene_report.pairs([near, far], [seen]) == [(near, None), (far, seen)]


def test_of_pieces_of_one_body_the_fused_one_counts():
    alone, fused = body(9.5, 0, source=1), body(9.52, 0, source=3)
    assert scene_report.pairs([body(10, 0)], [alone, fused])[0][1] is fused


def test_what_is_too_far_off_is_not_found():
    assert scene_report.pairs([body(10, 0)], [body(12, 0)])[0][1] is None


def test_only_what_the_lidar_sees_counts():
    assert scene_report.pairs([body(10, 0, source=2)], [body(10, 0)]) == []
    assert scene_report.pairs([body(10, 0)], [body(10, 0, source=2)])[0][1] is None


def rows(*hits):
    """(x, y, body): what the LiDAR hit, with errors of range that the truth does not have."""
    out = numpy.zeros(len(hits), scene_report.ROW)
    for row, (x, y, number) in zip(out, hits):
        row["x"], row["y"], row["body"], row["range"] = 1.02 * x, 1.02 * y, number, math.hypot(x, y)
    return out


def test_a_body_is_what_the_lidar_truly_hit_of_it():
    hits = [(10, 0.1 * i, 3) for i in range(11)] + [(20, 0, 4)] * 9 + [(5, 0, -2)] * 20
    left, right = SimpleNamespace(x=-1, z=10), SimpleNamespace(x=0, z=10)  # optical frame: x is to the right
    seen = SimpleNamespace(label="buoy", score=1.0, ray_min=left, ray_max=right)
    cage, boat = scene_report.seen_bodies(rows(*hits), {3: "buoy", 4: "boat", 5: ""}, [seen])
    assert (cage.id, cage.label, cage.source, boat.source) == (3, "buoy", 3, 0)
    assert (cage.position.x, cage.position.y, cage.size.x, cage.size.y) == pytest.approx((10, 0.5, 0, 1), abs=1e-5)


def test_only_the_sector_of_the_stages_counts():
    behind, far = [(-10, 0, 1)] * 20, [(90, 0, 2)] * 20
    assert scene_report.seen_bodies(rows(*behind, *far), {1: "boat", 2: "boat"}, []) == []


def test_report_counts_and_averages():
    truth = body(10, 0, (4, 2))
    found = body(8.3, 0, (0.2, 2))
    lines = scene_report.report([([truth], [found]), ([truth], [])])
    assert lines[1].split() == ["car", "0", "1/2", "1/2", "1", "+0.20", "m", "+0.00", "deg"]
    assert lines[2].startswith("figure scene/found 0.5 - n=2 ci=[")
    assert lines[3] == "figure scene/range_mae 0.2 m n=1 ci=[nan,nan]"


def test_report_of_nothing_is_not_a_number():
    assert scene_report.report([])[1] == "figure scene/found nan - n=0 ci=[nan,nan]"


def test_wilson_interval_is_the_published_one():
    assert figures.wilson(10, 10) == pytest.approx((0.7225, 1.0), abs=1e-3)
    assert figures.wilson(0, 10) == pytest.approx((0.0, 0.2775), abs=1e-3)


def test_bootstrap_of_equal_values_has_no_width():
    assert figures.bootstrap([2.0] * 5, max) == (2.0, 2.0)
    low, high = figures.bootstrap(list(range(100)), lambda v: sum(v) / len(v))
    assert low == pytest.approx(49.5 - 1.96 * 2.887, abs=0.7) and high == pytest.approx(49.5 + 1.96 * 2.887, abs=0.7)
