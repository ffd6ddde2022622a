"""How small dark buoys are scored by range."""
import math
from types import SimpleNamespace

import numpy
import pytest

import usv_small
from conftest import ROOT
from usv_small import Found, Sample

NAN = math.nan


def sample(face, name="a", **found):
    return Sample((1, name), face, found.pop("returns", 2), **found)


def test_shares_and_errors_are_of_what_was_found():
    some = [sample(7, camera=Found(1.0, 0.4)), sample(7, camera=Found(-0.5, 0.4)), sample(7, camera=Found(NAN, NAN)), sample(7)]
    assert usv_small.found_share(some, "camera") == 0.75
    assert usv_small.mean_error(some, "camera") == pytest.approx(0.75)
    assert usv_small.within(some, "camera") == 0.5  # 0.5 lies inside 0.8, 1.0 does not; the third says nothing
    assert usv_small.found_share(some, "lidar") == 0 and math.isnan(usv_small.mean_error(some, "lidar"))
    assert math.isnan(usv_small.within(some, "lidar"))


def test_a_bin_holds_its_lower_edge_and_empty_ones_are_left_out():
    binned = dict(usv_small.binned([sample(5.0), sample(9.99), sample(10.0), sample(4.9), sample(40.0)]))
    assert {name: len(some) for name, some in binned.items()} == {"5_10m": 2, "10_15m": 1}


def test_of_several_for_one_buoy_the_nearest_counts():
    assert usv_small.nearest([Found(NAN, 1), Found(-2, 1), Found(1, 1)]) == Found(1, 1)
    assert usv_small.nearest([]) is None and math.isnan(usv_small.nearest([Found(NAN, 1)]).error)


def test_the_sigma_is_that_along_the_ray():
    place = SimpleNamespace(x=3.0, y=4.0, z=0.0)
    ray, across = numpy.array([0.6, 0.8, 0]), numpy.array([-0.8, 0.6, 0])
    covariance = 4.0 * numpy.outer(ray, ray) + 0.01 * numpy.outer(across, across)
    assert usv_small.radial_sigma(SimpleNamespace(position=place, position_covariance=list(covariance.flat))) == pytest.approx(2.0)
    assert math.isnan(usv_small.radial_sigma(SimpleNamespace(position=place, position_covariance=[NAN] * 9)))


def test_intervals_draw_whole_buoys():
    alike = [sample(7, name, lidar=Found(0.1, NAN)) for name in "ab" for _ in range(50)]
    alike += [sample(7, "c") for _ in range(50)]
    line = usv_small.figure("share", alike, lambda some: usv_small.found_share(some, "lidar"), "-")
    assert line.startswith("figure share 0.6667 - n=150 ci=[0")  # of three buoys one can draw any share
    assert line.endswith(",1]")
    assert usv_small.figure("none", alike, lambda some: usv_small.mean_error(some, "camera"), "m") == "figure none nan m n=150 ci=[nan,nan]"


def test_buoys_lie_in_their_bins_apart_and_black(monkeypatch):
    monkeypatch.setattr("stage_run.package", lambda: ROOT)
    world = usv_small.world(3)
    x0 = 0.3  # of the LiDAR
    polar = [(math.hypot(x - x0, y), math.atan2(y, x - x0)) for x, y, _ in (body["pose"] for body in world["bodies"])]
    for i, (away, _) in enumerate(polar):
        low, high = usv_small.BINS[i // usv_small.EACH]
        assert low <= away - 0.25 <= high
    bearings = sorted(math.degrees(bearing) for _, bearing in polar)
    assert min(numpy.diff(bearings)) == pytest.approx(7.0) and bearings[0] == pytest.approx(-38.5)
    assert all(body["material"]["reflectivity"] < 0.05 for body in world["bodies"])
    assert [body["pose"] for body in usv_small.world(3)["bodies"]] == [body["pose"] for body in world["bodies"]]
