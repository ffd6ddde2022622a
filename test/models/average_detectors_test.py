"""Two exported detectors as one: every weight lies between theirs."""
import pathlib
import subprocess
import sys

import numpy as np
import pytest
import torch

from yolov8.export import export
from yolov8.network import YoloV8

onnx = pytest.importorskip("onnx", reason="python3-onnx is not installed")
from onnx import numpy_helper  # noqa: E402
from yolov8.onnx_model import OnnxError, OnnxModel  # noqa: E402

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "models/average_detectors.py"


def exported(path, seed, names=("boat", "cage"), width=0.125):
    torch.manual_seed(seed)
    export(YoloV8(len(names), width=width).eval(), list(names), (96, 64), path, {})
    return path


def run(*arguments):
    return subprocess.run([sys.executable, PROGRAM, *map(str, arguments)], text=True, timeout=60, capture_output=True)


def weights(path):
    return {t.name: numpy_helper.to_array(t) for t in onnx.load(str(path)).graph.initializer}


@pytest.mark.parametrize("share, arguments", [(0.5, ()), (0.25, ("--share", "0.25"))])
def test_each_weight_is_the_mean_of_the_two(tmp_path, share, arguments):
    a, b = exported(tmp_path / "a.onnx", 1), exported(tmp_path / "b.onnx", 2)
    assert run(a, b, tmp_path / "out.onnx", *arguments).returncode == 0
    first, second, found = weights(a), weights(b), weights(tmp_path / "out.onnx")
    assert any(np.abs(first[name] - second[name]).max() > 0.01 for name in first if first[name].dtype.kind == "f")
    for name, value in found.items():
        wanted = (1 - share) * first[name] + share * second[name] if value.dtype.kind == "f" else first[name]
        np.testing.assert_allclose(value, wanted, atol=1e-6)


def test_a_detector_with_itself_is_itself(tmp_path):
    a = exported(tmp_path / "a.onnx", 1)
    assert run(a, a, tmp_path / "out.onnx").returncode == 0
    assert all(np.array_equal(value, weights(a)[name]) for name, value in weights(tmp_path / "out.onnx").items())


def test_weights_that_are_no_numbers_are_refused(tmp_path):
    a, model = exported(tmp_path / "a.onnx", 1), onnx.load(str(tmp_path / "a.onnx"))
    tensor = next(t for t in model.graph.initializer if t.name == "head.scores.0.2.bias")
    tensor.CopyFrom(numpy_helper.from_array(numpy_helper.to_array(tensor) * np.float32(np.nan), tensor.name))
    onnx.save(model, str(tmp_path / "odd.onnx"))
    done = run(a, tmp_path / "odd.onnx", tmp_path / "out.onnx")
    assert done.returncode == 1 and "odd.onnx: head.scores.0.2.bias has weights that are no numbers" in done.stderr
    with pytest.raises(OnnxError, match="odd.onnx.*no numbers"):
        OnnxModel(tmp_path / "odd.onnx")


def test_what_does_not_fit_is_refused(tmp_path):
    a = exported(tmp_path / "a.onnx", 1)
    (tmp_path / "torn.onnx").write_bytes(a.read_bytes()[:1000])
    others = {exported(tmp_path / "wide.onnx", 1, width=0.25): "not of one shape", exported(tmp_path / "dog.onnx", 1, ("boat", "dog")): "other classes",
              tmp_path / "torn.onnx": "torn.onnx: ", tmp_path / "none.onnx": "none.onnx: "}
    for other, words in others.items():
        done = run(a, other, tmp_path / "out.onnx")
        assert done.returncode == 1 and words in done.stderr and "Traceback" not in done.stderr
    assert run(a, a, tmp_path / "out.onnx", "--share", "1.5").returncode == 2
    (tmp_path / "folder").mkdir()
    for out in ("no/out.onnx", "folder"):
        done = run(a, a, tmp_path / out)
        assert done.returncode == 1 and f"{out} cannot be written" in done.stderr and "Traceback" not in done.stderr
    assert not list(tmp_path.glob("*.part"))
    assert not (tmp_path / "out.onnx").exists()
