"""The training as a program: it learns, and an interruption changes nothing."""
import csv
import fcntl
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import time

import pytest
import torch

from conftest import ROOT
from yolov8 import train
from yolov8.augment import Augmentation
from yolov8.checkpoint import CheckpointError, load, network_of, save
from yolov8.dataset import Dataset
from yolov8.evaluate import runner, score

SIZE = (96, 64)


class Silent:
    def __init__(self, stop_at=None):
        self.stop_at, self.steps = stop_at, 0

    def step(self, training):
        self.steps += 1
        training.stop = self.steps == self.stop_at

    def epoch(self, training):
        pass


def training_of(folder, out, report=None, **settings):
    chosen = train.Settings(**{"epochs": 2, "width": 0.125, "size": SIZE, "batch": 4, "validate": 1, **settings})
    out.mkdir(exist_ok=True)
    return train.Training(chosen, *(Dataset(folder, s, SIZE) for s in ("train", "val")), out, report or Silent(), "cpu")


@pytest.fixture(scope="module", params=["adamw", "sgd"])
def uninterrupted(request, shapes_folder, tmp_path_factory):
    training = training_of(shapes_folder, tmp_path_factory.mktemp(request.param), optimizer=request.param)
    training.run()
    return training


@pytest.mark.parametrize("stop_at", [3, 4, 6])  # of 4 steps an epoch: within the first, at its end, within the second
def test_interrupted_training_ends_as_one_without_interruption(uninterrupted, shapes_folder, tmp_path, stop_at):
    optimizer = uninterrupted.settings.optimizer
    with pytest.raises(KeyboardInterrupt):
        training_of(shapes_folder, tmp_path, Silent(stop_at), optimizer=optimizer).run()
    resumed = training_of(shapes_folder, tmp_path, optimizer=optimizer)
    resumed.restore(*load(tmp_path / "last.pt", resumed=True))
    assert resumed.epoch * 4 + resumed.step == stop_at
    resumed.run()
    for kind in ("network", "weights"):
        first, second = (load(folder / "last.pt")[1][kind] for folder in (uninterrupted.out, tmp_path))
        assert all(torch.equal(second[name], value) for name, value in first.items())
    assert [{**row, "seconds": 0} for row in resumed.history] == [{**row, "seconds": 0} for row in uninterrupted.history]


def test_training_learns(shapes_folder, tmp_path):
    """Eight pictures of three kinds of shapes, learnt by heart."""
    data = Dataset(shapes_folder, "val", SIZE)
    settings = train.Settings(epochs=60, width=0.125, size=SIZE, batch=4, validate=60, rate=0.005)
    training = train.Training(settings, data, data, tmp_path, Silent(), "cpu")
    training.augmentation_at = lambda step: Augmentation(0, 0, 0, 0, 0, 0, 0)
    before = score(runner(training.average.network), data).summary()[0]
    training.run()
    after = score(runner(network_of(*load(tmp_path / "last.pt"))), data).summary()[0]
    assert before < 0.05 and after > 0.8


def test_plan_of_minutes_ends_in_time(shapes_folder, tmp_path):
    training = training_of(shapes_folder, tmp_path, epochs=None, minutes=0.05)
    training.run()
    assert training.progress() == 1 and training.history[-1]["map50"] is not None
    assert training.history[-1]["seconds"] >= 3


def test_same_seed_same_weights(shapes_folder, tmp_path):
    weights = []
    for name in ("a", "b"):
        training_of(shapes_folder, tmp_path / name, epochs=1, workers=1 + len(weights)).run()
        weights.append(load(tmp_path / name / "last.pt")[1]["weights"])
    assert all(torch.equal(weights[0][name], weights[1][name]) for name in weights[0])


def run(*arguments, **more):
    return subprocess.run([sys.executable, ROOT / "models/train_detector.py", *map(str, arguments)], text=True,
                          capture_output=True, **more)


def test_program_stops_at_a_signal_and_resumes(shapes_folder, tmp_path):
    command = [sys.executable, ROOT / "models/train_detector.py", shapes_folder, tmp_path, "--epochs", "8", "--size", "96x64",
               "--width", "0.125", "--batch", "4"]
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while not (tmp_path / "last.pt").exists() and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 1 and "--resume" in said, said
    assert 1 <= len(load(tmp_path / "last.pt")[0]["history"]) < 8
    done = run(shapes_folder, tmp_path, "--resume")
    assert done.returncode == 0, done.stderr
    rows = list(csv.DictReader((tmp_path / "epochs.csv").open()))
    assert [int(row["epoch"]) for row in rows] == list(range(1, 9)) and rows[-1]["map50_95"]
    assert load(tmp_path / "best.pt")[0]["names"] == ["box", "disc", "triangle"]


def test_program_does_not_resume_what_another_version_began(shapes_folder, tmp_path):
    facts = {"config": {}, "names": [], "size": [], "state": {}, "settings": {"colour": "red"}}
    save(tmp_path / "last.pt", facts, {"weights": {}, "network": {}, "optimizer": {}, "losses": {}})
    done = run(shapes_folder, tmp_path, "--resume")
    assert done.returncode == 1 and "another version" in done.stderr and "colour" in done.stderr


def test_program_does_not_resume_what_has_ended_nor_with_other_images(shapes_folder, tmp_path):
    training_of(shapes_folder, tmp_path / "out", epochs=1).run()
    done = run(shapes_folder, tmp_path / "out", "--resume")
    assert done.returncode == 1 and "has ended" in done.stderr and "Traceback" not in done.stderr
    other = shutil.copytree(shapes_folder, tmp_path / "other")
    next((other / "images/train").iterdir()).unlink()
    done = run(other, tmp_path / "out", "--resume")
    assert done.returncode == 1 and "other images" in done.stderr and "Traceback" not in done.stderr


def test_two_programs_do_not_write_to_one_folder(shapes_folder, tmp_path):
    held = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(held, fcntl.LOCK_EX)
    done = run(shapes_folder, tmp_path, "--epochs", 1)
    os.close(held)
    assert done.returncode == 1 and "another training writes to it" in done.stderr and not (tmp_path / "last.pt").exists()


@pytest.mark.parametrize("out", ["file", "file/below"])
def test_program_names_a_folder_that_cannot_be(shapes_folder, tmp_path, out):
    (tmp_path / "file").write_text("")
    done = run(shapes_folder, tmp_path / out, "--epochs", 1)
    assert done.returncode == 1 and out in done.stderr and "Traceback" not in done.stderr


def test_program_tells_of_a_full_disk_and_leaves_no_part(shapes_folder, tmp_path):
    def small_files():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # then writing fails, as on a full disk
        resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))
    done = run(shapes_folder, tmp_path, "--epochs", 1, "--width", "0.125", "--size", "96x64", preexec_fn=small_files)
    assert done.returncode == 1 and "cannot be written" in done.stderr and "Traceback" not in done.stderr
    assert not list(tmp_path.glob("*.part"))


def test_program_does_not_overwrite_a_training(shapes_folder, tmp_path):
    (tmp_path / "last.pt").write_bytes(b"")
    done = run(shapes_folder, tmp_path)
    assert done.returncode == 1 and "exists" in done.stderr and "Traceback" not in done.stderr


def test_where_no_body_is_to_find_no_weights_are_the_best(shapes_folder, tmp_path):
    data = tmp_path / "data"
    shutil.copytree(shapes_folder, data)
    for file in (data / "labels/val").glob("*.txt"):
        file.write_text("")
    done = run(data, tmp_path / "out", "--epochs", "1", "--size", "96x64", "--width", "0.125", "--batch", "4", "--validate", "1")
    assert done.returncode == 1 and "no body to find" in done.stderr and (tmp_path / "out/last.pt").exists()


@pytest.mark.parametrize("arguments, words", [
    (("--size", "100"), "multiples of 32"), (("--size", "64x"), "multiples of 32"), (("--resume",), "no checkpoint"),
    (("--epochs", "0"), "--epochs: 0 is not from 1"), (("--epochs", "1", "--minutes", "1"), "not allowed"),
    (("--batch", "0"), "--batch: 0 is not from 1"), (("--seed", "-1"), "--seed"), (("--width", "nan"), "--width: nan is not above 0"),
    (("--mosaic", "7"), "--mosaic: 7 is not from 0 to 1"), (("--threads", "0"), "--threads"), (("--workers", "x"), "--workers"),
    (("--resume", "--epochs=9"), "it does not take --epochs"),
])
def test_program_refuses_bad_arguments(shapes_folder, tmp_path, arguments, words):
    done = run(shapes_folder, tmp_path / "out", *arguments)
    assert done.returncode != 0 and words in done.stderr and "Traceback" not in done.stderr


def test_training_begins_with_the_weights_of_another(uninterrupted, shapes_folder, tmp_path):
    first = uninterrupted.out / "best.pt"
    begun = training_of(shapes_folder, tmp_path / "second", weights=str(first))
    for name, value in load(first)[1]["weights"].items():
        assert torch.equal(begun.network.state_dict()[name], value), name
        assert torch.equal(begun.average.network.state_dict()[name], value), name


def test_weights_of_another_shape_are_refused(uninterrupted, shapes_folder, tmp_path):
    done = run(shapes_folder, tmp_path / "out", "--weights", str(uninterrupted.out / "best.pt"), "--width", "0.25")
    assert done.returncode == 1 and "its network and classes" in done.stderr and "Traceback" not in done.stderr
    done = run(shapes_folder, tmp_path / "out", "--weights", str(tmp_path / "none.pt"))
    assert done.returncode == 1 and "none.pt" in done.stderr and "Traceback" not in done.stderr


def test_an_exported_detector_is_trained_on(uninterrupted, shapes_folder, tmp_path):
    pytest.importorskip("onnx", reason="python3-onnx is not installed")
    from yolov8.export import export

    exported = tmp_path / "first.onnx"
    export(network_of(*load(uninterrupted.out / "best.pt")), uninterrupted.names, SIZE, exported, {})
    begun = training_of(shapes_folder, tmp_path / "second", weights=str(exported))
    image = torch.rand(1, 3, *SIZE[::-1])
    with torch.no_grad():
        for ours, theirs in zip(begun.average.network(image), network_of(*load(uninterrupted.out / "best.pt"))(image)):
            torch.testing.assert_close(ours, theirs, atol=1e-3, rtol=1e-3)
    exported.write_bytes(b"no model")
    done = run(shapes_folder, tmp_path / "out", "--weights", str(exported))
    assert done.returncode == 1 and "first.onnx" in done.stderr and "Traceback" not in done.stderr


def test_checkpoint_of_others_is_refused(tmp_path):
    path = tmp_path / "a.pt"
    for content in (b"", b"not a checkpoint"):
        path.write_bytes(content)
        with pytest.raises(CheckpointError, match="a.pt"):
            load(path)
    torch.save({"weights": torch.zeros(1)}, path)
    with pytest.raises(CheckpointError, match="facts"):
        load(path)
    torch.save({"weights": pathlib.PurePath("x")}, path)
    with pytest.raises(CheckpointError, match="more than numbers") as fault:
        load(path)
    assert "weights_only" not in str(fault.value)
    facts = {"config": {}, "names": [], "size": []}
    save(path, facts, {"weights": {}})
    with pytest.raises(CheckpointError, match="lacks the state"):
        load(path, resumed=True)
    save(path, {**facts, "state": {}}, {"weights": {}, "network": {}})
    with pytest.raises(CheckpointError, match="lacks optimizer, losses"):
        load(path, resumed=True)


def test_damaged_checkpoint_is_refused(tmp_path):
    path = tmp_path / "a.pt"
    save(path, {"config": {}, "names": [], "size": []}, {"weights": torch.ones(1000)})
    content = bytearray(path.read_bytes())
    middle = content.index(torch.ones(1000).numpy().tobytes()) + 2000
    content[middle] ^= 1
    path.write_bytes(content)
    with pytest.raises(CheckpointError, match="a.pt.*damaged"):
        load(path)


def test_checkpoint_is_whole_or_not_there(tmp_path, monkeypatch):
    path = tmp_path / "a.pt"
    save(path, {"config": {}, "names": ["old"], "size": []}, {"weights": {}})

    def broken(content, stream):
        stream.write(b"half")
        raise OSError("disk full")

    monkeypatch.setattr(torch, "save", broken)
    with pytest.raises(OSError):
        save(path, {"config": {}, "names": ["new"], "size": []}, {})
    assert load(path)[0]["names"] == ["old"]
