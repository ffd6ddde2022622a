"""From raw maps to detections, against the rule written out."""
import numpy as np
import pytest
import torch

from yolov8.average_precision import overlaps_of
from yolov8.detections import Detections, detections_of, in_image, suppressed


def slow_suppression(boxes, scores, classes, limit):
    kept = []
    for i in sorted(range(len(boxes)), key=lambda i: -scores[i]):
        if all(classes[i] != classes[j] or overlaps_of(boxes[[i]], boxes[[j]])[0, 0] <= limit for j in kept):
            kept.append(i)
    return kept


@pytest.mark.parametrize("seed", range(4))
def test_suppression_is_the_rule(seed):
    random = np.random.default_rng(seed)
    corner = random.uniform(0, 60, (80, 2))
    boxes = np.concatenate([corner, corner + random.uniform(10, 40, (80, 2))], 1).astype(np.float32)
    scores, classes = random.permutation(80) / 80 + 0.01, random.integers(0, 3, 80)
    assert suppressed(boxes, scores, classes, 0.5).tolist() == slow_suppression(boxes, scores, classes, 0.5)


def test_no_boxes_none_suppressed():
    assert suppressed(np.zeros((0, 4)), np.zeros(0), np.zeros(0), 0.5).tolist() == []


def maps_with_one_body():
    """Cell (3, 1) of stride 8, with its centre at (28, 12): 1 cell to the left, 1 up, 2 right, 3 down; class 1 at 0.8."""
    maps = [torch.full((1, 64 + 2, side, side), -20.0) for side in (8, 4, 2)]
    for side, distance in enumerate((1, 1, 2, 3)):
        maps[0][0, side * 16 + distance, 1, 3] = 20.0
    maps[0][0, 65, 1, 3] = np.log(0.8 / 0.2)
    return maps


def test_one_body():
    found, = detections_of(maps_with_one_body(), 0.25, 0.5)
    np.testing.assert_allclose(found.boxes, [[20, 4, 44, 36]], atol=1e-4)
    np.testing.assert_allclose(found.scores, [0.8], atol=1e-6)
    assert found.classes.tolist() == [1]


def test_nothing_above_the_confidence():
    found, = detections_of(maps_with_one_body(), 0.81, 0.5)
    assert found.boxes.shape == (0, 4) and len(found.scores) == len(found.classes) == 0


def test_boxes_go_back_to_the_image():
    """An image of 1280 x 720 stands as 640 x 360 in 640 x 384, 12 px below the top."""
    found = Detections(np.float32([[20, 32, 44, 52], [-5, 0, 700, 400]]), np.ones(2), np.zeros(2))
    back = in_image(found, (1280, 720), (640, 384), (640, 360))
    np.testing.assert_allclose(back.boxes, [[40, 40, 88, 80], [0, 0, 1280, 720]])
