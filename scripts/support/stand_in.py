"""The simulator's truth in the detector's place: what a picture shows, as `detect` would publish it."""
import copy
import math

SCORE = 0.9
LEAST_VISIBLE, SMALLEST = 0.3, 4.0  # share of the body, px: a detector sees less of nothing
CUT_TOP, CUT_BOTTOM = 2, 8  # ImageDetection.CUT_*


def seen(truth, info, parameters):
    """Detections of an ImageDetectionArray of truth/.../detections. Ranges by paper 001 Eq. 3 with the parameters of the
    stage `detect`."""
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
        if body.label in parameters["class_heights"] and not body.cut & (CUT_TOP | CUT_BOTTOM):
            spread = parameters["class_height_spreads"].get(body.label, parameters["height_spread"])
            body.depth = info.K[4] * parameters["class_heights"][body.label] / high
            body.range = body.depth / body.ray.z
            body.range_sigma = body.range * math.hypot(math.sqrt(2.0) * parameters["box_pixel_error"] / high, spread)
            body.range_source = body.RANGE_FROM_HEIGHT
        out.detections.append(body)
    return out
