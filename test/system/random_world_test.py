"""The worlds that the detector learns from, and the data set made of them."""
import subprocess
import sys

import cv2
import pytest
import yaml

from conftest import ROOT, SETUP, rosrun

sys.path.insert(0, str(ROOT / "models"))
from data import bodies, random_world  # noqa: E402

CLASSES = yaml.safe_load((ROOT / "models/classes.yaml").read_text())["names"]


def shapes_of(split, worlds=150):
    return {(body.get("label"), body.get("parts", [body])[0]["shape"])
            for seed in range(worlds) for body in random_world.random_world(split, seed)["bodies"]}


def test_makers_are_the_classes():
    assert list(bodies.MAKERS) == CLASSES


def test_one_seed_is_one_world(tmp_path):
    for name, split, seed in (("a", "train", 3), ("b", "train", 3), ("c", "train", 4), ("d", "val", 3)):
        random_world.write(tmp_path / name, split, seed)
    a, b, c, d = ((tmp_path / name).read_bytes() for name in "abcd")
    assert a == b and len({a, c, d}) == 3


@pytest.mark.parametrize("split", ["train", "held_out"])
def test_every_class_occurs_and_some_worlds_have_none(split):
    worlds = [random_world.random_world(split, seed) for seed in range(150)]
    labels = [{body["label"] for body in world["bodies"] if "label" in body} for world in worlds]
    assert set.union(*labels) == set(CLASSES)
    assert 0 < sum(not found for found in labels) < 30


def test_held_out_worlds_have_shapes_skies_and_patterns_of_their_own():
    train, held_out = shapes_of("train"), shapes_of("held_out")
    for label in ("cage", "boat", "buoy", "bollard", "car", "box", "chair"):
        usual, unseen = ({shape for other, shape in shapes if other == label} for shapes in (train, held_out))
        assert usual and unseen and (label == "cage" or not usual & unseen), label
    skies = [{random_world.random_world(split, seed)["light"]["cloud_seed"] for seed in range(150)} for split in ("train", "held_out")]
    assert not skies[0] & skies[1]


def models_of_cages(split):
    """Worlds with a cage that one could carry, on land."""
    worlds = [random_world.random_world(split, seed) for seed in range(150)]
    small = lambda body: body.get("label") == "cage" and body.get("parts", [body])[0]["params"]["diameter"] <= 1.5
    return sum(any(map(small, world["bodies"])) for world in worlds if world["ground"]["kind"] != "water")


def test_worlds_to_learn_from_have_test_sites_ashore_and_those_held_out_have_none():
    # two of five worlds of the half that is on land, less those that are empty or have no room: 20 at least of 150
    assert models_of_cages("train") > 20
    assert models_of_cages("held_out") == 0


@pytest.mark.parametrize("split", ["train", "held_out"])
def test_worlds_can_be_loaded(split, tmp_path):
    for seed in range(12):
        random_world.write(tmp_path / "w.yaml", split, seed)
        done = rosrun("make_bag", tmp_path / "w.yaml", tmp_path / "w.bag", "--seconds", "0.01", "--no-truth")
        assert done.returncode == 0, done.stderr


def model_tool(name, *arguments):
    command = ["bash", "-c", '. "$0" && exec /usr/bin/python3 "$@"', SETUP, str(ROOT / f"models/{name}.py"), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_a_data_set_has_as_many_pictures_as_asked_for_and_goes_on_where_it_ended(tmp_path):
    counts = ("--train", "4", "--val", "1", "--held-out", "1")
    for name in ("a", "b"):
        assert model_tool("make_dataset", tmp_path / name, *counts).returncode == 0
    files = {file.relative_to(tmp_path / "a"): file.read_bytes() for file in (tmp_path / "a").rglob("*.*")}
    assert files == {file.relative_to(tmp_path / "b"): file.read_bytes() for file in (tmp_path / "b").rglob("*.*")}
    for split, count in (("train", 4), ("val", 1), ("held_out", 1)):
        for kind, suffix in (("images", "jpg"), ("labels", "txt")):
            assert len(list((tmp_path / "a" / kind / split).glob(f"*.{suffix}"))) == count
    world = tmp_path / "a/worlds/val_00000.yaml"
    world.unlink()
    said = model_tool("make_dataset", tmp_path / "a", *counts)
    assert said.returncode == 0 and "1 of them made" in said.stdout and world.exists()
    refused = model_tool("make_dataset", tmp_path / "a", *counts, "--seed", "2")
    assert refused.returncode != 0 and "of another seed" in refused.stderr
    shown = model_tool("show_dataset", tmp_path / "a", tmp_path / "sheet.jpg", "--rows", "2", "--columns", "2")
    assert shown.returncode == 0 and cv2.imread(str(tmp_path / "sheet.jpg")).shape == (2 * 225, 2 * 400, 3)
    few = model_tool("show_dataset", tmp_path / "a", tmp_path / "sheet.jpg", "--rows", "9")
    assert few.returncode != 0 and "4 pictures in" in few.stderr
