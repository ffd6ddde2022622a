"""Boxes as corners (x_min, y_min, x_max, y_max), their overlaps, and what the raw maps say about them."""
import math

import torch
import torch.nn.functional as F

from .network import BINS, BOX_ROWS, STRIDES


def iou(a, b):
    """Intersection over union; the leading dimensions are broadcast. 0 for boxes without area."""
    shared = (torch.minimum(a[..., 2:], b[..., 2:]) - torch.maximum(a[..., :2], b[..., :2])).clamp(min=0).prod(-1)
    area_a, area_b = ((c[..., 2:] - c[..., :2]).clamp(min=0).prod(-1) for c in (a, b))
    return shared / (area_a + area_b - shared).clamp(min=1e-9)


def ciou(a, b):
    """Complete IoU (Zheng et al. 2020, Eqs. 8 to 11): less for centres far apart and for sides of another ratio."""
    overlap = iou(a, b)
    span = torch.maximum(a[..., 2:], b[..., 2:]) - torch.minimum(a[..., :2], b[..., :2])
    centres = (a[..., :2] + a[..., 2:] - b[..., :2] - b[..., 2:]) / 2
    distance = centres.square().sum(-1) / span.square().sum(-1).clamp(min=1e-9)
    (wa, ha), (wb, hb) = ((c[..., 2:] - c[..., :2]).clamp(min=1e-9).unbind(-1) for c in (a, b))
    ratio = 4 / math.pi ** 2 * (torch.atan(wb / hb) - torch.atan(wa / ha)).square()
    with torch.no_grad():  # alpha is a weight, not a function to descend (ibid., Eq. 11)
        alpha = ratio / (1 - overlap + ratio).clamp(min=1e-9)
    return overlap - distance - alpha * ratio


def cell_centres(maps):
    """Of all cells of all maps: centres [px of the input] Ax2 and strides [px] A."""
    centres, strides = [], []
    for found, stride in zip(maps, STRIDES):
        height, width = found.shape[-2:]
        y, x = torch.meshgrid(torch.arange(height, device=found.device), torch.arange(width, device=found.device),
                              indexing="ij")
        centres.append((torch.stack([x, y], -1).reshape(-1, 2) + 0.5) * stride)
        strides.append(torch.full((height * width,), float(stride), device=found.device))
    return torch.cat(centres), torch.cat(strides)


def flattened(maps):
    """Raw maps as the logits of distances NxAx4x16 and of scores NxAxclasses, of 32 bits at least."""
    rows = torch.cat([m.flatten(2) for m in maps], 2).transpose(1, 2)
    rows = rows.to(torch.promote_types(rows.dtype, torch.float32))
    return rows[..., :BOX_ROWS].reshape(*rows.shape[:2], 4, BINS), rows[..., BOX_ROWS:]


def boxes_of(distances, centres, strides):
    """Corners [px] from the logits of distances [cells]: the mean of each distribution."""
    bins = torch.arange(BINS, dtype=distances.dtype, device=distances.device)
    sides = (F.softmax(distances, -1) * bins).sum(-1) * strides[:, None]
    return torch.cat([centres - sides[..., :2], centres + sides[..., 2:]], -1)


def distances_of(boxes, centres, strides):
    """The inverse: distances [cells] to the four sides, cut to what the bins can hold."""
    sides = torch.cat([centres - boxes[..., :2], boxes[..., 2:] - centres], -1) / strides[..., None]
    return sides.clamp(0, BINS - 1 - 0.01)
