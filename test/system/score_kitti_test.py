"""The gate on the real recording, through the nodelets."""
import os
import re

import pytest

from tools_test import rosrun

DATA = os.environ.get("FIELD_FUSION_DATA")


@pytest.mark.skipif(not DATA, reason="FIELD_FUSION_DATA is not set")
def test_car_ahead_is_fused_in_every_frame_and_well_placed(tmp_path):
    done = rosrun("score_kitti", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stdout + done.stderr
    figures = {name: float(value) for name, value in re.findall(r"^figure (\S+) (\S+) \S+ n=\d+ ci=", done.stdout, re.M)}
    assert figures["kitti/sequence/fused_frames"] == 10, done.stdout
    assert figures["kitti/sequence/range_max_error"] <= 0.15, done.stdout
    assert len((tmp_path / "out/score_kitti.csv").read_text().splitlines()) == 11


def test_without_recordings_it_says_what_is_missing(tmp_path, monkeypatch):
    monkeypatch.delenv("FIELD_FUSION_DATA", raising=False)
    done = rosrun("score_kitti")
    assert done.returncode == 2 and "FIELD_FUSION_DATA" in done.stderr
    done = rosrun("score_kitti", "--data", tmp_path)
    assert done.returncode == 2 and str(tmp_path / "kitti_sequence") in done.stderr
