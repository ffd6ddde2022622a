"""COCO's measure against values known by hand and against its definition written out."""
import numpy as np
import pytest

from yolov8.average_precision import OVERLAPS, Scorer, average_precision, overlaps_of
from yolov8.detections import Detections

BODY = (0.0, 0.0, 10.0, 10.0)


def found(*rows):
    """Rows (box, score, class)."""
    boxes = np.array([r[0] for r in rows], float).reshape(-1, 4)
    return Detections(boxes, np.array([r[1] for r in rows]), np.array([r[2] for r in rows], int))


def scored(images, names=("a",)):
    """Images: (detections, [(box, class), ...])."""
    scorer = Scorer(list(names))
    for detections, bodies in images:
        scorer.add(detections, np.array([b for b, _ in bodies], float).reshape(-1, 4), np.array([c for _, c in bodies], int))
    return scorer


def shifted(overlap):
    """BODY moved to the right until the overlap is this."""
    step = 10 * (1 - overlap) / (1 + overlap)
    return (step, 0.0, 10.0 + step, 10.0)


def test_all_found_exactly():
    assert scored([(found((BODY, 0.9, 0)), [(BODY, 0)])]).summary() == (1.0, 1.0)


def test_overlap_of_072_counts_at_five_of_ten():
    map50, mean = scored([(found((shifted(0.72), 0.9, 0)), [(BODY, 0)])]).summary()
    assert (map50, mean) == (1.0, pytest.approx(0.5))  # 0.50, 0.55, 0.60, 0.65, 0.70


def test_nothing_found():
    assert scored([(found(), [(BODY, 0)])]).summary() == (0.0, 0.0)


def test_no_bodies_no_figure():
    assert np.isnan(scored([(found((BODY, 0.9, 0)), [])]).summary()).all()


def test_class_without_bodies_has_no_say():
    scorer = scored([(found((BODY, 0.9, 0), (BODY, 0.9, 1)), [(BODY, 0)])], ("a", "b"))
    assert scorer.summary() == (1.0, 1.0) and np.isnan(scorer.table()[1]).all()


def test_wrong_class_is_a_miss():
    assert scored([(found((BODY, 0.9, 1)), [(BODY, 0)])], ("a", "b")).summary() == (0.0, 0.0)


def test_half_found_is_51_of_101_recalls():
    """Precision 1 at recalls 0, 0.01 ... 0.50, else 0."""
    far = (50.0, 0.0, 60.0, 10.0)
    assert scored([(found((BODY, 0.9, 0)), [(BODY, 0), (far, 0)])]).summary()[0] == pytest.approx(51 / 101)


def test_false_alarm_before_the_body_halves_the_precision():
    far = (50.0, 0.0, 60.0, 10.0)
    alarm_first = [(found((far, 0.9, 0), (BODY, 0.8, 0)), [(BODY, 0)])]
    alarm_last = [(found((far, 0.7, 0), (BODY, 0.8, 0)), [(BODY, 0)])]
    assert scored(alarm_first).summary()[0] == pytest.approx(0.5)
    assert scored(alarm_last).summary()[0] == pytest.approx(1.0)


def test_second_box_on_a_body_is_a_false_alarm():
    twice = found((BODY, 0.9, 0), (shifted(0.9), 0.8, 0))
    far = (50.0, 0.0, 60.0, 10.0)
    precision = scored([(twice, [(BODY, 0)]), (found((far, 0.7, 0)), [(far, 0)])]).summary()[0]
    assert precision == pytest.approx((51 * 1.0 + 50 * 2 / 3) / 101)  # hit, miss, hit


def test_false_alarm_in_an_image_of_nothing_counts():
    images = [(found((BODY, 0.9, 0)), []), (found((BODY, 0.8, 0)), [(BODY, 0)])]
    assert scored(images).summary()[0] == pytest.approx(0.5)


def test_sizes_ignore_what_is_larger_or_smaller():
    """A small body is found; a large one is missed, and so is one beside it."""
    large, beside = (100.0, 100.0, 300.0, 300.0), (400.0, 0.0, 600.0, 200.0)
    scorer = scored([(found((BODY, 0.9, 0), (beside, 0.95, 0)), [(BODY, 0), (large, 0)])])
    assert scorer.summary("small")[0] == 1.0  # the large false alarm does not count among the small
    assert scorer.summary("large")[0] == 0.0
    assert np.isnan(scorer.summary("medium")[0])
    assert scorer.summary("all")[0] == pytest.approx(0.5 * 51 / 101)


def test_overlaps():
    a = np.array([[0, 0, 10, 10], [0, 0, 0, 0]], float)
    np.testing.assert_allclose(overlaps_of(a, np.array([[5, 0, 15, 10], [0, 0, 10, 10], [0, 0, 0, 0]], float)),
                               [[1 / 3, 1, 0], [0, 0, 0]])


def slow_average_precision(images, least):
    """One class. The definition: rank all detections, match each greedily in its image, then for each of the 101
    recalls the greatest precision at that recall or a greater one."""
    ranked = sorted(((score, i, box) for i, (detections, _) in enumerate(images)
                     for box, score in zip(detections.boxes, detections.scores)), key=lambda r: -r[0])
    taken, hits = set(), []
    for _, i, box in ranked:
        overlaps = [(overlaps_of(box[None], np.array([b]))[0, 0], j)
                    for j, (b, _) in enumerate(images[i][1]) if (i, j) not in taken]
        best = max(overlaps, default=(0, None))
        hits.append(best[0] >= least)
        if hits[-1]:
            taken.add((i, best[1]))
    bodies, total = sum(len(b) for _, b in images), 0.0
    points = [(sum(hits[:n]) / bodies, sum(hits[:n]) / n) for n in range(1, len(hits) + 1)]
    for step in range(101):
        total += max((p for r, p in points if r >= step / 100), default=0.0)
    return total / 101


@pytest.mark.parametrize("seed", range(5))
def test_average_precision_is_its_definition(seed):
    random = np.random.default_rng(seed)
    images, score = [], iter(random.permutation(200) / 200)
    for _ in range(8):
        corners = random.uniform(0, 80, (random.integers(0, 5), 2))
        bodies = [(tuple(np.concatenate([c, c + random.uniform(8, 30, 2)])), 0) for c in corners]
        near = [(np.array(b) + random.normal(0, 2, 4), next(score), 0) for b, _ in bodies for _ in range(random.integers(0, 3))]
        images.append((found(*near, (np.array([0, 0, 20, 20.0]), next(score), 0)), bodies))
    table = scored(images).table()[0]
    for least, value in zip(OVERLAPS, table):
        assert value == pytest.approx(slow_average_precision(images, least), abs=1e-9)


def test_detections_that_do_not_count_change_nothing():
    hits, scores = np.array([1, 0, -1, 1]), np.array([0.9, 0.8, 0.7, 0.6])
    assert average_precision(hits, scores, 3) == average_precision(hits[hits >= 0], scores[hits >= 0], 3)


def test_image_that_counts_twice_is_as_if_it_were_there_twice():
    random = np.random.default_rng(7)
    images = []
    for _ in range(6):
        corner = random.uniform(0, 50, 2)
        body = tuple(np.concatenate([corner, corner + 20]))
        images.append((found((np.array(body) + random.normal(0, 2, 4), random.random(), 0),
                             (np.array([0, 0, 20, 20.0]), random.random(), 0)), [(body, 0)]))
    weights = np.array([2, 0, 1, 1, 3, 0])
    repeated = [image for image, times in zip(images, weights) for _ in range(times)]
    assert scored(images).summary(image_weights=weights) == pytest.approx(scored(repeated).summary())


def interval(images, scenes):
    scorer = scored(images)
    (low, high), _ = scorer.intervals(scenes)
    assert low < scorer.summary()[0] < high
    return high - low


def test_interval_narrows_with_more_images_but_not_with_more_of_the_same():
    hit, miss = (found((BODY, 0.9, 0)), [(BODY, 0)]), (found(), [(BODY, 0)])
    few = interval([hit, miss] * 5, range(10))
    assert interval([hit, miss] * 80, range(160)) == pytest.approx(few / 4, rel=0.3)  # by the square root of their number
    assert interval([hit, miss] * 80, [i % 10 for i in range(160)]) == pytest.approx(few, rel=0.3)
