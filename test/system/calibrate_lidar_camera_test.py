"""calibrate_lidar_camera: the place of a simulated LiDAR and scanner found from a bag, and what is said of bags that tell nothing."""
import re
import sys

import cv2
import numpy
import pytest
import rosbag
import yaml

from conftest import ROOT, rosrun

sys.path.insert(0, str(ROOT / "scripts/support"))
import calibration_world  # noqa: E402
import poses  # noqa: E402
import sim_bag  # noqa: E402

POSES = 8
TOPICS = ("--board", calibration_world.BOARD, "--image", "/camera/image_raw", "--camera-info", "/camera/camera_info")


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    folder = tmp_path_factory.mktemp("calibration")
    (folder / "worlds").mkdir()
    (folder / "sensors").symlink_to(ROOT / "config/sensors")
    world = folder / "worlds/boards.yaml"
    world.write_text(yaml.safe_dump(calibration_world.world("boards", 7, POSES)))
    done = rosrun("make_bag", world, folder / "boards.bag", "--seconds", POSES * calibration_world.REST)
    assert done.returncode == 0, done.stderr
    return folder / "boards.bag"


def calibrate(bag, *more):
    return rosrun("calibrate_lidar_camera", bag, *more)


@pytest.mark.parametrize("topic, frame, more", [
    ("/lidar/points", "lidar", ("--range-offset", "0.01")),
    ("/lidar/points", "lidar", ("--range-offset", "0.01", "--ignore-tf")),
    ("/scan/scan", "scan", ("--range-offset", "0.005", "--range-scale", "0.003")),
])
def test_the_place_is_found_within_what_is_stated(bag, topic, frame, more, tmp_path):
    done = calibrate(bag, *TOPICS, "--lidar", topic, "--out", tmp_path / "out", *more)
    assert done.returncode == 0, done.stdout + done.stderr
    result = yaml.safe_load((tmp_path / "out/calibration.yaml").read_text())
    assert (result["camera_frame"], result["lidar_frame"]) == ("camera_optical", frame)
    truth = sim_bag.true_transform(bag, "camera_optical", frame)
    off = poses.chart(numpy.array(result["T_camera_lidar"]), truth)
    deviations = numpy.sqrt(numpy.diag(numpy.array(result["covariance"])))
    assert numpy.all(numpy.abs(off) < 5 * deviations)
    # what 30 poses must reach (0.1 deg and 3 mm; a scanner 0.3 deg and 10 mm), by as much more as fewer poses tell less
    fewer = (30 / POSES) ** 0.5
    turn, shift = (0.3, 0.010) if frame == "scan" else (0.1, 0.003)
    assert numpy.degrees(numpy.linalg.norm(off[:3])) < fewer * turn
    assert numpy.linalg.norm(off[3:]) < fewer * shift
    assert len(re.findall(r"^pose_\d+ ", done.stdout, re.M)) >= POSES - 1
    pictures = sorted((tmp_path / "out").glob("pose_*.png"))
    assert len(pictures) >= POSES - 1 and cv2.imread(str(pictures[0])).shape == (540, 720, 3)


def test_the_launch_file_tells_the_same_as_the_table(bag, tmp_path):
    assert calibrate(bag, *TOPICS, "--lidar", "/lidar/points", "--out", tmp_path).returncode == 0
    found = numpy.array(yaml.safe_load((tmp_path / "calibration.yaml").read_text())["T_camera_lidar"])
    numbers = re.search(r'args="([^"]+) lidar camera_optical"', (tmp_path / "static_transform.launch").read_text())[1].split()
    assert numpy.allclose([float(n) for n in numbers[:3]], numpy.linalg.inv(found)[:3, 3], atol=1e-6)


def test_squares_of_another_size_are_told(bag, tmp_path):
    columns, rows, square = calibration_world.BOARD.split("x")
    wrong = f"{columns}x{rows}x{0.97 * float(square):.4f}"
    done = calibrate(bag, "--board", wrong, *TOPICS[2:], "--lidar", "/lidar/points", "--range-offset", "0.01", "--out", tmp_path)
    told = re.search(r"WARNING: squares of (\S+) m, not of", done.stdout)
    assert done.returncode == 0 and told, done.stdout + done.stderr
    assert abs(float(told[1]) - float(square)) < 0.01 * float(square)
    right = calibrate(bag, *TOPICS, "--lidar", "/lidar/points", "--range-offset", "0.01", "--out", tmp_path)
    assert right.returncode == 0 and "WARNING" not in right.stdout, right.stdout


BAD = {
    ("--board", "8x6"): "board 8x6 is not COLUMNSxROWSxSQUARE",
    ("--board", "9x7x0.1", "--image", "/camera/image_raw", "--lidar", "/lidar/points"): "no picture shows the whole board 9x7x0.1",
    (*TOPICS,): "--lidar is needed; there are",
    (*TOPICS, "--lidar", "/camera/image_raw"): "--lidar /camera/image_raw is no topic of that type",
    (*TOPICS, "--lidar", "/lidar/points", "--rest", "50"): "the board rests nowhere",
}


@pytest.mark.parametrize("arguments", BAD)
def test_a_wrong_wish_is_answered_by_what_is_there(bag, arguments, tmp_path):
    done = calibrate(bag, *arguments, "--out", tmp_path)
    assert done.returncode == 1 and BAD[arguments] in done.stderr, done.stdout + done.stderr


def changed(bag, file, change):
    """The bag with messages as `change(topic, message)` leaves them."""
    with rosbag.Bag(str(bag)) as whole, rosbag.Bag(str(file), "w") as out:
        for topic, message, stamp in whole.read_messages():
            change(topic, message)
            out.write(topic, message, stamp)
    return file


def odd_encoding(topic, message):
    if topic == "/camera/image_raw":
        message.encoding = "of_my_own"


def no_lens(topic, message):
    if topic == "/camera/camera_info":
        message.K = [0.0] * 9


def half_a_picture(topic, message):
    if topic == "/camera/image_raw":
        message.data = message.data[:len(message.data) // 2]


def no_frame(topic, message):
    if topic == "/camera/camera_info":
        message.header.frame_id = ""


@pytest.mark.parametrize("change, words", [
    (no_frame, "bad.bag: /camera/camera_info: header.frame_id is empty"),
    (odd_encoding, "bad.bag: /camera/image_raw, stamp"), (half_a_picture, "bad.bag: /camera/image_raw, stamp"),
    (no_lens, "bad.bag: /camera/camera_info: camera info is not calibrated"),
])
def test_a_damaged_message_is_named_by_bag_and_topic(bag, change, words, tmp_path):
    done = calibrate(changed(bag, tmp_path / "bad.bag", change), *TOPICS, "--lidar", "/lidar/points", "--out", tmp_path / "out")
    assert done.returncode == 1 and words in done.stderr, done.stdout + done.stderr


@pytest.mark.parametrize("tool", ["calibrate_lidar_camera", "calibrate_camera_imu"])
def test_what_is_no_bag_is_named(tool, tmp_path):
    text = tmp_path / "a.bag"
    text.write_text("no bag\n")
    done = rosrun(tool, text, "--board", calibration_world.BOARD)
    assert done.returncode == 1 and f"{text} is no bag that can be read" in done.stderr, done.stderr


def spoilt(topic, message):
    if topic == "/scan/scan":
        message.angle_increment = float("nan")


def test_a_damaged_scan_is_no_fault_of_the_board(bag, tmp_path):
    done = calibrate(changed(bag, tmp_path / "bad.bag", spoilt), *TOPICS, "--lidar", "/scan/scan", "--out", tmp_path / "out")
    assert done.returncode == 1 and "bad.bag: /scan/scan, stamp" in done.stderr, done.stdout + done.stderr


def test_a_number_that_is_none_is_refused(bag, tmp_path):
    done = calibrate(bag, *TOPICS, "--lidar", "/lidar/points", "--rest", "nan", "--out", tmp_path)
    assert done.returncode != 0 and "not finite" in done.stdout + done.stderr


def test_a_board_in_two_poses_is_refused(bag, tmp_path):
    short = tmp_path / "short.bag"
    with rosbag.Bag(str(bag)) as whole, rosbag.Bag(str(short), "w") as out:
        begin = whole.get_start_time()
        for topic, message, stamp in whole.read_messages():
            if stamp.to_sec() - begin < 2 * calibration_world.REST:
                out.write(topic, message, stamp)
    done = calibrate(short, *TOPICS, "--lidar", "/lidar/points", "--out", tmp_path)
    assert done.returncode == 1 and "three at least" in done.stderr, done.stdout + done.stderr
