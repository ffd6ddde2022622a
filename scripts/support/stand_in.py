"""The simulator's truth in the detector's place: what a picture shows, as `detect` would publish it."""
import copy
import math

SCORE = 0.9
LEAST_VISIBLE, SMALLEST = 0.3, 4.0  # share of the body, px: a detector sees less of nothing
EDGE_ERROR, SPREAD, SPREADS = 1.5, 0.1, {"boat": 0.6}  # px, -, -: box_pixel_error, height_spread, class_height_spreads of `detect`
CUT_TOP, CUT_BOTTOM = 2, 8  # ImageDetection.CUT_*


def seen(truth, info, heights):
    """Detections of an ImageDetectionArray of truth/.../detections. Ranges by paper 001 Eq. 3 from `heights` {class: m}."""
    out = copy.copy(truth)
    out.detections = []
    for body in truth.detections:
        wide, high = body.x_max - body.x_min, body.y_max - body.y_min
        if body.score < LEAST_VISIBLE or min(wide, high) < SMALLEST:
            continue
        body = copy.copy(body)
        body.id, body.score = len(out.detections), SCORE
        body.range = body.depth = body.range_sigma = math.nan
        body.range_source = body.RANGE_UNKNOWN
        if body.label in heights and not body.cut & (CUT_TOP | CUT_BOTTOM):
            body.depth = info.K[4] * heights[body.label] / high
            body.range = body.depth / body.ray.z
            body.range_sigma = body.range * math.hypot(math.sqrt(2.0) * EDGE_ERROR / high, SPREADS.get(body.label, SPREAD))
            body.range_source = body.RANGE_FROM_HEIGHT
        out.detections.append(body)
    return out
