"""What ROS's camera_calibration writes is what the detector reads (docs/calibration.md)."""
import cv2
import numpy
import pytest
from conftest import ROOT
from ros_session import RosSession

calibrator = pytest.importorskip("camera_calibration.calibrator")

SIZE, FOCAL, CENTRE = (640, 360), 245.5, (322.0, 177.0)  # px: 105 degrees wide
BARREL = (-0.05, 0.01, 0.0, 0.0, 0.0)


def corners_seen(board, draw):
    """Pixels of the inner corners of a board somewhere before the camera."""
    camera = numpy.array([[FOCAL, 0, CENTRE[0]], [0, FOCAL, CENTRE[1]], [0, 0, 1]])
    grid = numpy.array([[column * board.dim, row * board.dim, 0] for row in range(board.n_rows)
                        for column in range(board.n_cols)])
    turn, place = draw.uniform(-0.5, 0.5, 3), draw.uniform((-0.8, -0.5, 0.6), (0.1, 0.1, 1.2))
    pixels, _ = cv2.projectPoints(grid, turn, place, camera, numpy.array(BARREL))
    return pixels.astype(numpy.float32)


@pytest.fixture(scope="module")
def calibration():
    board = calibrator.ChessboardInfo("chessboard", 8, 6, 0.1)
    mono, draw = calibrator.MonoCalibrator([board]), numpy.random.default_rng(1)
    mono.size = SIZE
    mono.cal_fromcorners([(corners_seen(board, draw), None, board) for _ in range(30)])
    return mono


def test_simulated_boards_give_the_cameras_numbers(calibration):
    assert calibration.intrinsics[0, 0] == pytest.approx(FOCAL, abs=0.5)
    assert calibration.intrinsics[:2, 2] == pytest.approx(CENTRE, abs=0.5)


def test_detector_starts_with_its_file(calibration, tmp_path):
    file = tmp_path / "ost.yaml"
    file.write_text(calibration.yaml())
    with RosSession(tmp_path) as session:
        node = session.start("rosrun", "nodelet", "nodelet", "standalone", "field_fusion/detect",
                             f"_model:={ROOT}/test/fixtures/stock_head.onnx", f"_camera_info_url:=file://{file}")
        session.require(lambda: any(topic == "/detections" for topic, _ in session.system_state()[0]), 30.0,
                        "the detector did not start", node)
