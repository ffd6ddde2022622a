"""bag_to_images: pictures and labels of bags made by hand, and what is said when there are none."""
import cv2
import numpy
import pytest
import rosbag
import rospy
from sensor_msgs.msg import CompressedImage, Image

from conftest import rosrun

WIDTH, HEIGHT = 64, 48


def picture(i):
    return numpy.full((HEIGHT, WIDTH, 3), (20 * i, 100, 200), numpy.uint8)  # blue, green, red


def stamped(message, i):
    message.header.stamp = rospy.Time(100 + i)
    return message


def raw(i, encoding="bgr8"):
    message = stamped(Image(), i)
    colours = picture(i) if encoding == "bgr8" else picture(i)[:, :, ::-1]
    message.width, message.height, message.encoding, message.step = WIDTH, HEIGHT, encoding, 3 * WIDTH
    message.data = numpy.ascontiguousarray(colours).tobytes()
    return message


def packed(i, suffix):
    message = stamped(CompressedImage(), i)
    message.format = suffix[1:]
    message.data = cv2.imencode(suffix, picture(i))[1].tobytes()
    return message


def boxes(i, *found):
    from field_fusion.msg import ImageDetection, ImageDetectionArray
    message = stamped(ImageDetectionArray(), i)
    message.width, message.height = WIDTH, HEIGHT
    for label, score, x_min, y_min, x_max, y_max in found:
        message.detections.append(ImageDetection(label=label, score=score, x_min=x_min, y_min=y_min, x_max=x_max, y_max=y_max))
    return message


def write(file, *messages):
    """(topic, message) in the order of their stamps."""
    with rosbag.Bag(str(file), "w") as bag:
        for topic, message in messages:
            bag.write(topic, message, message.header.stamp)
    return file


def convert(bag, *more):
    out = bag.parent / "out"
    done = rosrun("bag_to_images", bag, out, *more)
    assert done.returncode == 0, done.stderr
    return out, done.stdout


@pytest.mark.parametrize("message", [raw, lambda i: raw(i, "rgb8"), lambda i: packed(i, ".png"), lambda i: packed(i, ".jpg")])
def test_each_picture_is_a_file_of_its_number(message, tmp_path):
    out, said = convert(write(tmp_path / "drive.bag", *(("/image", message(i)) for i in range(3))))
    assert sorted(file.name for file in out.iterdir()) == [f"drive_00000{i}.jpg" for i in range(3)]
    assert "3 pictures of 3" in said
    for i in range(3):
        colour = cv2.imread(str(out / f"drive_00000{i}.jpg"))[20, 30]
        assert numpy.abs(colour.astype(int) - (20 * i, 100, 200)).max() <= 3


def test_a_jpeg_stays_as_it_is(tmp_path):
    message = packed(1, ".jpg")
    out, _ = convert(write(tmp_path / "a.bag", ("/image", message)))
    assert (out / "a_000000.jpg").read_bytes() == message.data


def test_every_third_picture_keeps_its_number(tmp_path):
    out, _ = convert(write(tmp_path / "a.bag", *(("/image", raw(i)) for i in range(8))), "--every", "3")
    assert sorted(file.name for file in out.iterdir()) == ["a_000000.jpg", "a_000003.jpg", "a_000006.jpg"]


def test_labels_are_shares_of_the_picture_and_leave_out_what_hardly_shows(tmp_path):
    found = [("boat", 0.9, 16, 12, 48, 36), ("ball", 0.19, 0, 0, 30, 30), ("cage", 0.2, 0, 0, 64, 48), ("buoy", 1, 2, 2, 6, 6)]
    bag = write(tmp_path / "a.bag", ("/image", raw(0)), ("/boxes", boxes(0, *found)), ("/image", raw(1)), ("/boxes", boxes(1)))
    out, _ = convert(bag, "--labels", "/boxes", "--set", "val")
    lines = (out / "labels/val/a_000000.txt").read_text().splitlines()
    assert [[float(word) for word in line.split()] for line in lines] == [[1, 0.5, 0.5, 0.5, 0.5], [0, 0.5, 0.5, 1, 1]]
    assert (out / "labels/val/a_000001.txt").read_text() == ""
    assert sorted(file.name for file in (out / "images/val").iterdir()) == ["a_000000.jpg", "a_000001.jpg"]
    lines = convert(bag, "--labels", "/boxes", "--min-score", "0", "--min-area", "0")[0] / "labels/a_000000.txt"
    assert len(lines.read_text().splitlines()) == 4


def test_a_picture_without_boxes_of_its_stamp_is_left_out_and_told(tmp_path):
    bag = write(tmp_path / "a.bag", ("/image", raw(0)), ("/image", raw(1)), ("/boxes", boxes(1)))
    out, said = convert(bag, "--labels", "/boxes")
    assert [file.name for file in (out / "images").iterdir()] == ["a_000001.jpg"]
    assert "1 left out" in said


def test_damaged_pictures_are_told_and_the_rest_is_written(tmp_path):
    cut, empty, strange = packed(0, ".jpg"), stamped(CompressedImage(), 1), raw(2)
    cut.data, strange.encoding = cut.data[:len(cut.data) // 2], "plaid"
    bag = write(tmp_path / "a.bag", ("/image", cut), ("/image", empty), ("/image", packed(3, ".png")))
    done = rosrun("bag_to_images", bag, tmp_path / "out")
    assert done.returncode != 0 and "1 pictures of 3" in done.stdout and "2 left out as damaged" in done.stdout
    assert "/image, picture 0 of stamp 100" in done.stderr and "picture 1 of stamp 101" in done.stderr
    assert [file.name for file in (tmp_path / "out").iterdir()] == ["a_000002.jpg"]
    done = rosrun("bag_to_images", write(tmp_path / "b.bag", ("/image", strange), ("/image", raw(3))), tmp_path / "out_b")
    assert "picture 0 of stamp 102" in done.stderr and "1 pictures of 2" in done.stdout


def test_boxes_are_cut_at_the_border_of_the_picture(tmp_path):
    bag = write(tmp_path / "a.bag", ("/image", raw(0)), ("/boxes", boxes(0, ("boat", 1, -30, 24, 32, 100), ("boat", 1, 70, 0, 100, 48))))
    lines = (convert(bag, "--labels", "/boxes")[0] / "labels/a_000000.txt").read_text().splitlines()
    assert [[float(word) for word in line.split()] for line in lines] == [[1, 0.25, 0.75, 0.5, 0.5]]


@pytest.mark.parametrize("box, size", [((float("nan"), 1, 9, 9), WIDTH), ((30, 1, 9, 9), WIDTH), ((1, 1, 9, 9), 0)])
def test_impossible_boxes_are_refused_by_their_stamp(box, size, tmp_path):
    message = boxes(0, ("boat", 1, *box))
    message.width = size
    done = rosrun("bag_to_images", write(tmp_path / "a.bag", ("/image", raw(0)), ("/boxes", message)), tmp_path / "out", "--labels", "/boxes")
    assert done.returncode != 0 and "boxes of stamp 100" in done.stderr


FAULTS = {  # arguments: what is said
    ("--topic", "/none"): "no topic /none; the bag has images on /left, /right",
    (): "--topic is needed; the bag has images on /left, /right",
    ("--topic", "/boxes"): "/boxes has no images but field_fusion/ImageDetectionArray",
    ("--topic", "/left", "--labels", "/right"): "/right has no ImageDetectionArray but sensor_msgs/Image",
    ("--topic", "/left", "--labels", "/none"): "nothing on /none",
    ("--topic", "/left", "--labels", "/boxes"): "class dragon is not in the list",
    ("--topic", "/left", "--labels", "/boxes", "--classes", "/none.yaml"): "/none.yaml",
}


@pytest.mark.parametrize("arguments", FAULTS)
def test_a_fault_is_named(arguments, tmp_path):
    bag = write(tmp_path / "a.bag", ("/left", raw(0)), ("/right", raw(0)), ("/boxes", boxes(0, ("dragon", 1, 0, 0, 30, 30))))
    done = rosrun("bag_to_images", bag, tmp_path / "out", *arguments)
    assert done.returncode != 0 and FAULTS[arguments] in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_bag_without_pictures_is_told(tmp_path):
    done = rosrun("bag_to_images", write(tmp_path / "a.bag", ("/boxes", boxes(0))), tmp_path / "out")
    assert done.returncode != 0 and "the bag has no images" in done.stderr
