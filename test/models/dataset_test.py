"""Reading of a labelled folder: what is taken, and what is refused with which words."""
import cv2
import numpy as np
import pytest

from shapes import write_dataset
from yolov8.dataset import DataError, Dataset, class_names, fitted_size, read_labels


@pytest.fixture
def folder(tmp_path):
    return write_dataset(tmp_path / "data", {"train": 2}, (96, 64))


def label(folder):
    return folder / "labels/train/000.txt"


def test_boxes_are_in_pixels_of_the_scaled_image(folder):
    label(folder).write_text("2 0.5 0.25 0.5 0.5\n")
    data = Dataset(folder, "train", (48, 64))  # halves the width, so the height too
    assert data.samples[0].image.shape == (32, 48, 3) and data.original_sizes[0] == (96, 64)
    np.testing.assert_allclose(data.samples[0].boxes, [[12, 0, 36, 16]])
    assert data.samples[0].classes.tolist() == [2]


def test_image_of_nothing_has_an_empty_file(folder):
    label(folder).write_text("\n")
    sample = Dataset(folder, "train", (96, 64)).samples[0]
    assert sample.boxes.shape == (0, 4) and sample.classes.shape == (0,)


@pytest.mark.parametrize("image, size, expected", [
    ((640, 360), (640, 384), (640, 360)), ((1280, 720), (640, 640), (640, 360)), ((810, 1080), (640, 640), (480, 640)),
    ((3, 1000), (32, 32), (1, 32)),   # no side becomes 0
    ((5, 10), (32, 5), (2, 5)),       # 2.5: to the even number, as the `detect` stage rounds
])
def test_fitted_size_is_that_of_the_detect_stage(image, size, expected):
    assert fitted_size(*image, size) == expected


@pytest.mark.parametrize("text, words", [
    ("0 0.5 0.5 0.5", "not five numbers"), ("0 0.5 0.5 0.5 x", "not five numbers"), ("0 0.5 nan 0.5 0.5", "not five numbers"),
    ("0 0.5 0.5 0.5 inf", "not five numbers"), ("3 0.5 0.5 0.1 0.1", "class 3, but there are 3"), ("-1 0.5 0.5 0.1 0.1", "class -1"),
    ("0.5 0.5 0.5 0.1 0.1", "class 0.5"), ("1 1.5 0.5 0.1 0.1", "not within 0..1"), ("1 0.5 0.5 0 0.1", "no area"),
])
def test_bad_label_is_named_with_its_line(tmp_path, text, words):
    path = tmp_path / "a.txt"
    path.write_text("0 0.5 0.5 0.1 0.1\n" + text + "\n")
    with pytest.raises(DataError) as fault:
        read_labels(path, 3)
    assert f"{path}:2:" in str(fault.value) and words in str(fault.value)


@pytest.mark.parametrize("text", ["names: [a, b]", "names: {1: b, 0: a}", "path: .\nnames:\n  - a\n  - b\n"])
def test_names_are_a_list_or_numbered(tmp_path, text):
    (tmp_path / "data.yaml").write_text(text)
    assert class_names(tmp_path) == ["a", "b"]


@pytest.mark.parametrize("text", ["", "names: []", "classes: [a]", "names: {0: a, 2: b}", "names: [1, 2]", "a: [", "names: 5",
                                  "names: {0: a, x: b}", "names: [a, a]"])
def test_bad_names_are_refused(tmp_path, text):
    (tmp_path / "data.yaml").write_text(text)
    with pytest.raises(DataError, match="data.yaml"):
        class_names(tmp_path)


def test_missing_names_splits_labels_and_images_are_named(folder):
    with pytest.raises(DataError, match="images/val: no images"):
        Dataset(folder, "val", (96, 64))
    cv2.imwrite(str(folder / "images/train/extra.png"), np.zeros((8, 8, 3), np.uint8))
    with pytest.raises(DataError, match="labels/train/extra.txt: no such file"):
        Dataset(folder, "train", (96, 64))
    (folder / "labels/train/extra.txt").write_text("")
    (folder / "images/train/extra.png").write_bytes(b"no image")
    with pytest.raises(DataError, match="extra.png: cannot be read"):
        Dataset(folder, "train", (96, 64))
    (folder / "images/train/extra.png").unlink()
    whole = cv2.imencode(".jpg", np.random.default_rng(0).integers(0, 255, (64, 96, 3), np.uint8))[1].tobytes()
    (folder / "images/train/extra.jpg").write_bytes(whole + b"\0" * 100)  # some cameras write more behind the end
    assert len(Dataset(folder, "train", (96, 64))) == 3
    (folder / "images/train/extra.jpg").write_bytes(whole[:-40])
    with pytest.raises(DataError, match="extra.jpg: is cut short"):
        Dataset(folder, "train", (96, 64))
    (folder / "images/train/extra.jpg").write_bytes(b"")
    with pytest.raises(DataError, match="extra.jpg: cannot be read"):
        Dataset(folder, "train", (96, 64))
    (folder / "images/train/extra.jpg").write_bytes(whole)
    (folder / "labels/train/extra.txt").write_bytes(b"0 0.5 0.5 0.1 0.1 \xff\n")
    with pytest.raises(DataError, match="extra.txt: is no text"):
        Dataset(folder, "train", (96, 64))
    (folder / "data.yaml").unlink()
    with pytest.raises(DataError, match="data.yaml"):
        Dataset(folder, "train", (96, 64))
