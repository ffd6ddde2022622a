"""How the dimensions of the laboratory are told: errors by analysis, the world's own file."""
import math
import re

import pytest
import yaml

import quad_dimensions
from conftest import ROOT
from quad_dimensions import Row

DIMENSIONS = yaml.safe_load((ROOT / "config/worlds/quad_lab.yaml").read_text())["dimensions"]


def test_there_are_ten_and_each_is_as_long_as_its_ends_are_apart():
    assert len(DIMENSIONS) == 10
    assert quad_dimensions.true_length(DIMENSIONS[0]) == pytest.approx(12.0)
    assert {*quad_dimensions.ALONG, *quad_dimensions.ROUND} < {dimension["name"] for dimension in DIMENSIONS}


def test_the_root_of_the_mean_square():
    rows = [Row(1, "raw", False, "a", 1.0, 1.03), Row(1, "raw", False, "b", 2.0, 1.96)]
    assert quad_dimensions.rmse(rows) == pytest.approx(math.sqrt((0.03 ** 2 + 0.04 ** 2) / 2))
    lost = Row(1, "raw", False, "c", 1.0, math.nan)
    assert quad_dimensions.rmse([*rows, lost]) == pytest.approx(quad_dimensions.rmse(rows)) and quad_dimensions.found([*rows, lost]) == rows
    assert math.isnan(quad_dimensions.rmse([]))


def rows():
    """Raw is off by 0.1 m, and with a scale by 0.2 m; MDR by 0.02 m."""
    off = {("raw", False): 0.1, ("raw", True): 0.2, ("mdr", False): 0.02, ("mdr", True): 0.02}
    return [Row(seed, kind, scaled, name, 1.0, 1.0 + error) for seed in (1, 2) for (kind, scaled), error in off.items() for name in "ab"]


def test_figures_are_in_millimetres_over_all_seeds():
    matches = (re.match(r"figure (\S+) (\S+ mm n=\d+) ", line) for line in quad_dimensions.lines(rows()))
    told = dict(match.groups() for match in matches if match)
    assert told == {"pmf/dimensions/raw_rmse": "100 mm n=4", "pmf/dimensions/mdr_rmse": "20 mm n=4",
                    "pmf/dimensions/raw_rmse_with_scale": "200 mm n=4", "pmf/dimensions/mdr_rmse_with_scale": "20 mm n=4"}


def test_what_was_not_found_is_told_beside():
    lost = [row._replace(measured=math.nan) if (row.kind, row.scaled, row.seed, row.name) == ("raw", False, 1, "a") else row for row in rows()]
    told = "\n".join(quad_dimensions.lines(lost))
    assert re.search(r"^figure pmf/dimensions/raw_found 0\.75 - n=4 ", told, re.M) and "raw_rmse 100 mm n=3 " in told
    assert re.search(r"^figure pmf/dimensions/mdr_found 1 - n=4 ", told, re.M)


def test_the_papers_stands_beside_ours():
    told = "\n".join(quad_dimensions.table(rows()))
    assert "MDR errs by 80.0 % less (paper: 45.9 %)" in told
    assert re.search(r"^paper, RMSE +109 +59$", told, re.M)
    assert re.search(r"^a +1\.000 m +\+100 +100 +\+20 +20$", told, re.M)
