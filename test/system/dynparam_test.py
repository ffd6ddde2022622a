"""The stock client of dynamic_reconfigure with a running stage."""
import subprocess

import pytest

from ros_session import RosSession


def dynparam(*arguments):
    return subprocess.run(["rosrun", "dynamic_reconfigure", "dynparam", *arguments], text=True, timeout=60,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout


@pytest.fixture(scope="module")
def stage():
    with RosSession() as session:
        session.launch("field_fusion", "filter.launch")
        assert session.wait(lambda: "/filter/set_parameters" in [name for name, _ in session.system_state()[2]])
        yield session


def test_stage_is_listed(stage):
    assert "/filter" in dynparam("list")


def test_value_is_read_and_set(stage):
    assert "'max_range': 1000.0" in dynparam("get", "/filter")
    dynparam("set", "/filter", "max_range", "12.5")
    assert "'max_range': 12.5" in dynparam("get", "/filter")


def test_rule_over_two_values_refuses_the_change(stage):
    # min_range must not exceed max_range: no single range forbids this
    dynparam("set", "/filter", "max_range", "20.0")
    dynparam("set", "/filter", "min_range", "30.0")
    assert "'min_range': 0.0" in dynparam("get", "/filter")


def test_start_parameters_are_not_offered(stage):
    assert "box_frame" not in dynparam("get", "/filter")
