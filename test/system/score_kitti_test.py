"""The gates on real recordings, through the nodelets."""
import os
import pathlib
import re
import shutil

import pytest

from tools_test import rosrun

DATA = os.environ.get("FIELD_FUSION_DATA")
needs_data = pytest.mark.skipif(not DATA, reason="FIELD_FUSION_DATA is not set")


@pytest.fixture(scope="module")
def scored(tmp_path_factory):
    """({figure: value}, the folder that was kept)."""
    out = tmp_path_factory.mktemp("score") / "out"
    done = rosrun("score_kitti", "--every", "8", "--out", out)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = re.findall(r"^figure (\S+) (\S+) \S+ n=\d+ ci=\[\S+,\S+\]$", done.stdout, re.M)
    assert len(lines) == len(re.findall("^figure", done.stdout, re.M))
    return {name: float(value) for name, value in lines}, out


@needs_data
def test_car_ahead_is_fused_in_every_frame_and_well_placed(scored):
    figures, out = scored
    assert figures["kitti/sequence/fused_frames"] == 10
    assert figures["kitti/sequence/range_max_error"] <= 0.15
    assert len((out / "sequence.csv").read_text().splitlines()) == 11


@needs_data
def test_labelled_bodies_are_found_apart_and_well_placed(scored):
    figures, out = scored
    assert figures["kitti/tracking/recall"] >= 0.95
    assert figures["kitti/tracking/merge_rate"] <= 0.05
    assert figures["kitti/tracking/range_median_error"] <= 0.15
    assert figures["kitti/tracking/azimuth_median_error"] <= 0.5
    assert figures["kitti/tracking/false_in_lane"] <= 0.05
    assert figures["kitti/tracking/ground_left"] <= 0.01
    assert len((out / "tracking.csv").read_text().splitlines()) > 20


@needs_data
def test_every_labelled_body_of_single_frames_has_an_obstacle(scored):
    figures, out = scored
    assert figures["kitti/object/obstacle_recall"] == 1
    assert figures["kitti/object/class_accuracy"] == 1
    assert (out / "object.csv").read_text().count("\n") == 5


@pytest.fixture
def few_frames(tmp_path):
    """Of the tracking recording, the frames 40 to 43 under their numbers."""
    source, folder = pathlib.Path(DATA) / "kitti_tracking", tmp_path / "other"
    (folder / "velodyne").mkdir(parents=True)
    for name in ("calib.txt", "label.txt"):
        shutil.copy(source / name, folder)
    for frame in range(40, 44):
        shutil.copy(source / f"velodyne/{frame:06}.bin", folder / "velodyne")
    return folder


@needs_data
def test_other_recordings_score_alike(few_frames):
    done = rosrun("score_kitti", "--tracking", few_frames)
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"^figure kitti/tracking/recall 1 - n=12 ", done.stdout, re.M), done.stdout
    assert re.search(r"^figure kitti/tracking/false_in_lane nan a-frame n=0 ", done.stdout, re.M)  # it ends within 3 m


@needs_data
def test_fault_in_a_label_ends_the_run_with_its_line(few_frames):
    text = (few_frames / "label.txt").read_text().replace(" Van ", " Ship ", 1)
    (few_frames / "label.txt").write_text(text)
    done = rosrun("score_kitti", "--tracking", few_frames)
    assert done.returncode == 1 and "label.txt:3: should name one of" in done.stderr


def test_without_recordings_it_says_what_is_missing(tmp_path, monkeypatch):
    monkeypatch.delenv("FIELD_FUSION_DATA", raising=False)
    done = rosrun("score_kitti")
    assert done.returncode == 2 and "FIELD_FUSION_DATA" in done.stderr
    done = rosrun("score_kitti", "--data", tmp_path)
    assert done.returncode == 2
    for name in ("kitti_sequence", "kitti_tracking", "kitti_object"):
        assert f"skipped: no such file or folder: {tmp_path / name}\n" in done.stderr
    done = rosrun("score_kitti", "--tracking", tmp_path / "nowhere")
    assert done.returncode == 2 and str(tmp_path / "nowhere") in done.stderr
