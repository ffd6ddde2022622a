"""The losses against their formulas, term by term."""
import math

import pytest
import torch

from yolov8.assign import assign
from yolov8.boxes import boxes_of, cell_centres, ciou, distances_of, flattened
from yolov8.loss import Bodies, detection_loss, distribution_loss


def random_maps(seed=0, images=2, classes=3):
    random = torch.Generator().manual_seed(seed)
    return [torch.randn(images, 64 + classes, side, side, generator=random).requires_grad_() for side in (8, 4, 2)]


def bodies():
    return Bodies(torch.tensor([[4.0, 6, 30, 41], [20, 20, 60, 50], [0, 0, 64, 64]]), torch.tensor([0, 2, 1]),
                  torch.tensor([0, 0, 1]))


def nothing():
    return Bodies(torch.zeros(0, 4), torch.zeros(0, dtype=torch.long), torch.zeros(0, dtype=torch.long))


@pytest.mark.parametrize("distance, bins", [(0.0, {0: 1.0}), (2.25, {2: 0.75, 3: 0.25}), (14.99, {14: 0.01, 15: 0.99})])
def test_distribution_loss_is_the_cross_entropy_with_two_bins(distance, bins):
    logits = torch.randn(4, 16, generator=torch.Generator().manual_seed(1), dtype=torch.float64)
    expected = 0.0
    for side in range(4):
        total = sum(math.exp(v) for v in logits[side].tolist())
        expected -= sum(share * math.log(math.exp(logits[side, i].item()) / total) for i, share in bins.items()) / 4
    found = distribution_loss(logits[None], torch.full((1, 4), distance, dtype=torch.float64))
    assert found.item() == pytest.approx(expected)


def slow_loss(maps, bodies):
    centres, strides = cell_centres(maps)
    distances, scores = flattened(maps)
    predicted = boxes_of(distances, centres, strides)
    found = assign(bodies.boxes, bodies.classes, bodies.images, predicted, scores.sigmoid(), centres)
    wanted = {(i, c, bodies.classes[b].item()): s for i, c, b, s in zip(
        found.image.tolist(), found.cell.tolist(), found.body.tolist(), found.score.tolist())}
    total = max(1.0, sum(wanted.values()))
    score = 0.0
    for i, cell, k in ((i, c, k) for i in range(scores.shape[0]) for c in range(scores.shape[1]) for k in range(scores.shape[2])):
        target, p = wanted.get((i, cell, k), 0.0), 1 / (1 + math.exp(-scores[i, cell, k].item()))
        score -= target * math.log(p) + (1 - target) * math.log(1 - p)
    box = distribution = 0.0
    for i, cell, body, weight in zip(found.image, found.cell, found.body, found.score):
        box += weight.item() * (1 - ciou(predicted[i, cell], bodies.boxes[body]).item())
        sides = distances_of(bodies.boxes[body], centres[cell], strides[cell])
        distribution += weight.item() * distribution_loss(distances[i, cell], sides).item()
    return 0.5 * score / total, 7.5 * box / total, 1.5 * distribution / total


def test_loss_is_the_sum_of_its_parts():
    maps = random_maps()
    loss, parts = detection_loss(maps, bodies())
    assert parts.tolist() == pytest.approx(slow_loss(maps, bodies()), rel=1e-4)
    assert loss.item() == pytest.approx(sum(parts.tolist()), rel=1e-6)


@pytest.mark.parametrize("labelled", [bodies, nothing])
def test_gradients_are_finite(labelled):
    maps = random_maps()
    loss, _ = detection_loss(maps, labelled())
    loss.backward()
    assert all(torch.isfinite(m.grad).all() for m in maps)


def test_images_of_nothing_only_lower_the_scores():
    maps = random_maps()
    loss, parts = detection_loss(maps, nothing())
    loss.backward()
    assert parts[0] > 0 and parts[1:].tolist() == [0, 0]
    assert all((m.grad[:, 64:] > 0).all() and (m.grad[:, :64] == 0).all() for m in maps)
