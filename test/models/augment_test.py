"""Augmented samples: where the boxes are, the bodies are."""
import cv2
import numpy as np
import pytest

from yolov8.augment import Augmentation, augmented, cut, letterboxed, mirrored, recoloured
from yolov8.dataset import GREY, Sample

SIZE = (160, 96)
COLOURS = [(255, 0, 0), (0, 255, 0), (0, 0, 255)]


class OneBodyEach:
    """Black images with one body of a colour of its own, which is its class."""

    size = SIZE

    def __init__(self, sides=((160, 90), (128, 96), (160, 90))):
        self.samples = []
        for index, (width, height) in enumerate(sides):
            image = np.zeros((height, width, 3), np.uint8)
            box = [20 + 30 * index, 15, 60 + 30 * index, 70]
            image[box[1]:box[3], box[0]:box[2]] = COLOURS[index]
            self.samples.append(Sample(image, np.float32([box]), np.array([index])))

    def __len__(self):
        return len(self.samples)


def extent(mask):
    ys, xs = np.nonzero(mask)
    return [xs.min(), ys.min(), xs.max() + 1, ys.max() + 1]


def coloured(image, class_):
    """Pixels that are more than half of this body's colour."""
    other = np.delete(image, class_ % 3, 2).max(2)
    return (image[:, :, class_] > 127) & (other < 100)


@pytest.mark.parametrize("seed", range(12))
def test_one_image_shifted_and_scaled(seed):
    settings = Augmentation(mosaic=0, hue=0, saturation=0, value=0)
    sample = augmented(OneBodyEach(), 1, settings, np.random.default_rng(seed))
    assert sample.image.shape == (96, 160, 3) and sample.image.dtype == np.uint8
    mask = coloured(sample.image, 1)
    assert len(sample.boxes) == mask.any()
    if len(sample.boxes):
        np.testing.assert_allclose(sample.boxes[0], extent(mask), atol=1)


@pytest.mark.parametrize("seed", range(12))
def test_boxes_of_a_mosaic_are_full_of_their_bodies(seed):
    settings = Augmentation(hue=0, saturation=0, value=0)
    sample = augmented(OneBodyEach(), seed % 3, settings, np.random.default_rng(seed))
    for box, class_ in zip(np.round(sample.boxes).astype(int), sample.classes):
        assert coloured(sample.image, class_)[box[1] + 1:box[3] - 1, box[0] + 1:box[2] - 1].all()


@pytest.mark.parametrize("seed", range(12))
def test_bodies_of_a_mosaic_have_boxes_unless_little_is_left(seed):
    settings = Augmentation(scale=0, hue=0, saturation=0, value=0)
    sample = augmented(OneBodyEach(), seed % 3, settings, np.random.default_rng(seed))
    left = [coloured(sample.image, c).astype(np.uint8) for c in range(3)]
    for box, class_ in zip(np.round(sample.boxes).astype(int), sample.classes):
        left[class_][max(0, box[1] - 1):box[3] + 1, max(0, box[0] - 1):box[2] + 1] = 0
    for mask in left:
        for x, y, width, height, area in cv2.connectedComponentsWithStats(mask)[2][1:]:
            assert min(width, height) <= 3 or area <= 0.2 * 40 * 55


def test_mosaic_is_made_of_four_images():
    sample = augmented(OneBodyEach(), 0, Augmentation(scale=0, shift=0, mirror=0), np.random.default_rng(5))
    assert (sample.image == 0).all(2).mean() > 0.4  # black backgrounds meet; the rest is bodies and grey


def test_same_seed_same_sample():
    a, b = (augmented(OneBodyEach(), 0, Augmentation(), np.random.default_rng(3)) for _ in range(2))
    assert np.array_equal(a.image, b.image) and np.array_equal(a.boxes, b.boxes)


@pytest.mark.parametrize("seed", range(12))
def test_cutting_has_a_body_and_its_box(seed):
    settings = Augmentation(hue=0, saturation=0, value=0, window=0.5)
    sample = augmented(OneBodyEach(), 1, settings, np.random.default_rng(seed))
    assert sample.image.shape == (32, 64, 3)  # 48 x 80 in whole multiples of 32
    mask = coloured(sample.image, 1)
    assert mask.any()
    if len(sample.boxes):  # else less than a fifth of it is left
        np.testing.assert_allclose(sample.boxes[0], extent(mask), atol=1)
    else:
        assert mask.sum() < 0.2 * 40 * 55 * 1.25 ** 2


def test_most_cuttings_have_a_box():
    settings = Augmentation(window=0.5)
    boxes = [len(augmented(OneBodyEach(), 1, settings, np.random.default_rng(seed)).boxes) for seed in range(100)]
    assert sum(boxes) > 80


def test_mirrored_box_is_mirrored():
    sample = mirrored(OneBodyEach().samples[0])
    np.testing.assert_allclose(sample.boxes, [[100, 15, 140, 70]])
    assert extent(coloured(sample.image, 0)) == [100, 15, 140, 70]


def test_letterbox_is_grey_and_centred():
    sample = letterboxed(OneBodyEach().samples[1], SIZE)  # 128 x 96 in 160 x 96
    assert (sample.image[:, :16] == GREY).all() and (sample.image[:, 144:] == GREY).all()
    np.testing.assert_allclose(sample.boxes, [[66, 15, 106, 70]])
    assert extent(coloured(sample.image, 1)) == [66, 15, 106, 70]


def test_no_bodies_anywhere():
    data = OneBodyEach()
    for sample in data.samples:
        sample.boxes, sample.classes = np.zeros((0, 4), np.float32), np.zeros(0, np.int64)
    for settings in (Augmentation(), Augmentation(mosaic=0), Augmentation(window=0.5)):
        assert augmented(data, 0, settings, np.random.default_rng(0)).boxes.shape == (0, 4)


@pytest.mark.parametrize("box, kept", [
    ((10, 10, 20, 20), [10, 10, 20, 20]),     # inside
    ((-10, 10, 10, 20), [0, 10, 10, 20]),     # half of it
    ((-30, 10, 7, 20), None),                 # less than a fifth
    ((-2, 10, 2.5, 20), None),                # 2.5 px wide, though half of it
    ((10, 10, 12, 12), [10, 10, 12, 12]),     # small, but whole
    ((200, 200, 210, 210), None),
])
def test_cut(box, kept):
    boxes, classes = cut(np.float32([box]), np.array([4]), (0, 0, 100, 100))
    assert boxes.tolist() == ([] if kept is None else [kept]) and len(classes) == len(boxes)


def test_colours_without_strength_stay():
    image = np.random.default_rng(0).integers(0, 256, (8, 8, 3), dtype=np.uint8)
    same = recoloured(image, Augmentation(hue=0, saturation=0, value=0), np.random.default_rng(1))
    assert np.abs(same.astype(int) - image).max() <= 6  # 8-bit hue, saturation and value round
