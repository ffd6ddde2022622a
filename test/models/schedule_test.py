"""How far a training is, its learning rate, and its averaged weights."""
import pytest
import torch

from yolov8.average import Average
from yolov8.schedule import LEAST_RATE, WARM_UP, Plan, rate_factor


def test_rate_rises_then_falls_to_its_least():
    assert rate_factor(0) < 0.01
    assert rate_factor(WARM_UP / 2) == pytest.approx(0.5, rel=0.01)
    assert rate_factor(WARM_UP) == pytest.approx(1, rel=0.01)
    assert rate_factor(0.5) == pytest.approx((1 + LEAST_RATE) / 2)
    assert rate_factor(1) == rate_factor(1.2) == pytest.approx(LEAST_RATE)
    falling = [rate_factor(0.03 + 0.01 * i) for i in range(98)]
    assert falling == sorted(falling, reverse=True)


def test_plan_of_epochs_counts_steps():
    plan = Plan(epochs=4)
    assert [plan.progress(steps, 10, 1e9) for steps in (0, 10, 39, 40, 41)] == [0, 0.25, 0.975, 1, 1]


def test_plan_of_minutes_counts_seconds():
    plan = Plan(minutes=2)
    assert [plan.progress(10 ** 9, 10, seconds) for seconds in (0, 30, 120, 121)] == [0, 0.25, 1, 1]


@pytest.mark.parametrize("end", [{}, {"epochs": 2, "minutes": 3}, {"epochs": 0}, {"minutes": 0}, {"epochs": -1}])
def test_plan_without_one_end_is_refused(end):
    with pytest.raises(ValueError):
        Plan(**end)


def test_average_is_over_a_fiftieth_of_the_steps():
    layer = torch.nn.BatchNorm1d(1)
    average = Average(layer)
    expected = layer.weight.item()
    for step, value in enumerate([3.0, 5.0, -2.0, 0.5] * 50, 1):
        with torch.no_grad():
            layer.weight.fill_(value)
            layer.num_batches_tracked.fill_(step)
        average.update(layer)
        expected += (value - expected) / (1 + step / 50)
    assert average.network.weight.item() == pytest.approx(expected, rel=1e-5)
    assert average.network.num_batches_tracked == 200
