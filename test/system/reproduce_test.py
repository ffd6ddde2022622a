"""reproduce: short forms of the experiments, and what is said to those who ask for what there is not."""
import csv
import os
import re
import sys

import pytest

from conftest import ROOT, rosrun

LONG = pytest.mark.skipif(not os.environ.get("FIELD_FUSION_LONG"), reason="takes minutes; FIELD_FUSION_LONG=1 runs it too")


def reproduced(*arguments, name="usv"):
    """{figure: (value, unit)}, what was printed."""
    done = rosrun("reproduce", name, *(("--detections", "truth") if name == "usv" else ()), *arguments)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = re.findall(r"^figure (\S+) (\S+) (\S+) n=\d+ ci=\[\S+,\S+\]$", done.stdout, re.M)
    assert len(lines) == len(re.findall("^figure", done.stdout, re.M))
    assert done.stdout.splitlines()[-1].startswith("figure ")
    return {name: (float(value), unit) for name, value, unit in lines}, done.stdout


@pytest.fixture(scope="module")
def one_place(tmp_path_factory):
    out = tmp_path_factory.mktemp("reproduce") / "out"
    return *reproduced("--seeds", "1", "--parts", "table1", "--places", "0300", "--out", out), out


def test_a_cage_at_3_m_is_found_in_its_place_and_the_papers_method_errs_as_the_paper_did(one_place):
    figures, said, _ = one_place
    assert "DETECTIONS ARE THE TRUTH" in said
    assert figures["usv/table1/found"] == (1.0, "-")
    assert figures["usv/table1/face_mae"][0] <= 0.05 and figures["usv/table1/face_mae"][1] == "m"
    assert figures["usv/table1/centre_mae"][0] <= 0.1
    assert figures["usv/table1/angle_mae"][0] <= 0.3 and figures["usv/table1/angle_mae"][1] == "deg"
    value, unit = figures["usv/table1/paper_distance_mae/paper_method"]
    assert unit == "m" and 0.251 / 2 <= value <= 0.251 * 2


def test_table_plot_and_bag_are_kept_where_asked(one_place):
    _, said, out = one_place
    assert re.search(r"^0300 +3\.15 m +0\.15 m", said, re.M)
    assert (out / "usv_table1.csv").read_text().count("\n") == 2
    assert (out / "usv_errors.png").stat().st_size > 1000
    assert [file.name for file in (out / "bags").iterdir()] == ["cage_0300_102.bag"]


def test_a_worse_lidar_gives_worse_figures(one_place):
    worse, _ = reproduced("--seeds", "1", "--parts", "table1", "--places", "0300", "--degrade", "lidar=10x")
    assert worse["usv/table1/single_face_mae"] > one_place[0]["usv/table1/single_face_mae"]
    assert worse["usv/table1/single_centre_mae"] > one_place[0]["usv/table1/single_centre_mae"]


def test_a_crossing_boat_is_matched_and_its_latency_told():
    figures, said = reproduced("--quick", "--parts", "timing")
    for case in ("on_time", "stamped_120ms_late"):
        assert figures[f"usv/timing/free/{case}/matched"][0] >= 0.9
        value, unit = figures[f"usv/timing/free/{case}/position_error_when_seen"]
        assert unit == "m" and value < 0.5  # 3 m/s over the 120 ms, and what the LiDAR errs
        assert figures[f"usv/timing/free/{case}/latency_p99"][1] == "ms"
    assert re.search(r"^free, on time +[01]\.", said, re.M)


def test_black_buoys_are_found_farther_with_a_box_than_without():
    figures, said = reproduced("--quick", "--parts", "small")
    found = lambda system, bin: figures[f"usv/small/{system}/found/{bin}"][0]
    assert found("lidar", "5_10m") == 1.0 and found("lidar", "20_25m") < 0.1  # a few returns of a body are none by themselves
    assert found("lidar", "15_20m") < found("faint", "15_20m") <= found("fused", "15_20m")
    assert found("fused", "30_40m") > 0.9 and figures["usv/small/camera/range_mae/30_40m"][1] == "m"
    assert re.search(r"^5-10m +[0-9.]+ +1\.00", said, re.M)


WALK = ("--quick", "--parts", "walk", "rotation", "--methods", "mdr", "--seeds", "1")


@pytest.fixture(scope="module")
def walked(tmp_path_factory):
    out = tmp_path_factory.mktemp("reproduce_mdr") / "out"
    return *reproduced(*WALK, "--out", out, name="quadruped-mdr"), out


def off_the_walls(out):
    """{case/kind: (points, RMS [m], that of the range alone)}."""
    with open(out / "mdr_room.csv") as file:
        return {row["case"]: (int(row["points"]), float(row["rms_m"]), float(row["range_noise_rms_m"])) for row in csv.DictReader(file)}


def test_odometry_leaves_hardly_more_of_a_walk_and_of_a_turn_than_the_scanners_noise(walked):
    figures, said, out = walked
    rms = off_the_walls(out)
    assert figures["quadruped/walk/residual_rms"] == (pytest.approx(rms["walk/mdr"][1], abs=1e-3), "m")
    points, after, noise = rms["walk/mdr"]
    assert points > 50000 and after <= noise + 0.01 and rms["walk/raw"][1] > 2 * after
    for rate in (60, 180):
        assert rms[f"rotation_{rate}/mdr"][1] < rms[f"rotation_{rate}/raw"][1] / 3
    assert (out / "mdr_scans.png").stat().st_size > 1000
    assert re.search(r"^walk +0\.", said, re.M)


def test_a_worse_odometry_leaves_more_of_the_walk(walked):
    worse, _ = reproduced(*WALK[:2], "walk", *WALK[4:], "--degrade", "odom=10x", name="quadruped-mdr")
    assert worse["quadruped/walk/residual_rms"] > walked[0]["quadruped/walk/residual_rms"]


def test_a_worse_inertial_unit_is_calibrated_worse():
    usual, worse = (reproduced("--quick", "--parts", "imu", *more, name="calibration")[0] for more in ((), ("--degrade", "imu=4x")))
    for what in ("rotation_error", "translation_error"):
        assert worse[f"calibration/camera_imu/{what}"] > usual[f"calibration/camera_imu/{what}"]


def test_the_depth_camera_adds_what_lies_below_the_scanner(tmp_path):
    figures, said = reproduced("--quick", "--parts", "obstacles", "--out", tmp_path, name="quadruped")
    assert figures["pmf/obstacles/lidar_found"][0] <= 4, "four lie below its beams or between them"
    assert figures["pmf/obstacles/pmf_found"] == (8.0, "-")
    assert figures["pmf/phantom_cells"][0] <= 0.01
    assert figures["pmf/contour_completeness"][0] >= 0.9 > figures["pmf/contour_completeness/lidar"][0]
    assert re.search(r"^PMF +1 +8 .* stool chair football blue_cone ", said, re.M)
    assert (tmp_path / "quad_obstacles_maps_1.png").stat().st_size > 1000


@LONG
def test_a_box_that_leaves_the_view_stays_and_one_that_is_taken_away_goes(tmp_path):
    figures, _ = reproduced("--quick", "--parts", "view", "--out", tmp_path, name="quadruped")
    assert figures["pmf/view/after/lidar"][0] < 0.1, "the scanner passes over it"
    assert figures["pmf/view/before/pmf"][0] >= 0.9 and figures["pmf/view/after/pmf"][0] >= 0.9
    value, unit = figures["pmf/view/fades/pmf"]
    assert 0.0 < value < 10.0 and unit == "s"
    assert (tmp_path / "quad_view_after_1.png").stat().st_size > 1000


@LONG
def test_dimensions_of_the_laboratory_are_right_to_a_cell_on_deskewed_scans_alone(tmp_path):
    figures, said = reproduced("--quick", "--parts", "dimensions", "--out", tmp_path, name="quadruped")
    assert figures["pmf/dimensions/mdr_rmse"] <= (25.0, "mm") < figures["pmf/dimensions/raw_rmse"]
    assert re.search(r"^paper, RMSE +109 +59$", said, re.M) and re.search(r"^c_gap +0\.900 m ", said, re.M)
    with open(tmp_path / "quadruped_dimensions.csv") as file:
        assert len(list(csv.DictReader(file))) == 20
    assert (tmp_path / "quadruped_lab_1.png").stat().st_size > 1000


@LONG
def test_fused_maps_have_the_contours_that_the_scanner_passes_over(tmp_path):
    figures, said = reproduced("--quick", "--parts", "stack", "--out", tmp_path, name="quadruped")
    share = {form: figures[f"pmf/contour/stack/{form}_completeness"][0] for form in ("lidar", "pf", "pmf")}
    assert share["pmf"] > 0.8 and max(share["lidar"], share["pf"]) < share["pmf"] / 2
    assert figures["pmf/contour/alone/voxel_completeness"][0] > figures["pmf/contour/alone/scan_completeness"][0]
    assert re.search(r"^football +not there +[1-9]", said, re.M), "it lies below the scanner"
    assert re.search(r"^low_box +not there +not there +[1-9]", said, re.M)
    for name in ("alone", "stack"):
        assert (tmp_path / f"quadruped_{name}_1.png").stat().st_size > 1000


def test_latencies_of_the_quadrupeds_maps_are_told():
    figures, said = reproduced("--quick", "--parts", "latency", name="quadruped")
    assert 0.0 < figures["quadruped/latency/depth_to_projected_p99"][0] and 0.0 < figures["quadruped/latency/depth_to_map_p99"][0]
    assert figures["quadruped/latency/depth_to_map_p99"][1] == "ms" and "quadruped/latency/lost" in figures
    assert re.search(r"^ +1  fused +[1-9]", said, re.M)


@pytest.fixture
def untrained(tmp_path, monkeypatch):
    """A detector that has learnt nothing takes as long as another."""
    pytest.importorskip("torch", reason="python3-torch is not installed")
    pytest.importorskip("onnx", reason="python3-onnx is not installed")
    monkeypatch.setattr(sys, "path", [str(ROOT / "models"), *sys.path])
    from yolov8.export import export
    from yolov8.network import YoloV8

    export(YoloV8(2, width=0.125).eval(), ["boat", "buoy"], (160, 96), tmp_path / "untrained.onnx", {})
    return tmp_path / "untrained.onnx"


def test_latencies_are_told_of_the_lidar_and_with_a_detector(untrained):
    done = rosrun("reproduce", "usv", "--quick", "--parts", "latency", "--model", untrained)
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"^figure usv/latency/fused_p99/opencv_10hz_together [0-9.]+ ms n=[1-9]", done.stdout, re.M)
    assert re.search(r"^figure usv/latency/with_picture/opencv_10hz_together [0-9.]+ - n=20 ", done.stdout, re.M)
    assert re.search(r"^figure usv/latency/fused_p99 ", done.stdout, re.M) or "OpenVINO not measured" in done.stdout
    assert re.search(r"^figure usv/latency/lidar_p99 [0-9.]+ ms n=20 ", done.stdout.splitlines()[-1])


BAD = {  # what is asked for: what is said
    ("nothing",): "invalid choice: 'nothing'",
    ("usv", "--seeds", "0"): "0 is not a number of seeds",
    ("usv", "--seeds", "many"): "many is not a number of seeds",
    ("usv", "--degrade", "lidar=0.1x"): "lidar=0.1x is not SENSOR=FACTORx",
    ("usv", "--degrade", "lidar"): "lidar is not SENSOR=FACTORx",
    ("usv", "--detections", "truth", "--places", "0900"): "no such place: 0900",
    ("usv", "--detections", "truth", "--parts", "latency"): "the part latency needs a detector",
    ("quadruped-mdr", "--methods", "vicp"): "--methods must name mdr",
    ("quadruped", "--parts", "lunch"): "invalid choice: 'lunch'",
    ("usv", "--detections", "truth", "--model", "x.onnx"): "--model and --detections truth exclude one another",
    ("usv", "--model", "/nowhere/x.onnx"): "no such model: /nowhere/x.onnx",
    ("usv", "--detections", "truth", "--parts", "table1", "--places", "0200", "--degrade", "sonar=2x"):
        "no sensor sonar; there are camera, lidar",
}


@pytest.mark.parametrize("arguments", BAD)
def test_a_wrong_wish_is_answered_by_what_there_is(arguments):
    done = rosrun("reproduce", *arguments)
    assert done.returncode != 0 and BAD[arguments] in done.stderr, done.stdout + done.stderr
    assert "Traceback" not in done.stderr


def test_without_a_name_it_says_what_can_be_reproduced():
    done = rosrun("reproduce")
    assert done.returncode == 2 and "NAME" in done.stderr
