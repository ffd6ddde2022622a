"""The exported file: it computes what the network does, in every backend at hand."""
import os
import pathlib
import subprocess

import cv2
import numpy as np
import pytest
import torch

from yolov8.export import export, folded
from yolov8.network import YoloV8
from yolov8.onnx_weights import unfolded

onnx = pytest.importorskip("onnx", reason="python3-onnx is not installed")

SIZE, NAMES = (96, 64), ["boat", "buoy's", "cage"]
OPENVINO = pathlib.Path(os.environ.get("XDG_DATA_HOME", pathlib.Path.home() / ".local/share")) / "field_fusion/openvino/bin/python3"
SCRIPT = """
import sys, numpy, openvino
core = openvino.Core()
model = core.compile_model(core.read_model(sys.argv[1]), "CPU", {"INFERENCE_PRECISION_HINT": "f32"})
result = model(numpy.load(sys.argv[2]))
numpy.savez(sys.argv[3], *[result[output] for output in model.outputs])
"""


def as_if_trained(seed=0):
    """Weights, means and variances all different, as training leaves them."""
    torch.manual_seed(seed)
    network = YoloV8(len(NAMES), width=0.125).eval()
    for name, value in network.state_dict().items():
        if value.is_floating_point() and ("norm" in name or "bias" in name):
            value.add_(torch.rand_like(value) * 0.3)
    return network


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    network, path = as_if_trained(), tmp_path_factory.mktemp("model") / "detector.onnx"
    export(network, NAMES, SIZE, path, {"license": "BSD-3-Clause"})
    image = np.random.default_rng(1).uniform(0, 1, (1, 3, SIZE[1], SIZE[0])).astype(np.float32)
    with torch.no_grad():
        maps = [m.numpy() for m in network(torch.from_numpy(image))]
    return path, image, {m.shape: m for m in maps}


def check(outputs, expected):
    assert {o.shape for o in outputs} == set(expected)
    for output in outputs:
        np.testing.assert_allclose(output, expected[output.shape], atol=1e-4)


def test_folded_network_computes_the_same():
    network, image = as_if_trained(), torch.rand(2, 3, 64, 96)
    copy = folded(network)
    assert not any(isinstance(m, torch.nn.BatchNorm2d) for m in copy.modules())
    with torch.no_grad():
        for a, b in zip(network(image), copy(image)):
            torch.testing.assert_close(a, b, atol=1e-4, rtol=1e-4)


def test_outputs_in_opencv(exported):
    path, image, expected = exported
    net = cv2.dnn.readNetFromONNX(str(path))
    net.setInput(image)
    check(net.forward(net.getUnconnectedOutLayersNames()), expected)


@pytest.mark.skipif(not OPENVINO.exists(), reason="OpenVINO is not installed")
def test_outputs_in_openvino(exported, tmp_path):
    path, image, expected = exported
    np.save(tmp_path / "image.npy", image)
    subprocess.run([OPENVINO, "-c", SCRIPT, path, tmp_path / "image.npy", tmp_path / "out.npz"], check=True)
    check(list(np.load(tmp_path / "out.npz").values()), expected)


def test_file_has_what_the_detect_stage_reads(exported):
    model = onnx.load(str(exported[0]))
    assert [(o.domain, o.version) for o in model.opset_import] == [("", 12)]
    shapes = [[d.dim_value for d in v.type.tensor_type.shape.dim] for v in [*model.graph.input, *model.graph.output]]
    assert shapes == [[1, 3, 64, 96], [1, 67, 8, 12], [1, 67, 4, 6], [1, 67, 2, 3]]
    assert {p.key: p.value for p in model.metadata_props} == {"names": """{0: 'boat', 1: "buoy's", 2: 'cage'}""",
                                                              "license": "BSD-3-Clause"}


def test_file_has_only_operators_that_every_backend_knows(exported):
    used = {node.op_type for node in onnx.load(str(exported[0])).graph.node}
    assert used == {"Conv", "ConvTranspose", "Sigmoid", "Mul", "Add", "MaxPool", "Concat"}


def test_untrained_network_with_its_equal_weights_loads_too(tmp_path):
    export(YoloV8(3, width=0.125).eval(), NAMES, SIZE, tmp_path / "a.onnx", {})
    net = cv2.dnn.readNetFromONNX(str(tmp_path / "a.onnx"))
    net.setInput(np.zeros((1, 3, 64, 96), np.float32))
    assert len(net.forward(net.getUnconnectedOutLayersNames())) == 3


def test_names_that_do_not_fit_are_refused(tmp_path):
    with pytest.raises(ValueError, match="2 names, but the network has 3 classes"):
        export(as_if_trained(), NAMES[:2], SIZE, tmp_path / "a.onnx", {})
    assert not list(tmp_path.iterdir())


def test_weights_of_an_exported_file_are_a_network_that_computes_the_same(exported):
    path, image, expected = exported
    network, names = unfolded(path, torch.rand(4, 3, SIZE[1], SIZE[0]), width=0.125, depth=1 / 3)
    assert names == NAMES and any(isinstance(m, torch.nn.BatchNorm2d) for m in network.modules())
    with torch.no_grad():
        check([m.numpy() for m in network(torch.from_numpy(image))], expected)


def test_its_normalisations_know_the_channels(exported):
    path, images = exported[0], torch.rand(4, 3, SIZE[1], SIZE[0])
    network, _ = unfolded(path, images, width=0.125, depth=1 / 3)
    with torch.no_grad():
        expected = network(images)
        for measured, kept in zip(network.train()(images), expected):  # by the batch's own means and variances
            torch.testing.assert_close(measured, kept, atol=1e-3, rtol=1e-3)


def test_weights_of_another_width_are_refused(exported):
    with pytest.raises(ValueError, match="stem"):
        unfolded(exported[0], torch.rand(1, 3, 64, 96), width=0.25, depth=1 / 3)
