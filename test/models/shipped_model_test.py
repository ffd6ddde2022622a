"""The detector that comes with the package."""
import torch
import yaml

from conftest import ROOT
from yolov8.onnx_model import OnnxModel


def test_it_knows_the_classes_in_their_order_and_sees_nothing_where_nothing_is():
    model = OnnxModel(ROOT / "models/usv.onnx")
    assert model.names == yaml.safe_load((ROOT / "models/classes.yaml").read_text())["names"]
    assert model.size == (640, 384)
    assert not len(model(torch.full((1, 3, 384, 640), 114, dtype=torch.uint8), 0.25, 0.45)[0].boxes)
