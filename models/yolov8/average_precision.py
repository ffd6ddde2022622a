"""COCO's measure: average precision over 101 recalls, for ten overlaps and for sizes of bodies."""
import numpy as np

OVERLAPS = np.arange(50, 100, 5) / 100
RECALLS = np.arange(101) / 100
MOST_DETECTIONS = 100  # of one class in one image
# areas [px of the image]
ALL = {"all": (0, np.inf)}
SIZES = {**ALL, "small": (0, 32 ** 2), "medium": (32 ** 2, 96 ** 2), "large": (96 ** 2, np.inf)}


def overlaps_of(a, b):
    """IoU of each of a (Mx4) with each of b (Nx4)."""
    low, high = np.maximum(a[:, None, :2], b[None, :, :2]), np.minimum(a[:, None, 2:], b[None, :, 2:])
    shared = np.clip(high - low, 0, None).prod(-1)
    total = areas_of(a)[:, None] + areas_of(b)[None] - shared
    return np.divide(shared, total, out=np.zeros_like(total), where=total > 0)


def areas_of(boxes):
    return (boxes[:, 2:] - boxes[:, :2]).prod(-1)


def matched(boxes, true, ignored):
    """For each overlap and detection (best score first): 1 matches a body, 0 none, -1 one that does not count.
    A body is matched once; one that counts goes before one that does not (COCO's rule)."""
    result = np.zeros((len(OVERLAPS), len(boxes)), np.int8)
    table, free = overlaps_of(boxes, true), np.ones((len(OVERLAPS), len(true)), bool)
    for index in np.nonzero(table.max(1, initial=0) >= OVERLAPS[0])[0]:
        fits = free & (table[index] >= OVERLAPS[:, None])
        counts = fits & ~ignored
        fits = np.where(counts.any(1, keepdims=True), counts, fits)
        rows = np.nonzero(fits.any(1))[0]
        best = np.where(fits, table[index], -1).argmax(1)[rows]
        free[rows, best] = False
        result[rows, index] = np.where(ignored[best], -1, 1)
    return result


def average_precision(hits, scores, bodies, weights=None):
    """AP of detections that hit (1), miss (0) or do not count (-1), with the number of bodies to be found. A
    detection counts as often as its weight says."""
    if bodies == 0:
        return np.nan
    weights = np.ones(len(hits)) if weights is None else weights
    order = np.argsort(-scores, kind="stable")
    order = order[(hits[order] >= 0) & (weights[order] > 0)]
    found, all_ = np.cumsum(hits[order] * weights[order]), np.cumsum(weights[order])
    recall, precision = found / bodies, found / all_
    precision = np.maximum.accumulate(precision[::-1])[::-1]
    places = np.searchsorted(recall, RECALLS, side="left")
    return float(np.append(precision, 0.0)[np.minimum(places, len(order))].mean())


class Scorer:
    """Collects images, then gives AP by class, overlap and size. Boxes are corners [px of the image]."""

    def __init__(self, names, sizes=SIZES):
        self.names, self.sizes, self.images = names, sizes, 0
        self.rows = {(c, s): [] for c in range(len(names)) for s in sizes}  # (image, hits, scores, bodies)

    def add(self, detections, boxes, classes):
        for c in range(len(self.names)):
            mine = np.nonzero(detections.classes == c)[0]
            mine = mine[np.argsort(-detections.scores[mine], kind="stable")][:MOST_DETECTIONS]
            found, true = detections.boxes[mine], boxes[classes == c]
            if not len(found) and not len(true):
                continue
            for size, (least, most) in self.sizes.items():
                ignored = ~((areas_of(true) >= least) & (areas_of(true) < most))
                hits = matched(found, true, ignored)
                outside = ~((areas_of(found) >= least) & (areas_of(found) < most))
                hits[(hits == 0) & outside[None]] = -1
                self.rows[c, size].append((self.images, hits, detections.scores[mine], int((~ignored).sum())))
        self.images += 1

    def bodies(self, c, size="all"):
        return sum(row[3] for row in self.rows[c, size])

    def table(self, size="all", image_weights=None):
        """AP by class (rows) and overlap; NaN rows for classes without bodies."""
        weights = np.ones(self.images) if image_weights is None else image_weights
        result = np.full((len(self.names), len(OVERLAPS)), np.nan)
        for c in range(len(self.names)):
            if not self.rows[c, size]:
                continue
            image, hits, scores, bodies = zip(*self.rows[c, size])
            of_image = weights[list(image)]
            of_detection = np.repeat(of_image, [len(s) for s in scores])
            hits, scores = np.concatenate(hits, 1), np.concatenate(scores)
            result[c] = [average_precision(row, scores, of_image @ bodies, of_detection) for row in hits]
        return result

    def summary(self, size="all", image_weights=None):
        """mAP50 and mAP50-95 over the classes that have bodies; NaN without any."""
        table = self.table(size, image_weights)
        known = table[~np.isnan(table[:, 0])]
        return (float(known[:, 0].mean()), float(known.mean())) if len(known) else (np.nan, np.nan)

    def intervals(self, scenes, resamples=200):
        """95 % intervals of both: the scenes drawn again and again (Efron 1979), the same for the same images.
        `scenes`: of each image; what is in one scene is no second proof."""
        known, scene = np.unique(scenes, return_inverse=True)
        rng = np.random.default_rng(1)
        draws = []
        for _ in range(resamples):
            times = np.bincount(rng.integers(len(known), size=len(known)), minlength=len(known))
            draws.append(self.summary(image_weights=times[scene]))
        return [tuple(np.nanpercentile([d[i] for d in draws], (2.5, 97.5))) for i in range(2)]
