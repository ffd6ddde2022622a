"""Overlaps of boxes and what the raw maps say about them, against arithmetic box by box."""
import math

import numpy as np
import pytest
import torch

from yolov8.boxes import boxes_of, cell_centres, ciou, distances_of, iou

PAIRS = [  # box, box, IoU by hand
    ((0, 0, 10, 10), (0, 0, 10, 10), 1.0),
    ((0, 0, 10, 10), (5, 0, 15, 10), 50 / 150),
    ((0, 0, 10, 10), (2, 2, 8, 8), 0.36),
    ((0, 0, 10, 10), (10, 0, 20, 10), 0.0),   # they touch
    ((0, 0, 10, 10), (30, 40, 50, 60), 0.0),
    ((0, 0, 0, 0), (0, 0, 0, 0), 0.0),        # no area
]


def slow_ciou(a, b):
    """Zheng et al. 2020, Eqs. 8 to 11, written out."""
    overlap = next(o for p, q, o in PAIRS if (p, q) == (a, b))
    diagonal = (max(a[2], b[2]) - min(a[0], b[0])) ** 2 + (max(a[3], b[3]) - min(a[1], b[1])) ** 2
    apart = ((a[0] + a[2] - b[0] - b[2]) / 2) ** 2 + ((a[1] + a[3] - b[1] - b[3]) / 2) ** 2
    v = 4 / math.pi ** 2 * (math.atan((b[2] - b[0]) / (b[3] - b[1])) - math.atan((a[2] - a[0]) / (a[3] - a[1]))) ** 2
    alpha = v / (1 - overlap + v) if v else 0.0
    return overlap - apart / diagonal - alpha * v


def tensor(box):
    return torch.tensor(box, dtype=torch.float64)


@pytest.mark.parametrize("a, b, expected", PAIRS)
def test_iou(a, b, expected):
    assert iou(tensor(a), tensor(b)).item() == pytest.approx(expected)
    assert iou(tensor(b), tensor(a)).item() == pytest.approx(expected)


def test_iou_of_all_with_all():
    a, b = torch.tensor([p[0] for p in PAIRS]).float(), torch.tensor([p[1] for p in PAIRS]).float()
    table = iou(a[:, None], b[None])
    assert table.shape == (6, 6) and torch.equal(table.diagonal(), iou(a, b))


@pytest.mark.parametrize("a, b, _", PAIRS[:5])
def test_ciou(a, b, _):
    assert ciou(tensor(a), tensor(b)).item() == pytest.approx(slow_ciou(a, b))


def test_ciou_of_boxes_of_another_ratio():
    a, b = (0, 0, 20, 10), (0, 0, 10, 20)  # IoU 100 / 300, centres (10, 5) and (5, 10), hull 20 x 20
    v = 4 / math.pi ** 2 * (math.atan(0.5) - math.atan(2)) ** 2
    expected = 1 / 3 - 50 / 800 - v * v / (2 / 3 + v)
    assert ciou(tensor(a), tensor(b)).item() == pytest.approx(expected)


@pytest.mark.parametrize("boxes", [((5, 5, 5, 5), (5, 5, 5, 5)), ((0, 0, 1e-30, 5), (2, 2, 3, 3)), ((3, 3, 2, 2), (0, 0, 9, 9))])
def test_gradients_of_ciou_are_finite_for_degenerate_boxes(boxes):
    a, b = (torch.tensor(box, requires_grad=True) for box in torch.tensor(boxes).float().tolist())
    ciou(a, b).backward()
    assert torch.isfinite(a.grad).all() and torch.isfinite(b.grad).all()


def test_cells_are_listed_row_by_row_and_map_by_map():
    centres, strides = cell_centres([torch.zeros(1, 1, 4, 8), torch.zeros(1, 1, 2, 4), torch.zeros(1, 1, 1, 2)])
    assert len(centres) == 32 + 8 + 2 and strides.tolist() == [8] * 32 + [16] * 8 + [32] * 2
    assert centres[[0, 1, 8, 32, 41]].tolist() == [[4, 4], [12, 4], [4, 12], [8, 8], [48, 16]]


def test_distribution_on_two_bins_is_the_place_between_them():
    logits = torch.full((1, 4, 16), -1e4)
    for side, (bin_, share) in enumerate([(0, 0.0), (2, 0.25), (14, 0.5), (3, 0.0)]):
        logits[0, side, bin_], logits[0, side, bin_ + 1] = math.log(1 - share), math.log(share) if share else -1e4
    box = boxes_of(logits, torch.tensor([[100.0, 60.0]]), torch.tensor([8.0]))
    np.testing.assert_allclose(box[0], [100, 60 - 8 * 2.25, 100 + 8 * 14.5, 60 + 8 * 3], rtol=1e-5)


def test_distances_are_in_cells_and_within_the_bins():
    centres, strides = torch.tensor([[100.0, 100.0]] * 3), torch.tensor([8.0, 16.0, 8.0])
    boxes = torch.tensor([[84.0, 92, 108, 124], [84, 92, 108, 124], [110, 0, 400, 104]])
    found = distances_of(boxes, centres, strides)
    np.testing.assert_allclose(found, [[2, 1, 1, 3], [1, 0.5, 0.5, 1.5], [0, 12.5, 14.99, 0.5]], rtol=1e-6)
