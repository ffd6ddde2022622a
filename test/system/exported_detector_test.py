"""An exported detector in the package's own backends."""
import sys

import pytest

from conftest import ROOT, rosrun

torch = pytest.importorskip("torch", reason="python3-torch is not installed")
pytest.importorskip("onnx", reason="python3-onnx is not installed")


def test_exported_detector_runs_in_the_package_s_backends(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "path", [str(ROOT / "models"), *sys.path])
    from yolov8.export import export
    from yolov8.network import YoloV8

    path = tmp_path / "detector.onnx"
    export(YoloV8(2, width=0.125).eval(), ["boat", "buoy"], (96, 64), path, {})
    done = rosrun("bench_detect", path)
    assert done.returncode == 0, done.stderr
    assert "2 threads, 96x64" in done.stdout and "detect/opencv/cost " in done.stdout
    assert "detect/openvino/cost " in done.stdout or "OpenVINO not measured" in done.stdout
