"""Training samples from labelled images: mosaic, scale, shift, mirror, colours."""
from dataclasses import dataclass

import cv2
import numpy as np

from .dataset import GREY, Sample
from .network import STRIDES

LEAST_SIDE = 3.0     # [px] of a box that was cut: what remains smaller is not a body any more
LEAST_VISIBLE = 0.2  # share of its area


@dataclass
class Augmentation:
    mosaic: float = 1.0   # share of samples made of four images
    scale: float = 0.5    # least and most scale are 1 -+ this
    shift: float = 0.1    # of the input's sides
    mirror: float = 0.5   # share of samples
    hue: float = 0.015    # least and most factors are 1 -+ these
    saturation: float = 0.7
    value: float = 0.4
    window: float = 1.0   # below 1: cuttings with sides of this share of the input's, around a body


def letterboxed(sample, size):
    """Where the `detect` stage puts an image that fits into `size` (width, height)."""
    width, height = size
    image = np.full((height, width, 3), GREY, np.uint8)
    h, w = sample.image.shape[:2]
    left, top = (width - w) // 2, (height - h) // 2
    image[top:top + h, left:left + w] = sample.image
    return Sample(image, sample.boxes + np.float32([left, top, left, top]), sample.classes)


def paste(canvas, sample, scale, left, top, window):
    """Draws the image scaled, its corner at (left, top), inside `window` (x_min, y_min, x_max, y_max) of the canvas.
    Its boxes there, uncut, and their classes."""
    x_min, y_min = max(window[0], left, 0), max(window[1], top, 0)
    h, w = sample.image.shape[:2]
    x_max = min(window[2], int(left + w * scale), canvas.shape[1])
    y_max = min(window[3], int(top + h * scale), canvas.shape[0])
    x_min, y_min = int(np.ceil(x_min)), int(np.ceil(y_min))
    if x_max <= x_min or y_max <= y_min:
        return np.zeros((0, 4), np.float32), np.zeros(0, np.int64)
    # pixel centres: source = (target + 0.5 - corner) / scale - 0.5
    matrix = np.float32([[1 / scale, 0, (x_min + 0.5 - left) / scale - 0.5],
                         [0, 1 / scale, (y_min + 0.5 - top) / scale - 0.5]])
    canvas[y_min:y_max, x_min:x_max] = cv2.warpAffine(
        sample.image, matrix, (x_max - x_min, y_max - y_min), flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
        borderMode=cv2.BORDER_REPLICATE)
    boxes = sample.boxes * scale + np.float32([left, top, left, top])
    return cut(boxes, sample.classes, (x_min, y_min, x_max, y_max))


def cut(boxes, classes, window):
    """Boxes cut to the window; those of which too little is left are dropped."""
    low, high = np.float32(window[:2]), np.float32(window[2:])
    inside = np.concatenate([np.clip(boxes[:, :2], low, high), np.clip(boxes[:, 2:], low, high)], 1)
    sides, whole = inside[:, 2:] - inside[:, :2], boxes[:, 2:] - boxes[:, :2]
    least = np.minimum(LEAST_SIDE, whole.min(1))  # a body that was that small before stays
    kept = (sides.min(1) >= least - 1e-3) & (sides.prod(1) >= LEAST_VISIBLE * whole.prod(1)) & (sides.min(1) > 0)
    return inside[kept], classes[kept]


def mosaic(samples, size, settings, rng):
    """Four images around a random point, seen through a window of random scale."""
    width, height = size
    canvas = np.full((height, width, 3), GREY, np.uint8)
    scale = rng.uniform(1 - settings.scale, 1 + settings.scale)
    # where the four meet: off the window's middle by up to half an image, and shifted
    off = rng.uniform(-0.5, 0.5, 2) * scale + rng.uniform(-settings.shift, settings.shift, 2)
    x, y = np.array(size) * (0.5 + off)
    boxes, classes = [], []
    for index, sample in enumerate(samples):
        h, w = np.array(sample.image.shape[:2]) * scale
        right, below = index % 2, index // 2
        window = (x if right else 0, y if below else 0, width if right else x, height if below else y)
        window = tuple(int(round(float(edge))) for edge in window)
        found = paste(canvas, sample, scale, x if right else x - w, y if below else y - h, window)
        boxes.append(found[0])
        classes.append(found[1])
    return Sample(canvas, np.concatenate(boxes), np.concatenate(classes))


def shifted(sample, size, settings, rng):
    """One image at a random scale and place."""
    width, height = size
    canvas = np.full((height, width, 3), GREY, np.uint8)
    scale = rng.uniform(1 - settings.scale, 1 + settings.scale)
    h, w = np.array(sample.image.shape[:2]) * scale
    x, y = rng.uniform(-settings.shift, settings.shift, 2) * size
    boxes, classes = paste(canvas, sample, scale, (width - w) / 2 + x, (height - h) / 2 + y, (0, 0, width, height))
    return Sample(canvas, boxes, classes)


def cutting(sample, size, settings, rng):
    """A part of one image, around one of its bodies: most of what there is to learn, for a part of the pixels."""
    width, height = np.array(size) * settings.window // STRIDES[-1] * STRIDES[-1]
    window = np.maximum([width, height], STRIDES[-1]).astype(int)
    canvas = np.full((window[1], window[0], 3), GREY, np.uint8)
    # from the scale at which the whole image fits to somewhat more than its own
    scale = np.exp(rng.uniform(np.log(settings.window), np.log(1.25)))
    extent = np.array(sample.image.shape[1::-1]) * scale
    if len(sample.boxes):
        box = sample.boxes[rng.integers(len(sample.boxes))]
        middle = (box[:2] + box[2:]) / 2 * scale
    else:
        middle = rng.uniform(0, 1, 2) * extent
    corner = window / 2 - middle + rng.uniform(-0.4, 0.4, 2) * window
    free = window - extent  # where the image is larger than the window it fills it, else it lies within
    corner = np.clip(corner, np.minimum(free, 0), np.maximum(free, 0))
    boxes, classes = paste(canvas, sample, scale, *corner, (0, 0, *window))
    return Sample(canvas, boxes, classes)


def mirrored(sample):
    boxes = sample.boxes.copy()
    boxes[:, [0, 2]] = sample.image.shape[1] - boxes[:, [2, 0]]
    return Sample(np.ascontiguousarray(sample.image[:, ::-1]), boxes, sample.classes)


def recoloured(image, settings, rng):
    hue, saturation, value = 1 + rng.uniform(-1, 1, 3) * (settings.hue, settings.saturation, settings.value)
    steps = np.arange(256)
    tables = [steps * hue % 180, np.minimum(steps * saturation, 255), np.minimum(steps * value, 255)]
    table = np.stack(tables, -1).astype(np.uint8)[None]
    return cv2.cvtColor(cv2.LUT(cv2.cvtColor(image, cv2.COLOR_BGR2HSV), table), cv2.COLOR_HSV2BGR)


def augmented(dataset, index, settings, rng):
    """The training sample that `rng` makes of this image, and for a mosaic of three others."""
    if settings.window < 1:
        sample = cutting(dataset.samples[index], dataset.size, settings, rng)
    elif rng.random() < settings.mosaic:
        others = rng.integers(len(dataset), size=3)
        sample = mosaic([dataset.samples[i] for i in (index, *others)], dataset.size, settings, rng)
    else:
        sample = shifted(dataset.samples[index], dataset.size, settings, rng)
    if rng.random() < settings.mirror:
        sample = mirrored(sample)
    return Sample(recoloured(sample.image, settings, rng), sample.boxes, sample.classes)
