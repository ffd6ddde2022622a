"""Scoring of networks, checkpoints and ONNX files."""
import subprocess
import sys

import numpy as np
import pytest
import torch

from conftest import ROOT

pytest.importorskip("onnx", reason="python3-onnx is not installed")
from shapes import NAMES  # noqa: E402
from yolov8.checkpoint import save  # noqa: E402
from yolov8.dataset import Dataset  # noqa: E402
from yolov8.detections import Detections  # noqa: E402
from yolov8.evaluate import score  # noqa: E402
from yolov8.network import YoloV8  # noqa: E402
from yolov8.onnx_model import OnnxError, OnnxModel, renamed  # noqa: E402

FIXTURES = ROOT / "test/fixtures"  # what they compute is told in models/make_fixtures.py
RED, GREEN = (255, 0, 0), (0, 255, 0)


def image_of(colour):
    return torch.tensor(colour, dtype=torch.uint8)[None, :, None, None].expand(1, 3, 32, 32)


@pytest.mark.parametrize("file, colour, box, class_, confidence", [
    ("raw_head.onnx", RED, [4, 4, 28, 20], 0, 1 / (1 + np.exp(-5))), ("stock_head.onnx", RED, [8, 12, 24, 20], 0, 1.0),
    ("stock_head.onnx", GREEN, [4, 8, 12, 16], 1, 1.0), ("raw_head.onnx", GREEN, [0, 0, 32, 32], 1, 1 / (1 + np.exp(-5))),
])
def test_onnx_file_with_either_head(file, colour, box, class_, confidence):
    model = OnnxModel(FIXTURES / file)
    assert model.names == ["red", "green"] and model.size == (32, 32)
    found, = model(image_of(colour), 0.5, 0.5)
    np.testing.assert_allclose(found.boxes, [box], atol=0.01)
    assert found.classes.tolist() == [class_] and found.scores[0] == pytest.approx(confidence, abs=1e-5)


@pytest.mark.parametrize("file, words", [
    ("unnamed_classes.onnx", "does not name its classes"), ("unknown_operator.onnx", "NoSuchOperator"), ("none.onnx", "none.onnx"),
])
def test_onnx_file_that_is_no_detector_is_refused(file, words):
    with pytest.raises(OnnxError, match=words):
        OnnxModel(FIXTURES / file)


def test_onnx_file_with_other_outputs_is_refused():
    with pytest.raises(OnnxError, match="outputs"):
        OnnxModel(FIXTURES / "transposed_head.onnx")(image_of(RED), 0.5, 0.5)


def test_classes_are_told_apart_by_name():
    found = Detections(np.arange(12.0).reshape(3, 4), np.array([0.9, 0.8, 0.7]), np.array([0, 1, 2]))
    same = renamed(found, ["car", "tree", "boat"], ["boat", "car"])
    assert same.classes.tolist() == [1, 0] and same.scores.tolist() == [0.9, 0.7] and same.boxes[1, 0] == 8


def test_perfect_detector_scores_one(shapes_folder):
    """Scaled, padded and back: what is right in the input is right in the image."""
    data = Dataset(shapes_folder, "val", (160, 160))  # of images of 96 x 64, so padded above and below
    shift = np.float32([0, 26, 0, 26])                # 160 x 107 in the middle of 160 x 160

    def detect(images):
        answer, detect.next = data.samples[detect.next:detect.next + len(images)], detect.next + len(images)
        return [Detections(s.boxes + shift, np.ones(len(s.boxes)), s.classes) for s in answer]

    detect.next = 0
    scorer = score(detect, data, batch=3)
    assert scorer.summary() == (1.0, 1.0) and scorer.images == 8


def evaluate(*arguments):
    return subprocess.run([sys.executable, ROOT / "models/evaluate_detector.py", *map(str, arguments)], text=True, capture_output=True)


def test_program_scores_a_checkpoint_and_its_export_alike(shapes_folder, tmp_path):
    torch.manual_seed(0)
    network = YoloV8(3, width=0.125)
    with torch.no_grad():
        for branch in network.head.scores:
            branch[-1].bias.fill_(-2.0)  # an untrained network that sees a lot
    save(tmp_path / "a.pt", {"config": network.config, "names": NAMES, "size": [96, 64]}, {"weights": network.state_dict()})
    exported = subprocess.run([sys.executable, ROOT / "models/export_detector.py", tmp_path / "a.pt", tmp_path / "a.onnx"],
                              text=True, capture_output=True)
    assert exported.returncode == 0, exported.stderr
    first, second = (evaluate(tmp_path / name, shapes_folder) for name in ("a.pt", "a.onnx"))
    assert first.returncode == second.returncode == 0, first.stderr + second.stderr
    assert first.stdout.splitlines()[0] == second.stdout.splitlines()[0] and "| disc |" in first.stdout
    figures = [[float(line.split()[2]) for line in out.stdout.splitlines() if line.startswith("figure")]
               for out in (first, second)]
    assert len(figures[0]) == 2 and figures[0] == pytest.approx(figures[1], abs=0.02)


def test_a_network_that_computes_nonsense_is_not_exported(tmp_path):
    network = YoloV8(3, width=0.125)
    weights = {name: torch.full_like(value, float("nan")) if value.is_floating_point() else value for name, value in network.state_dict().items()}
    save(tmp_path / "a.pt", {"config": network.config, "names": NAMES, "size": [96, 64]}, {"weights": weights})
    done = subprocess.run([sys.executable, ROOT / "models/export_detector.py", tmp_path / "a.pt", tmp_path / "a.onnx"],
                          text=True, capture_output=True)
    assert done.returncode == 1 and "nothing written" in done.stderr and not (tmp_path / "a.onnx").exists()


def test_program_names_what_is_wrong(shapes_folder, tmp_path):
    (tmp_path / "a.pt").write_bytes(b"")
    for model, words in ((tmp_path / "a.pt", "a.pt"), (FIXTURES / "raw_head.onnx", "none of its classes"), ("no.onnx", "no.onnx")):
        done = evaluate(model, shapes_folder)
        assert done.returncode == 1 and words in done.stderr and "Traceback" not in done.stderr
    for overlap in ("7", "nan"):
        assert f"{overlap} is not from 0 to 1" in evaluate("no.onnx", shapes_folder, "--overlap", overlap).stderr
