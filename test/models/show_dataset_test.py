"""The sheet of labelled pictures, and what it says of folders that hold none."""
import subprocess
import sys

import cv2
import pytest

from conftest import ROOT
from shapes import write_dataset


def show(*arguments):
    return subprocess.run([sys.executable, ROOT / "models/show_dataset.py", *map(str, arguments)], text=True, capture_output=True)


@pytest.fixture
def folder(tmp_path):
    folder = write_dataset(tmp_path / "data", {"train": 2}, (96, 64))
    for path in sorted((folder / "images/train").glob("*.png")):
        cv2.imwrite(str(path.with_suffix(".jpg")), cv2.imread(str(path)))
        path.unlink()
    return folder


def test_sheet_has_a_tile_for_each_picture_with_its_boxes(folder, tmp_path):
    (folder / "labels/train/000.txt").write_text("0 0.5 0.5 0.5 0.5\n")
    done = show(folder, tmp_path / "sheet.png", "--rows", 1, "--columns", 2)
    assert done.returncode == 0, done.stderr
    sheet = cv2.imread(str(tmp_path / "sheet.png"))
    assert sheet.shape == (225, 800, 3)
    # the box of the first: a quarter and three quarters of a picture of 338 x 225 in a tile of 400
    assert sheet[112, 31 + 84].tolist() == [0, 255, 0] and sheet[56, 200].tolist() == [0, 255, 0]


@pytest.mark.parametrize("file, content, words", [
    ("data.yaml", "- a\n", "data.yaml: no class names"), ("labels/train/000.txt", "0 0.5\n", "000.txt:1:"),
    ("images/train/000.jpg", "no image", "000.jpg: cannot be read")])
def test_faults_are_named(folder, tmp_path, file, content, words):
    (folder / file).write_text(content)
    done = show(folder, tmp_path / "sheet.png", "--rows", 1, "--columns", 2)
    assert done.returncode == 1 and words in done.stderr and "Traceback" not in done.stderr


@pytest.mark.parametrize("sheet, words", [("none/a.png", "cannot be written"), ("a.words", "a.words")])
def test_sheet_that_cannot_be_written_is_told(folder, tmp_path, sheet, words):
    done = show(folder, tmp_path / sheet, "--rows", 1, "--columns", 2)
    assert done.returncode == 1 and words in done.stderr and "Traceback" not in done.stderr


def test_too_few_pictures_are_told(folder, tmp_path):
    done = show(folder, tmp_path / "sheet.png")
    assert done.returncode == 1 and "2 pictures in" in done.stderr and "12 are needed" in done.stderr
