"""Which cells answer for which body: task-aligned assignment (Feng et al. 2021, TOOD, section 3.2)."""
from dataclasses import dataclass

import torch

from .boxes import iou
from .network import STRIDES

ALPHA, BETA, MOST_CELLS = 0.5, 6.0, 10


@dataclass
class Assignment:
    """Cells that answer for a body, in no particular order; one entry each."""
    image: torch.Tensor  # of the batch
    cell: torch.Tensor   # of all maps
    body: torch.Tensor   # row of the bodies
    score: torch.Tensor  # what the score of the body's class shall be, 0..1


def candidates(boxes, centres):
    """Pairs (body, cell) whose cell's centre lies inside the body's box. A body between the centres of the
    finest map would have none: boxes count as no smaller than its cells."""
    middle, half = (boxes[:, :2] + boxes[:, 2:]) / 2, (boxes[:, 2:] - boxes[:, :2]) / 2
    half = half.clamp(min=STRIDES[0] / 2 * 1.001)
    return ((centres[None] - middle[:, None]).abs() < half[:, None]).all(-1).nonzero(as_tuple=True)


def assign(boxes, classes, images, predicted, scores, centres):
    """Bodies: boxes Mx4 [px], classes M, images M. Predicted: boxes NxAx4 [px], scores NxAxC in 0..1."""
    body, cell = candidates(boxes, centres)
    overlap = iou(predicted[images[body], cell], boxes[body])
    metric = torch.zeros(len(boxes), len(centres), device=boxes.device)
    metric[body, cell] = scores[images[body], cell, classes[body]] ** ALPHA * overlap ** BETA
    # rows are bodies from here on, columns the cells that each claims
    metric, cell = metric.topk(min(MOST_CELLS, len(centres)), 1)
    overlap = iou(predicted[images[:, None], cell], boxes[:, None])
    metric = metric * undisputed(images[:, None] * len(centres) + cell, overlap, metric > 0)
    kept = metric > 0
    # a body's best cell shall score its greatest overlap, the others in proportion to their metric
    highest = metric.amax(1, keepdim=True).clamp(min=torch.finfo(metric.dtype).tiny)
    score = metric / highest * (overlap * kept).amax(1, keepdim=True)
    body = torch.arange(len(boxes), device=boxes.device)[:, None].expand_as(cell)
    return Assignment(images[body[kept]], cell[kept], body[kept], score[kept])


def undisputed(places, overlap, claimed):
    """Where several bodies claim one place, only the one with the greatest overlap keeps its claim."""
    row, column = claimed.nonzero(as_tuple=True)
    places, overlap = places[row, column], overlap[row, column]
    order = overlap.argsort(descending=True, stable=True)
    order = order[places[order].argsort(stable=True)]
    first = torch.ones_like(order, dtype=torch.bool)
    first[1:] = places[order][1:] != places[order][:-1]
    winners = torch.zeros_like(claimed)
    winners[row[order[first]], column[order[first]]] = True
    return winners
