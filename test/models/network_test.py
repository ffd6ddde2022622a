"""The network is YOLOv8: its size, its shapes, and its outputs with the weights of others."""
import json
import os
import pathlib
import subprocess
import sys

import cv2
import numpy as np
import pytest
import torch

from conftest import ROOT
from yolov8.boxes import boxes_of, cell_centres, flattened
from yolov8.dataset import fitted_size
from yolov8.detections import detections_of, in_image
from yolov8.network import BINS, VARIANTS, YoloV8

DATA = os.environ.get("FIELD_FUSION_DATA")
# millions of parameters for 80 classes as published; they count the bins of the distribution
PUBLISHED = {"n": 3157200, "s": 11166560, "m": 25902640, "l": 43691520, "x": 68229648}


@pytest.mark.parametrize("name", PUBLISHED)
def test_parameters_are_as_many_as_published(name):
    depth, width, most = VARIANTS[name]
    network = YoloV8(80, width, depth, most)
    assert sum(p.numel() for p in network.parameters()) + BINS == PUBLISHED[name]


def test_maps_have_the_shapes_that_the_detect_stage_expects():
    maps = YoloV8(5, width=0.125).eval()(torch.zeros(2, 3, 96, 160))
    assert [tuple(m.shape) for m in maps] == [(2, 69, 12, 20), (2, 69, 6, 10), (2, 69, 3, 5)]


def test_detector_without_classes_is_refused():
    with pytest.raises(ValueError, match="0 classes"):
        YoloV8(0)


def letterboxed(path, side=640):
    image = cv2.imread(str(path))
    width, height = fitted_size(image.shape[1], image.shape[0], (side, side))
    canvas = np.full((side, side, 3), 114, np.uint8)
    left, top = (side - width) // 2, (side - height) // 2
    canvas[top:top + height, left:left + width] = cv2.resize(image, (width, height))
    return (canvas[None, :, :, ::-1].transpose(0, 3, 1, 2) / 255).astype(np.float32)


@pytest.fixture(scope="module")
def bus():
    """Folder of the weights and the maps of our network with them, in double precision: in single precision two
    programs that sum in different orders are apart by 2e-3 px."""
    if not DATA:
        pytest.skip("FIELD_FUSION_DATA is not set")
    pytest.importorskip("onnx", reason="python3-onnx is not installed")
    from coco_weights import load

    folder = pathlib.Path(DATA) / "yolov8n_coco"
    image = letterboxed(folder / "bus.jpg")
    with torch.no_grad():
        return folder, image, load(next(folder.glob("*.onnx"))).double()(torch.from_numpy(image).double())


def test_outputs_with_the_coco_weights_are_those_of_their_file(bus, tmp_path):
    folder, image, maps = bus
    path, mended = next(folder.glob("*.onnx")), tmp_path / "mended.onnx"
    subprocess.run([sys.executable, ROOT / "models/prepare_onnx.py", path, mended], check=True, stdout=subprocess.DEVNULL)
    net = cv2.dnn.readNetFromONNX(str(mended))
    net.setInput(image)
    wanted = torch.from_numpy(net.forward()[0].T.astype(np.float64))  # columns x, y, width, height, scores
    distances, scores = flattened(maps)
    corners = boxes_of(distances, *cell_centres(maps))[0]
    found = torch.cat([(corners[:, :2] + corners[:, 2:]) / 2, corners[:, 2:] - corners[:, :2], scores[0].sigmoid()], 1)
    assert wanted[:, 4:].max() > 0.8  # the bus is seen, so zeros would not do
    torch.testing.assert_close(found, wanted, rtol=0, atol=1e-3)


def test_detections_with_the_coco_weights_are_those_of_another_program(bus):
    folder, _, maps = bus
    reference = json.loads((folder / "bus_reference.json").read_text())[0]
    found = detections_of(maps, reference["conf"], reference["nms_iou"])[0]
    found = in_image(found, (810, 1080), (640, 640), (480, 640))
    wanted = reference["detections"]
    assert found.classes.tolist() == [d["class_id"] for d in wanted]
    np.testing.assert_allclose(found.scores, [d["score"] for d in wanted], atol=1e-4)
    np.testing.assert_allclose(found.boxes, [d["box_xyxy"] for d in wanted], atol=0.05)
