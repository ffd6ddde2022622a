"""models/prepare_onnx.py on networks with the head of a stock export, which OpenCV 4.6 refuses."""
import subprocess
import sys

import numpy as np
import pytest

from conftest import ROOT

cv2 = pytest.importorskip("cv2", reason="python3-opencv is not installed")
onnx = pytest.importorskip("onnx", reason="python3-onnx is not installed")
from onnx import TensorProto, helper, numpy_helper  # noqa: E402

ANCHORS = 21
IMAGE = np.random.default_rng(2).uniform(0, 1, (1, 3, 32, 32)).astype(np.float32)
WEIGHTS = {name: np.random.default_rng(1).uniform(1, 9, shape).astype(np.float32) for name, shape in {
    "weight": (4 * ANCHORS, 3, 1, 1), "bias": (4 * ANCHORS,), "anchors": (1, 2, ANCHORS), "strides": (1, ANCHORS)}.items()}


def network(nodes, **constants):
    """Distances 1x4xN from the mean colour, cut in two by `nodes`, then boxes as a stock head makes them."""
    make = helper.make_node
    body = [make("GlobalAveragePool", ["images"], ["mean"], name="mean"),
            make("Conv", ["mean", "weight", "bias"], ["flat"], name="conv", kernel_shape=[1, 1]),
            make("Reshape", ["flat", "shape"], ["box"], name="reshape"), *nodes,
            make("Sub", ["anchors", "lt"], ["x1y1"], name="/model.22/Sub"),
            make("Add", ["anchors", "rb"], ["x2y2"], name="/model.22/Add_1"),
            make("Concat", ["x1y1", "x2y2"], ["boxes"], name="/model.22/Concat", axis=1),
            make("Mul", ["boxes", "strides"], ["output0"], name="/model.22/Mul_2")]
    values = {**WEIGHTS, "shape": np.array([1, 4, ANCHORS]), **{k: np.array(v, np.int64) for k, v in constants.items()}}
    graph = helper.make_graph(
        body, "head", [helper.make_tensor_value_info("images", TensorProto.FLOAT, [1, 3, 32, 32])],
        [helper.make_tensor_value_info("output0", TensorProto.FLOAT, [1, 4, ANCHORS])],
        [numpy_helper.from_array(value, name) for name, value in values.items()])
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 12)])
    model.ir_version = 7
    return model


def simplified():
    return network([helper.make_node("Split", ["box"], ["lt", "rb"], name="/model.22/Split", axis=1, split=[2, 2])])


def as_exported():
    make = helper.make_node
    return network(
        [make("Shape", ["box"], ["dims"], name="/model.22/Shape"),
         make("Gather", ["dims", "one"], ["rows"], name="/model.22/Gather", axis=0),
         make("Add", ["rows", "one"], ["rows1"], name="/model.22/Add"),
         make("Div", ["rows1", "two"], ["half"], name="/model.22/Div"),
         make("Mul", ["half", "one"], ["middle"], name="/model.22/Mul"),
         make("Slice", ["box", "zero", "middle", "one"], ["lt"], name="/model.22/Slice"),
         make("Mul", ["half", "two"], ["end"], name="/model.22/Mul_1"),
         make("Slice", ["box", "middle", "end", "one"], ["rb"], name="/model.22/Slice_1")],
        zero=[0], one=[1], two=[2])


def by_hand():
    mean = IMAGE.mean(axis=(2, 3))[0]
    box = (WEIGHTS["weight"][:, :, 0, 0] @ mean + WEIGHTS["bias"]).reshape(1, 4, ANCHORS)
    corners = np.concatenate([WEIGHTS["anchors"] - box[:, :2], WEIGHTS["anchors"] + box[:, 2:]], axis=1)
    return corners * WEIGHTS["strides"]


def by_opencv(path):
    net = cv2.dnn.readNetFromONNX(str(path))
    net.setInput(IMAGE)
    return net.forward()


def prepared(path):
    out = path.with_name("mended.onnx")
    done = subprocess.run([sys.executable, str(ROOT / "models/prepare_onnx.py"), str(path), str(out)],
                          text=True, capture_output=True)
    assert done.returncode == 0, done.stderr
    return out, done.stdout


@pytest.mark.parametrize("make, node", [(simplified, "/model.22/Mul_2"), (as_exported, "/model.22/Add")])
def test_mended_file_gives_what_the_network_means(make, node, tmp_path):
    path = tmp_path / "model.onnx"
    onnx.save(make(), str(path))
    if cv2.__version__.startswith("4.6."):
        with pytest.raises(cv2.error):
            by_opencv(path)
    mended, said = prepared(path)
    assert node in said.split()
    np.testing.assert_allclose(by_opencv(mended), by_hand(), rtol=1e-4)


def test_mended_file_needs_no_mending(tmp_path):
    path = tmp_path / "model.onnx"
    onnx.save(as_exported(), str(path))
    assert "0 nodes mended" in prepared(prepared(path)[0])[1]


def test_file_that_is_no_network_is_named(tmp_path):
    (tmp_path / "notes.onnx").write_text("not a network")
    done = subprocess.run([sys.executable, ROOT / "models/prepare_onnx.py", tmp_path / "notes.onnx", tmp_path / "out.onnx"],
                          text=True, stderr=subprocess.PIPE)
    assert done.returncode == 1 and "notes.onnx" in done.stderr and "Traceback" not in done.stderr
    assert not (tmp_path / "out.onnx").exists()


def test_output_that_cannot_be_written_is_named(tmp_path):
    onnx.save(as_exported(), str(tmp_path / "model.onnx"))
    done = subprocess.run([sys.executable, ROOT / "models/prepare_onnx.py", tmp_path / "model.onnx", tmp_path / "no/out.onnx"],
                          text=True, stderr=subprocess.PIPE)
    assert done.returncode == 1 and "no/out.onnx cannot be written" in done.stderr and "Traceback" not in done.stderr
