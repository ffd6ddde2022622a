"""From raw maps to detections, as the `detect` stage makes them: best class of each cell, then suppression."""
from dataclasses import dataclass

import cv2
import numpy as np
import torch

from .boxes import boxes_of, cell_centres, flattened

MOST_CANDIDATES, MOST_DETECTIONS = 3000, 300


@dataclass
class Detections:
    """Of one image, best score first."""
    boxes: np.ndarray    # Mx4, corners [px]
    scores: np.ndarray   # M, 0..1
    classes: np.ndarray  # M


def suppressed(boxes, scores, classes, overlap):
    """Places of the boxes that no better one of the same class overlaps by more; best first."""
    if not len(boxes):
        return np.zeros(0, np.int64)
    apart = boxes + (classes * (np.abs(boxes).max() * 2 + 1))[:, None]  # classes do not meet
    sides = np.concatenate([apart[:, :2], apart[:, 2:] - apart[:, :2]], 1).astype(np.float64)
    kept = cv2.dnn.NMSBoxes(sides.tolist(), scores.astype(np.float32).tolist(), 0.0, overlap)
    return np.asarray(kept, np.int64).reshape(-1)[:MOST_DETECTIONS]


@torch.no_grad()
def detections_of(maps, confidence, overlap):
    """One Detections for each image, in pixels of the network's input."""
    centres, strides = cell_centres(maps)
    distances, logits = flattened(maps)
    boxes = boxes_of(distances, centres, strides)
    scores, classes = logits.sigmoid().max(-1)
    found = []
    for row in range(len(scores)):
        best = scores[row].topk(min(MOST_CANDIDATES, scores.shape[1])).indices
        best = best[scores[row, best] >= confidence]
        b, s, c = (part[row, best].cpu().numpy() for part in (boxes, scores, classes))
        kept = suppressed(b, s, c, overlap)
        found.append(Detections(b[kept], s[kept], c[kept]))
    return found


def in_image(found, image_size, input_size, fitted):
    """From pixels of the input, where the image of (width, height) `fitted` stands in the middle, to its own."""
    corner = np.array([(i - f) // 2 for i, f in zip(input_size, fitted)] * 2)
    factor = np.array([i / f for i, f in zip(image_size, fitted)] * 2)
    boxes = np.clip((found.boxes - corner) * factor, 0, np.array(image_size * 2))
    return Detections(boxes, found.scores, found.classes)
