"""Labels of photographs as the trainings' label files."""
import json
import subprocess
import sys

import cv2
import numpy as np
import pytest

from conftest import ROOT
from yolov8.dataset import Dataset


def run(*arguments):
    return subprocess.run([sys.executable, ROOT / "models/real_images.py", *map(str, arguments)], text=True, timeout=60,
                          capture_output=True)


@pytest.fixture
def photographs(tmp_path):
    """A frame of KITTI's, 100 x 50, with a car, a walker and a truck, and a bus.jpg with one person."""
    for folder in ("kitti_object/image_2", "kitti_object/label_2", "yolov8n_coco"):
        (tmp_path / folder).mkdir(parents=True)
    cv2.imwrite(str(tmp_path / "kitti_object/image_2/000000.png"), np.zeros((50, 100, 3), np.uint8))
    rest = "1 1 1 0 0 10 0"
    (tmp_path / "kitti_object/label_2/000000.txt").write_text(
        f"Car 0 0 0 10 20 30 40 {rest}\nPedestrian 0 0 0 50 0 60 25 {rest}\nTruck 0 0 0 1 1 2 2 {rest}\n")
    cv2.imwrite(str(tmp_path / "yolov8n_coco/bus.jpg"), np.zeros((80, 40, 3), np.uint8))
    found = [{"class_name": "person", "box_xyxy": [0, 0, 20, 40]}, {"class_name": "bus", "box_xyxy": [0, 0, 40, 80]}]
    (tmp_path / "yolov8n_coco/bus_reference.json").write_text(json.dumps([{"image": "bus.jpg", "detections": found}]))
    return tmp_path


def test_bodies_of_known_classes_keep_their_boxes(photographs, tmp_path):
    done = run(tmp_path / "out", "--data", photographs)
    assert done.returncode == 0, done.stderr
    data = Dataset(tmp_path / "out", "real", (100, 100))
    assert data.names == ["person", "car"]
    frame, bus = data.samples
    assert frame.classes.tolist() == [1, 0]
    np.testing.assert_allclose(frame.boxes, [[10, 20, 30, 40], [50, 0, 60, 25]], atol=1e-3)
    assert bus.classes.tolist() == [0]
    np.testing.assert_allclose(bus.boxes, [[0, 0, 25, 50]], atol=1e-3)  # of an image scaled by 100 / 80


def test_what_is_missing_is_named(photographs, tmp_path):
    (photographs / "kitti_object/image_2/000000.png").unlink()
    done = run(tmp_path / "out", "--data", photographs)
    assert done.returncode == 1 and "000000.png" in done.stderr and "Traceback" not in done.stderr
