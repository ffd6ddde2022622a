"""labelme_to_yolo: boxes of hand-made labels, and what is said of faulty ones."""
import base64
import json

import cv2
import numpy
import pytest
import yaml

from conftest import rosrun

WIDTH, HEIGHT = 200, 100


def shape(label, points, kind="rectangle"):
    return {"label": label, "points": points, "shape_type": kind}


def write(folder, name, shapes, **more):
    """A picture and its labels."""
    folder.mkdir(exist_ok=True)
    cv2.imwrite(str(folder / f"{name}.png"), numpy.full((HEIGHT, WIDTH, 3), 90, numpy.uint8))
    document = {"shapes": shapes, "imagePath": f"{name}.png", "imageData": None, "imageWidth": WIDTH, "imageHeight": HEIGHT}
    (folder / f"{name}.json").write_text(json.dumps({**document, **more}))


def convert(tmp_path, *more):
    done = rosrun("labelme_to_yolo", tmp_path / "in", tmp_path / "out", *more)
    assert done.returncode == 0, done.stderr
    return done.stdout


def label(tmp_path, name, split="train"):
    return [[float(word) for word in line.split()] for line in (tmp_path / f"out/labels/{split}/{name}.txt").read_text().splitlines()]


def test_boxes_are_shares_of_the_picture(tmp_path):
    write(tmp_path / "in", "a", [shape("boat", [[120, 80], [20, 30]]),  # dragged from below
                                 shape("ball", [[0, 0], [40, 10], [20, 50]], "polygon")])
    convert(tmp_path, "--test-share", "0")
    assert label(tmp_path, "a") == [[1, 0.35, 0.55, 0.5, 0.5], [10, 0.1, 0.25, 0.2, 0.5]]
    image = cv2.imread(str(tmp_path / "out/images/train/a.jpg"))
    assert image.shape == (HEIGHT, WIDTH, 3) and abs(int(image[50, 50, 0]) - 90) <= 2


def test_a_picture_without_shapes_has_an_empty_label_file(tmp_path):
    write(tmp_path / "in", "a", [])
    convert(tmp_path, "--test-share", "0")
    assert label(tmp_path, "a") == []


def test_a_picture_inside_the_labels_is_taken(tmp_path):
    write(tmp_path / "in", "a", [shape("car", [[0, 0], [200, 100]])])
    content = (tmp_path / "in/a.png").read_bytes()
    write(tmp_path / "in", "a", [shape("car", [[0, 0], [200, 100]])], imageData=base64.b64encode(content).decode())
    (tmp_path / "in/a.png").unlink()
    convert(tmp_path, "--test-share", "0")
    assert label(tmp_path, "a") == [[4, 0.5, 0.5, 1, 1]]


@pytest.mark.parametrize("count, tests", [(10, 1), (25, 2), (1, 0)])
def test_a_tenth_is_kept_for_tests_and_follows_from_the_seed(tmp_path, count, tests):
    for i in range(count):
        write(tmp_path / "in", f"p{i:02d}", [shape("car", [[1, 1], [9, 9]])])
    kept = []
    for out in ("1", "1", "2"):
        convert(tmp_path, "--seed", out)
        folder = tmp_path / "out/labels"
        sets = [sorted(file.name for file in (folder / name).glob("*.txt")) for name in ("train", "val")]
        assert len(sets[1]) == tests and len(set(sets[0] + sets[1])) == count
        kept.append(sets[1])
        (tmp_path / "out").rename(tmp_path / f"out{len(kept)}")
    assert kept[0] == kept[1] and (count < 25 or kept[1] != kept[2])
    assert yaml.safe_load((tmp_path / "out1/data.yaml").read_text())["names"][0] == "cage"


FAULTS = {  # what stands in the file: what is said
    "unknown label": ([shape("bota", [[1, 1], [9, 9]])], {}, "a.json: shapes[0]: the label 'bota' is none of cage, boat"),
    "empty polygon": ([shape("boat", [], "polygon")], {}, "shapes[0]: a polygon of 0 points"),
    "polygon of two points": ([shape("boat", [[1, 1], [9, 9]], "polygon")], {}, "a polygon of 2 points"),
    "flat polygon": ([shape("boat", [[1, 1], [5, 1], [9, 1]], "polygon")], {}, "has no area"),
    "rectangle of one point": ([shape("boat", [[1, 1]])], {}, "a rectangle of 1 points"),
    "no number": ([shape("boat", [[1, float("nan")], [9, 9]])], {}, "is no number"),
    "circle": ([shape("boat", [[1, 1], [9, 9]], "circle")], {}, "is a circle"),
    "outside": ([shape("boat", [[1, 1], [201, 9]])], {}, "leaves the picture of 200 x 100"),
    "no picture": ([], {"imagePath": "b.png"}, "b.png is not there"),
    "another size": ([], {"imageWidth": 100}, "is for a picture of 100 x 100 pixels"),
    "no shapes": (None, {}, "a.json"),
    "shapes that are a table": ({"label": "boat"}, {}, "a.json: is not LabelMe's: its shapes are no list"),
    "a shape that is text": (["boat"], {}, "shapes[0]: is no shape"),
    "points that are text": ([shape("boat", "here")], {}, "shapes[0]: has points that are no pairs of numbers"),
    "ragged points": ([shape("boat", [[1, 1], [9]])], {}, "shapes[0]: has points that are no pairs of numbers"),
    "no picture inside": ([], {"imagePath": "b.png", "imageData": "%%%"}, "a.json: its imageData is no picture"),
}


@pytest.mark.parametrize("what", FAULTS)
def test_a_fault_is_named_and_nothing_is_written(what, tmp_path):
    shapes, more, said = FAULTS[what]
    write(tmp_path / "in", "a", shapes, **more)
    write(tmp_path / "in", "good", [shape("boat", [[1, 1], [9, 9]])])
    done = rosrun("labelme_to_yolo", tmp_path / "in", tmp_path / "out")
    assert done.returncode != 0 and said in done.stderr and "good.json" not in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("kept, said", [(0, "cannot be read"), (-40, "is cut short")])
def test_a_damaged_picture_is_named(tmp_path, kept, said):
    write(tmp_path / "in", "a", [], imagePath="a.jpg")
    content = cv2.imencode(".jpg", numpy.random.default_rng(0).integers(0, 255, (HEIGHT, WIDTH, 3), numpy.uint8))[1].tobytes()
    (tmp_path / "in/a.jpg").write_bytes(content[:kept])
    done = rosrun("labelme_to_yolo", tmp_path / "in", tmp_path / "out")
    assert done.returncode != 0 and said in done.stderr and "a.jpg" in done.stderr and "Traceback" not in done.stderr


def test_a_share_that_leaves_nothing_to_train_with_is_refused(tmp_path):
    write(tmp_path / "in", "a", [])
    done = rosrun("labelme_to_yolo", tmp_path / "in", tmp_path / "out", "--test-share", "0.9")
    assert done.returncode != 0 and "none to train with" in done.stderr and not (tmp_path / "out").exists()


def test_a_folder_that_is_in_use_is_refused(tmp_path):
    for name in "ab":
        write(tmp_path / "in", name, [shape("boat", [[1, 1], [9, 9]])])
    convert(tmp_path)
    before = sorted((tmp_path / "out").rglob("*"))
    done = rosrun("labelme_to_yolo", tmp_path / "in", tmp_path / "out", "--seed", "2")
    assert done.returncode != 0 and "holds pictures already" in done.stderr
    assert sorted((tmp_path / "out").rglob("*")) == before and sum(file.suffix == ".txt" for file in before) == 2
    assert len(list((tmp_path / "out/labels/val").iterdir())) == 1, "one to test with, where there are two"


@pytest.mark.parametrize("text", ["names: 5", "just words", "names: {0: a}", "names: [", None])
def test_classes_that_are_none_are_told(text, tmp_path):
    write(tmp_path / "in", "a", [])
    file = tmp_path / "classes.yaml"
    if text is not None:
        file.write_text(text)
    done = rosrun("labelme_to_yolo", tmp_path / "in", tmp_path / "out", "--classes", file)
    assert done.returncode != 0 and f"{file} is no YAML file with a list `names`" in done.stderr


def test_a_folder_without_labels_is_told(tmp_path):
    done = rosrun("labelme_to_yolo", tmp_path, tmp_path / "out")
    assert done.returncode != 0 and "no *.json" in done.stderr
