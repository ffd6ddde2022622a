"""Labelled boxes in the LiDAR's frame, against numbers that follow from the file."""
import math

import kitti_labels
import numpy
import pytest

# the LiDAR looks along x, the reference camera stands 0.3 m before it; the colour camera 0.06 m to its left
CALIBRATION = """P2: 100 0 32 6 0 100 24 0 0 0 1 0
R0_rect: 1 0 0 0 1 0 0 0 1
Tr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3
"""
CAR = "Car 0.00 0 -1.57 300 150 400 200 1.5 2.0 4.0 {x} {y} {z} {turn}"


@pytest.fixture
def calibration(tmp_path):
    (tmp_path / "calib.txt").write_text(CALIBRATION)
    return kitti_labels.read_calibration(tmp_path / "calib.txt")


@pytest.fixture
def read(tmp_path, calibration):
    def read(text):
        (tmp_path / "label.txt").write_text(text)
        return kitti_labels.read_object_labels(tmp_path / "label.txt", calibration)
    return read


def car(read, x=0.0, y=1.5, z=9.7, turn=-math.pi / 2):
    return read(CAR.format(x=x, y=y, z=z, turn=turn))[0]


def test_box_of_a_label_stands_where_the_camera_says(read):
    body = car(read, x=-2.0)  # 2 m to the left of the camera, its lower face 1.5 m below
    assert body.centre == pytest.approx([10.0, 2.0, -0.75])
    assert body.axes[0] == pytest.approx([1, 0, 0], abs=1e-9)  # ry = -pi/2: it drives away
    assert body.axes[1] == pytest.approx([0, 1, 0], abs=1e-9)
    assert (list(body.size), body.pixels_high) == ([4.0, 2.0, 1.5], 50)
    assert body.distance == pytest.approx(math.hypot(10, 2))


def test_points_belong_to_a_box_up_to_its_faces(read):
    body = car(read)  # x 8 to 12, y -1 to 1, z -1.5 to 0
    inside = numpy.array([[8.01, -0.99, -0.01], [11.99, 0.99, -1.49]])
    outside = numpy.array([[7.99, 0, -1], [12.01, 0, -1], [10, 1.01, -1], [10, -1.01, -1], [10, 0, 0.01], [10, 0, -1.51]])
    assert body.contains(inside).all() and not body.contains(outside).any()
    assert body.contains(outside, 0.02).all() and not body.contains(outside, 0.005).any()


def test_turned_box_holds_what_the_turn_brings_in(read):
    body = car(read, turn=-math.pi / 4)  # its front to the right of straight ahead
    along = numpy.array([math.sqrt(0.5), -math.sqrt(0.5), 0])
    assert body.contains(body.centre + [1.95 * along, -1.95 * along]).all()
    assert not body.contains(body.centre + [1.95 * along * [1, -1, 1]]).any()


@pytest.mark.parametrize("x, z, turn, nearest", [
    (0.0, 9.7, -math.pi / 2, 8.0),  # straight ahead: its rear
    (-5.0, 9.7, -math.pi / 2, math.hypot(8, 4)),  # to the left: a corner
    (-5.0, -0.3, -math.pi / 2, 4.0),  # abeam: its side
    (0.0, 9.7, -math.pi / 4, math.hypot(math.sqrt(50) - 2, math.sqrt(50) - 1)),  # turned by 45 degrees: a corner
    (0.0, 0.0, -math.pi / 2, 0.0)])  # within
def test_nearest_of_a_box(read, x, z, turn, nearest):
    assert car(read, x=x, z=z, turn=turn).nearest_range() == pytest.approx(nearest)


def test_azimuth_is_the_middle_of_what_is_seen(read):
    body = car(read, x=-5.0)  # corners at x 8, 12 and y 4, 6
    assert body.azimuth() == pytest.approx((math.atan2(4, 12) + math.atan2(6, 8)) / 2)
    behind = numpy.array([[-10.0, 1.0], [-10.0, -2.0]])  # across the cut at half a turn
    middle = math.pi + (math.atan2(2, 10) - math.atan2(1, 10)) / 2
    assert math.cos(kitti_labels.middle_azimuth(behind) - middle) == pytest.approx(1.0)


def test_camera_and_lidar_agree_on_a_point(calibration):
    point = numpy.array([[10.3, 1.06, 0.5]])  # 10 m before the camera; 1 m to the left of the colour camera
    assert calibration.pixels(point)[0] == pytest.approx([32 - 100 / 10, 24 - 50 / 10])
    assert numpy.isnan(calibration.pixels(-point)).all()
    assert calibration.from_colour_camera(numpy.array([[-1.0, -0.5, 10.0]])) == pytest.approx(point)


def test_tracking_labels_go_by_frame(tmp_path, calibration):
    (tmp_path / "label.txt").write_text(
        f"0 -1 DontCare -1 -1 -10 1 2 3 4 -1 -1 -1 -1000 -1000 -1000 -10\n\n7 3 {CAR.format(x=0, y=1, z=2, turn=0)}\n")
    frames = kitti_labels.read_tracking_labels(tmp_path / "label.txt", lambda frame: calibration)
    assert sorted(frames) == [0, 7]
    assert (frames[0][0].kind, frames[0][0].image_box) == ("DontCare", (1, 2, 3, 4))
    assert (frames[7][0].kind, frames[7][0].track) == ("Car", 3)


@pytest.mark.parametrize("text, complaint", [
    ("Boat" + CAR[3:], "2: should name one of"), (CAR[:-7], "2: should have 14 numbers behind Car, has 13"),
    (CAR.replace(" 1.5", " high"), "could not convert"), (CAR.replace(" 1.5", " nan"), "2: a number is not finite"),
    (CAR.replace("2.0", "0"), "2: the size of the Car is not above zero")])
def test_fault_in_a_label_is_named_with_its_line(read, text, complaint):
    with pytest.raises(kitti_labels.BadFile) as fault:
        read("\n" + text.format(x=0, y=0, z=0, turn=0))
    assert "label.txt:2" in str(fault.value) and complaint in str(fault.value)


def test_fault_in_a_tracking_label_is_named_with_its_line(tmp_path):
    (tmp_path / "label.txt").write_text("Car 1\n")
    with pytest.raises(kitti_labels.BadFile, match="label.txt:1: .* frame"):
        kitti_labels.read_tracking_labels(tmp_path / "label.txt", None)


@pytest.mark.parametrize("old, new, complaint", [
    ("R0_rect", "R1_rect", "R0_rect should be 9 numbers, has 0"), ("-0.3", "", "Tr_velo_to_cam should be 12 numbers, has 11"),
    ("P2: 100", "P2: wide", ":1: could not convert"), ("P2: 100", "P2: 0", "P2 cannot be inverted")])
def test_fault_in_a_calibration_is_named(tmp_path, old, new, complaint):
    (tmp_path / "calib.txt").write_text(CALIBRATION.replace(old, new))
    with pytest.raises(kitti_labels.BadFile) as fault:
        kitti_labels.read_calibration(tmp_path / "calib.txt")
    assert "calib.txt" in str(fault.value) and complaint in str(fault.value)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(kitti_labels.BadFile, match="nowhere.txt"):
        kitti_labels.read_calibration(tmp_path / "nowhere.txt")
