"""kitti_to_bag: what stands in its bags, and what is said when there is none."""
import struct

import cv2
import numpy
import pytest
import rosbag

from conftest import rosrun

CALIBRATION = """P2: 100 0 32 6 0 100 24 0 0 0 1 0
R0_rect: 1 0 0 0 1 0 0 0 1
Tr_velo_to_cam: 0 -1 0 0 0 0 -1 -0.1 1 0 0 -0.2
"""


def read(bag_file):
    """Messages by topic, in the order of time, and whether each topic is latched."""
    messages, latched = {}, {}
    with rosbag.Bag(str(bag_file)) as bag:
        for topic, message, stamp in bag.read_messages():
            assert stamp == (message.transforms[0].header.stamp if topic == "/tf_static" else message.header.stamp)
            messages.setdefault(topic, []).append(message)
        for connection in bag._get_connections():
            latched[connection.topic] = connection.header.get("latching") == b"1"
    return messages, latched


@pytest.fixture
def drive(tmp_path):
    """Two frames in KITTI's layout, two points each."""
    folder = tmp_path / "drive"
    for name in ("velodyne", "image_2"):
        (folder / name).mkdir(parents=True)
    (folder / "calib.txt").write_text(CALIBRATION)
    for i in range(2):
        (folder / f"velodyne/00000{i}.bin").write_bytes(struct.pack("8f", 10, 0, 0, 0.5, 0, 10, 0, 0.25))
        cv2.imwrite(str(folder / f"image_2/00000{i}.png"), numpy.full((48, 64, 3), (100 * i, 20, 30), numpy.uint8))
    return folder


def convert(drive, *more):
    bag = drive.parent / "out.bag"
    done = rosrun("kitti_to_bag", drive, bag, *more)
    assert done.returncode == 0, done.stderr
    return done.stdout, *read(bag)


def test_kitti_frames_have_cloud_image_and_camera_of_one_stamp(drive):
    _, messages, _ = convert(drive)
    assert {topic: len(list_) for topic, list_ in messages.items()} == {
        "/points": 2, "/image_raw": 2, "/camera_info": 2, "/tf_static": 1}
    stamps = [m.header.stamp for m in messages["/points"]]
    assert stamps[0].to_sec() > 0 and (stamps[1] - stamps[0]).to_nsec() == 100_000_000
    for topic, frame in (("/points", "lidar"), ("/image_raw", "camera_optical"), ("/camera_info", "camera_optical")):
        assert [m.header.stamp for m in messages[topic]] == stamps
        assert {m.header.frame_id for m in messages[topic]} == {frame}


def test_kitti_cloud_and_image_are_those_of_the_files(drive):
    _, messages, _ = convert(drive)
    cloud, image, info = (messages[topic][1] for topic in ("/points", "/image_raw", "/camera_info"))
    assert [field.name for field in cloud.fields] == ["x", "y", "z", "intensity", "time", "ring"]
    assert struct.unpack_from("<5fH", cloud.data, cloud.point_step) == (0, 10, 0, 0.25, pytest.approx(0.025), 57)
    assert (image.encoding, image.width, image.height, image.data[:3]) == ("bgr8", 64, 48, bytes((100, 20, 30)))
    assert (info.width, info.height, info.K[0], info.K[2]) == (64, 48, 100, 32)


def test_kitti_transforms_are_static_and_latched(drive):
    _, messages, latched = convert(drive)
    assert [topic for topic in latched if latched[topic]] == ["/tf_static"]
    base, camera = messages["/tf_static"][0].transforms
    assert (base.header.frame_id, base.child_frame_id) == ("base_link", "lidar")
    assert base.transform.translation.z == 1.73
    assert (camera.header.frame_id, camera.child_frame_id) == ("lidar", "camera_optical")
    where = camera.transform.translation  # P2 puts the colour camera 0.06 m to the left of the reference
    assert (where.x, where.y, where.z) == pytest.approx((0.2, 0.06, -0.1))


def test_kitti_repeat_goes_on_in_time(drive):
    _, messages, _ = convert(drive, "--repeat", "3", "--rate", "5", "--start", "50")
    assert [m.header.stamp.to_sec() for m in messages["/points"]] == pytest.approx([50 + 0.2 * i for i in range(6)])


def test_kitti_turn_of_the_scanner_takes_its_time_at_any_rate(drive):
    for more, time in (((), 0.025), (("--turn", "0.05"), 0.0125)):  # of a point to the left
        _, messages, _ = convert(drive, "--rate", "0.2", *more)
        cloud = messages["/points"][1]
        assert struct.unpack_from("<5f", cloud.data, cloud.point_step)[4] == pytest.approx(time)


def test_kitti_new_calibration_is_written_when_it_changes(drive):
    (drive / "calib").mkdir()
    for i in range(2):
        (drive / f"calib/00000{i}.txt").write_text(CALIBRATION.replace("-0.2", f"-0.{2 + i}"))
    _, messages, _ = convert(drive)
    assert [m.transforms[1].transform.translation.x for m in messages["/tf_static"]] == pytest.approx([0.2, 0.3])


def test_kitti_without_images_gives_clouds_and_says_so(drive):
    for file in (drive / "image_2").iterdir():
        file.unlink()
    (drive / "image_2").rmdir()
    said, messages, _ = convert(drive)
    assert "no images" in said
    assert set(messages) == {"/points", "/tf_static"}


def spoil(drive, what):
    if what == "no frames":
        for file in (drive / "velodyne").iterdir():
            file.unlink()
    elif what == "000001.bin":
        (drive / "velodyne/000001.bin").write_bytes(b"x" * 17)
    elif what == "differ in number":
        (drive / "image_2/000001.png").unlink()
    elif what == "cannot read image":
        (drive / "image_2/000001.png").write_bytes(b"no image")
    elif what == "no Tr_velo_to_cam":
        (drive / "calib.txt").write_text(CALIBRATION.replace("Tr_velo_to_cam", "Tr"))
    elif what == "no such folder":
        drive.rename(drive.parent / "elsewhere")


@pytest.mark.parametrize("what", ["no frames", "000001.bin", "differ in number", "cannot read image",
                                  "no Tr_velo_to_cam", "no such folder"])
def test_kitti_fault_is_named_and_leaves_no_bag(drive, what):
    spoil(drive, what)
    bag = drive.parent / "out" / "a.bag"
    bag.parent.mkdir()
    done = rosrun("kitti_to_bag", drive, bag)
    assert done.returncode != 0
    assert what in done.stderr
    assert list(bag.parent.iterdir()) == []
