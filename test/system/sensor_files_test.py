"""Every noise, bias and spot size of config/sensors says where it comes from: typical and maximum of a source, or that no
data sheet tells it."""
import re

import pytest
import yaml

from conftest import ROOT

FILES = sorted((ROOT / "config/sensors").glob("*.yaml"))
ERRORS = re.compile(r"noise(_\w+)?|\w+_(noise|bias|walk|error|drift|loss)|range_(scale|noise\w*)|spot_(width|height)"
                    r"|divergence_\w+|fault_rate|depth_scale|full_well|vignetting|glare|wander(_time)?|slip\w*|vibration")
SAYS = re.compile(r"no data sheet|typical.*maximum|maximum.*typical")


def entries(file):
    """(key, comment) of each line that sets a number."""
    for line in file.read_text().splitlines():
        found = re.match(r"(\w+): +(-?[\d.]+)\s*(?:#\s*(.*))?$", line)
        if found:
            yield found[1], found[3] or ""


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_every_error_says_its_source(file):
    errors = [(key, comment) for key, comment in entries(file) if ERRORS.fullmatch(key)]
    assert errors
    assert [(key, comment) for key, comment in errors if not SAYS.search(comment)] == []


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_source_that_is_cited_is_named_at_the_top(file):
    text = file.read_text()
    head, body = text[:text.index("kind:")], text[text.index("kind:"):]
    assert head.startswith("# ")
    assert set(re.findall(r"(?<!: )\[(\d)\]", body)) <= set(re.findall(r"\[(\d)\]", head))


def test_spot_of_the_lms141_grows_as_its_instructions_say():
    lms141 = yaml.safe_load((ROOT / "config/sensors/lms141.yaml").read_text())
    assert (lms141["spot_width"], lms141["divergence_width"]) == (8.0, 15.0)  # mm, mm/m: 0.015 x distance + 8 mm


def test_fixes_of_a_receiver_are_as_good_as_its_data_sheet_says():
    gnss = yaml.safe_load((ROOT / "config/sensors/gnss.yaml").read_text())
    sigma = (gnss["noise"] ** 2 + gnss["wander"] ** 2) ** 0.5
    assert sigma * (2 * 0.693147) ** 0.5 == pytest.approx(2.5, abs=0.05)  # median of a Rayleigh distribution
