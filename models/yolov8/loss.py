"""What training minimises: scores (BCE), boxes (CIoU) and their distributions (DFL)."""
from dataclasses import dataclass

import torch
import torch.nn.functional as F

from .assign import assign
from .boxes import boxes_of, cell_centres, ciou, distances_of, flattened

SCORE_GAIN, BOX_GAIN, DISTRIBUTION_GAIN = 0.5, 7.5, 1.5


@dataclass
class Bodies:
    """The labelled bodies of a batch."""
    boxes: torch.Tensor    # Mx4, corners [px of the input]
    classes: torch.Tensor  # M
    images: torch.Tensor   # M, image of the batch

    def to(self, device):
        return Bodies(self.boxes.to(device), self.classes.to(device), self.images.to(device))


def distribution_loss(logits, distances):
    """Cross entropy with the two bins beside each distance, by how near they are (Li et al. 2020, GFL, Eq. 6)."""
    lower = distances.floor()
    upper_share = distances - lower
    log = F.log_softmax(logits, -1)
    below, above = (log.gather(-1, (lower.long() + i)[..., None])[..., 0] for i in (0, 1))
    return -(below * (1 - upper_share) + above * upper_share).mean(-1)


def detection_loss(maps, bodies):
    """Sum over the batch's bodies per unit of target score, as a tensor; and its three parts for the log."""
    centres, strides = cell_centres(maps)
    distances, scores = flattened(maps)
    predicted = boxes_of(distances, centres, strides)
    wanted = torch.zeros_like(scores)
    box = distribution = scores.sum() * 0
    total = 1.0
    if len(bodies.boxes):
        with torch.no_grad():
            found = assign(bodies.boxes, bodies.classes, bodies.images, predicted, scores.sigmoid(), centres)
        wanted[found.image, found.cell, bodies.classes[found.body]] = found.score
        total = found.score.sum().clamp(min=1.0)
        true = bodies.boxes[found.body]
        box = ((1 - ciou(predicted[found.image, found.cell], true)) * found.score).sum() / total
        sides = distances_of(true, centres[found.cell], strides[found.cell])
        distribution = (distribution_loss(distances[found.image, found.cell], sides) * found.score).sum() / total
    score = F.binary_cross_entropy_with_logits(scores, wanted, reduction="sum") / total
    parts = torch.stack([SCORE_GAIN * score, BOX_GAIN * box, DISTRIBUTION_GAIN * distribution])
    return parts.sum(), parts.detach()
