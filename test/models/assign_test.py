"""Task-aligned assignment against the rule written out body by body and cell by cell."""
import pytest
import torch

from yolov8.assign import assign
from yolov8.boxes import cell_centres, iou

MAPS = [torch.zeros(1, 1, 8, 8), torch.zeros(1, 1, 4, 4), torch.zeros(1, 1, 2, 2)]  # of 64 x 64 px
CENTRES, STRIDES = cell_centres(MAPS)
CELLS = len(CENTRES)


def slow_assignment(boxes, classes, images, predicted, scores):
    """{(image, cell): (body, score)}"""
    claims = {}  # (image, cell): [(overlap, metric, body)]
    for body, (box, c, image) in enumerate(zip(boxes, classes, images)):
        inside = [a for a in range(CELLS)
                  if box[0] < CENTRES[a, 0] < box[2] and box[1] < CENTRES[a, 1] < box[3]]
        rated = []
        for a in inside:
            overlap = iou(predicted[image, a], box).item()
            rated.append((scores[image, a, c].item() ** 0.5 * overlap ** 6, a, overlap))
        for metric, a, overlap in sorted(rated, reverse=True)[:10]:
            if metric > 0:
                claims.setdefault((int(image), a), []).append((overlap, metric, body))
    won = {place: max(rivals) for place, rivals in claims.items()}
    result = {}
    for place, (overlap, metric, body) in won.items():
        own = [w for w in won.values() if w[2] == body]
        result[place] = body, metric * max(w[0] for w in own) / max(w[1] for w in own)
    return result


def fast_assignment(boxes, classes, images, predicted, scores):
    found = assign(boxes, classes, images, predicted, scores, CENTRES)
    places = list(zip(found.image.tolist(), found.cell.tolist()))
    assert len(set(places)) == len(places)
    return dict(zip(places, zip(found.body.tolist(), found.score.tolist())))


def scene(seed, images, bodies):
    """Random bodies, and predictions near them: of the body whose turn it is, moved about."""
    random = torch.Generator().manual_seed(seed)
    corner, side = torch.rand(bodies, 2, generator=random) * 40, torch.rand(bodies, 2, generator=random) * 30 + 9
    boxes = torch.cat([corner, corner + side], 1)
    owners = torch.randint(images, (bodies,), generator=random)
    classes = torch.randint(3, (bodies,), generator=random)
    near = boxes[torch.randint(bodies, (images, CELLS), generator=random)]
    noise = (torch.rand(images, CELLS, 4, generator=random) - 0.5) * 20
    return boxes, classes, owners, near + noise, torch.rand(images, CELLS, 3, generator=random)


@pytest.mark.parametrize("seed", range(6))
def test_assignment_is_the_rule(seed):
    case = scene(seed, images=1 + seed % 3, bodies=1 + 3 * seed)
    expected, found = slow_assignment(*case), fast_assignment(*case)
    assert {place: body for place, (body, _) in found.items()} == {place: body for place, (body, _) in expected.items()}
    for place in expected:
        assert found[place][1] == pytest.approx(expected[place][1], rel=1e-4)


def one_body(box, predicted_box=None, score=0.25):
    predicted = torch.tensor(predicted_box or box).float().expand(1, CELLS, 4)
    return fast_assignment(torch.tensor([box]).float(), torch.tensor([0]), torch.tensor([0]), predicted,
                           torch.full((1, CELLS, 2), score))


def test_body_has_ten_cells_at_most_and_their_centres_lie_inside():
    found = one_body([0, 0, 64, 64])
    assert len(found) == 10
    found = one_body([4, 4, 24, 24])  # of 8 px: centres at 12 and 20 both ways; of 16 px: at 8; of 32 px: at 16
    assert len(found) == 4 + 1 + 1
    assert all(4 < x < 24 and 4 < y < 24 for x, y in CENTRES[[cell for _, cell in found]].tolist())


def test_best_cell_shall_score_its_overlap():
    found = one_body([0, 0, 32, 32], predicted_box=[0, 0, 32, 16])
    assert [score for _, score in found.values()] == pytest.approx([0.5] * 10)


def test_body_between_the_centres_of_all_cells_is_not_lost():
    found = one_body([29, 29, 34, 35])  # nearest centres of 8 px cells: 28 and 36
    assert found and all(STRIDES[cell] == 8 for _, cell in found)


def test_prediction_far_off_assigns_nothing():
    assert one_body([0, 0, 16, 16], predicted_box=[40, 40, 60, 60]) == {}


def test_faint_score_and_small_overlap_still_assign():
    assert len(one_body([0, 0, 12, 12], predicted_box=[0, 0, 63, 63], score=1e-5)) > 0


def test_no_bodies():
    found = assign(torch.zeros(0, 4), torch.zeros(0, dtype=torch.long), torch.zeros(0, dtype=torch.long),
                   torch.zeros(2, CELLS, 4), torch.zeros(2, CELLS, 3), CENTRES)
    assert len(found.cell) == len(found.score) == 0
