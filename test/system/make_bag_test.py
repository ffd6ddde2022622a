"""make_bag: what stands in its bags, and what is said when there is none."""
import collections
import math
import os
import signal
import subprocess
import time

import pytest
import rosbag

from conftest import ROOT, SETUP, rosrun

WORLDS = sorted(file.stem for file in (ROOT / "config/worlds").glob("*.yaml"))
LIDAR = """
ground: {kind: plane}
bodies:
  - {name: wall, shape: wall, params: {length: 8, width: 0.2, height: 2}, pose: [4, 0, 90]}
robot:
  pose: [0, 0, 0]
  mounts:
    - {name: scan, model: lms141, pose: [0, 0, 0.3], mount_error: {angle_deg: 0, place: 0}, clock_error: 0}
"""
CLOCK = 0.002  # s by which a clock is off at most


def make(world, bag, *more):
    done = rosrun("make_bag", world, bag, *more)
    assert done.returncode == 0, done.stderr
    return done


def read(bag_file):
    """{topic: [(time recorded, message)]}, each in its order."""
    messages = collections.defaultdict(list)
    with rosbag.Bag(str(bag_file)) as bag:
        for topic, message, stamp in bag.read_messages():
            messages[topic].append((stamp, message))
    return messages


def transforms(messages, *topics):
    return [t for topic in topics for _, message in messages[topic] for t in message.transforms]


def place(transform):
    where = transform.transform.translation
    return where.x, where.y, where.z


def world_file(folder, text):
    """Beside the sensors that come with the package."""
    (folder / "worlds").mkdir()
    (folder / "sensors").symlink_to(ROOT / "config/sensors")
    file = folder / "worlds/own.yaml"
    file.write_text(text)
    return file


@pytest.mark.parametrize("world", WORLDS)
def test_every_world_makes_a_bag_of_ordered_stamps_and_known_frames(world, tmp_path):
    make(world, tmp_path / "a.bag", "--seconds", "0.25")
    messages = read(tmp_path / "a.bag")
    frames = {name for t in transforms(messages, "/tf_static", "/tf") for name in (t.header.frame_id, t.child_frame_id)}
    sensors = [topic for topic in messages if not topic.startswith(("/truth/", "/tf"))]
    assert sensors and {"/truth/pose", "/truth/bodies", "/truth/grid", "/truth/markers", "/truth/moving_markers",
                        "/truth/tf_static"} <= set(messages)
    for topic in sensors:
        stamps = [message.header.stamp for _, message in messages[topic]]
        assert all(a < b for a, b in zip(stamps, stamps[1:])) and stamps[0].to_sec() >= 1000 - CLOCK
        assert all((message.header.stamp - time).to_sec() <= CLOCK for time, message in messages[topic])
        assert {message.header.frame_id for _, message in messages[topic]} <= frames, topic
    assert "world" not in frames  # the truth is not in /tf


def test_a_sensor_comes_at_its_rate_and_when_it_is_done(tmp_path):
    make(world_file(tmp_path, LIDAR), tmp_path / "a.bag", "--seconds", "1")
    scans = read(tmp_path / "a.bag")["/scan/scan"]
    assert len(scans) == 50  # the first is ready after 0.02 s, the last at 1 s
    for i, (recorded, scan) in enumerate(scans):
        assert scan.header.stamp.to_sec() == pytest.approx(1000 + 0.02 * i, abs=1e-8)
        assert (recorded - scan.header.stamp).to_sec() == pytest.approx(0.02, abs=1e-8)
        assert scan.ranges[135 * 2] == pytest.approx(3.9, abs=0.15)  # straight ahead


def test_a_picture_comes_when_its_exposure_ends(tmp_path):
    cameras = ("cam, model: camera_640, auto_exposure: false, exposure_time: 20", "auto, model: camera_640, max_exposure_time: 10")
    mounts = "".join(f"    - {{name: {camera}, pose: [0, 0, 0.5], clock_error: 0}}\n" for camera in cameras)
    make(world_file(tmp_path, LIDAR + mounts), tmp_path / "a.bag", "--seconds", "0.3")
    messages = read(tmp_path / "a.bag")
    for name, half in (("cam", 0.01), ("auto", 0.005)):
        pictures = messages[f"/{name}/image_raw"]
        assert pictures and all((time - m.header.stamp).to_sec() == pytest.approx(half, abs=1e-8) for time, m in pictures)


def test_motion_sensors_tell_their_errors(tmp_path):
    names = ("imu, model: bmi055", "wheels, model: wheel_odometry", "legs, model: leg_odometry")
    mounts = "".join(f"    - {{name: {name}}}\n" for name in names)
    moving = LIDAR.replace("pose: [0, 0, 0]\n", "motion: {points: [[0, 0], [2, 0]]}\n")
    make(world_file(tmp_path, moving + mounts), tmp_path / "a.bag", "--seconds", "2")
    messages = read(tmp_path / "a.bag")
    imu = messages["/imu/data"][0][1]
    assert imu.orientation_covariance[0] == -1  # sensor_msgs/Imu and REP-145: there is none
    # bmi055 at 200 Hz: noise of 0.014 deg/s/sqrt(Hz) over 100 Hz and a bias of 1 deg/s; 150 ug/sqrt(Hz) and 70 mg
    rate, force = math.radians(1) ** 2 * (0.14 ** 2 + 1), 9.80665e-3 ** 2 * (1.5 ** 2 + 70 ** 2)
    assert imu.angular_velocity_covariance == pytest.approx([rate, 0, 0, 0, rate, 0, 0, 0, rate])
    assert imu.linear_acceleration_covariance == pytest.approx([force, 0, 0, 0, force, 0, 0, 0, force])
    unknown = {"/wheels": ({2, 3, 4}, {1, 2, 3, 4}), "/legs": (set(), set())}
    for topic, (places, rates) in unknown.items():
        odometry = messages[topic][-1][1]
        for covariance, unseen in ((odometry.pose.covariance, places), (odometry.twist.covariance, rates)):
            for axis in range(6):
                assert covariance[7 * axis] == 1e6 if axis in unseen else 0 < covariance[7 * axis] < 1
            assert all(covariance[i] == 0 for i in range(36) if i % 7)


def test_truth_of_a_scan_has_no_error_and_names_the_body(tmp_path):
    make(world_file(tmp_path, LIDAR), tmp_path / "a.bag", "--seconds", "0.1")
    messages = read(tmp_path / "a.bag")
    scan, bodies = messages["/truth/scan/scan"][0][1], messages["/truth/bodies"][0][1].bodies
    assert scan.ranges[270] == pytest.approx(3.9, abs=1e-4)
    assert bodies[int(scan.intensities[270])].name == "wall"
    assert (bodies[0].pose.position.x, bodies[0].pose.position.z) == pytest.approx((4, 1))
    assert (bodies[0].size.x, bodies[0].size.y, bodies[0].size.z) == pytest.approx((8, 0.2, 2))


@pytest.mark.parametrize("world", ["usv_harbour", "quad_lab"])
def test_one_seed_is_one_bag_to_the_byte(world, tmp_path):
    for name, seed in (("a", 4), ("b", 4), ("c", 5)):
        make(world, tmp_path / name, "--seconds", "0.15", "--seed", seed)
    a, b, c = ((tmp_path / name).read_bytes() for name in "abc")
    assert a == b != c


def test_without_truth_the_sensors_say_the_same(tmp_path):
    def raw(name, *more):
        make("quad_lab", tmp_path / name, "--seconds", "0.2", *more)
        with rosbag.Bag(str(tmp_path / name)) as bag:
            return [(topic, message[1], stamp) for topic, message, stamp in bag.read_messages(raw=True)]

    whole, blind = raw("a"), raw("b", "--no-truth")
    assert [entry for entry in whole if not entry[0].startswith("/truth/")] == blind != whole


def test_a_wrong_clock_is_wrong_by_one_amount_of_its_seed(tmp_path):
    wrong = world_file(tmp_path, LIDAR.replace("clock_error: 0}", "clock_error: 0.01}"))
    errors = []
    for seed in (1, 2):
        make(wrong, tmp_path / "a.bag", "--seconds", "0.2", "--seed", seed)
        scans = read(tmp_path / "a.bag")["/scan/scan"]
        late = [scan.header.stamp.to_sec() - 1000 - 0.02 * i for i, (_, scan) in enumerate(scans)]
        assert max(late) - min(late) < 1e-6 and 0 < abs(late[0]) <= 0.01
        errors.append(late[0])
    assert errors[0] != errors[1]


def test_mounts_are_told_as_in_the_file_and_are_where_the_truth_says(tmp_path):
    loose = world_file(tmp_path, LIDAR.replace("place: 0}", "place: 0.3}"))
    places = []
    for seed in (1, 2):
        make(loose, tmp_path / "a.bag", "--seconds", "0.1", "--seed", seed)
        messages = read(tmp_path / "a.bag")
        (told,), (true,) = (transforms(messages, topic) for topic in ("/tf_static", "/truth/tf_static"))
        assert (told.header.frame_id, told.child_frame_id) == (true.header.frame_id, true.child_frame_id) == ("base", "scan")
        assert place(told) == pytest.approx((0, 0, 0.3), abs=1e-12)
        assert max(abs(a - b) for a, b in zip(place(told), place(true))) <= 0.3
        scan = messages["/truth/scan/scan"][0][1]
        assert scan.ranges[270] == pytest.approx(3.9 - place(true)[0], abs=1e-4)  # its rays start there
        places.append(place(true))
    assert places[0] != places[1]


def test_sizes_of_bodies_are_those_of_the_seed_and_told_by_the_truth_alone(tmp_path):
    widths = set()
    for seed in (1, 2, 3):
        make("usv_cages", tmp_path / "a.bag", "--seconds", "0.25", "--seed", seed, "--mounts", "lidar")
        for _, bodies in read(tmp_path / "a.bag")["/truth/bodies"]:
            (cage,) = (body for body in bodies.bodies if body.label == "cage")
            assert abs(cage.size.x / 0.5 - 1) <= 0.1001  # of the file: 0.5 m
            widths.add(cage.size.x)
    assert len(widths) == 3


FAULTS = {  # what is done to the world: what is said
    "no world nowhere": ("nowhere", "no world nowhere"),
    "sensor at zero rate": (LIDAR.replace("model: lms141", "model: lms141, rate: 0"), "own.yaml:8: robot.mounts[0].rate: "),
    "camera in a wall": (LIDAR.replace("pose: [0, 0, 0.3]", "pose: [4, 0, 0.3]"),
                         "own.yaml:8: robot.mounts[0]: the sensor scan is inside the body wall"),
    "two points at one time": (LIDAR.replace("  pose: [0, 0, 0]", "  motion: {points: [[0, 0], [0, 0]]}"), "own.yaml:6: robot.motion.points: "),
    "unknown key": (LIDAR.replace("kind: plane", "kind: plane, colour: red"), "own.yaml:2: ground.colour: unknown key"),
    "missing mesh": (LIDAR.replace("shape: wall, params: {length: 8, width: 0.2, height: 2}", "mesh: wall.obj"), "own.yaml:4: bodies[0].mesh: "),
    "negative size": (LIDAR.replace("width: 0.2", "width: -0.2"), "own.yaml:4: bodies[0].params: "),
    "robot leaves the terrain": (LIDAR.replace("kind: plane", "kind: rough, half_extent: 9").replace(
        "  pose: [0, 0, 0]", "  motion: {points: [[0, 0], [0, 10]]}"), "own.yaml:6: robot.motion.points: leaves the ground"),
    "unknown sensor": (LIDAR.replace("lms141", "lms142"), "own.yaml:8: robot.mounts[0].model: "),
    "no sensors": (LIDAR[:LIDAR.index("  mounts")], "own.yaml: the robot has no sensors"),
}


@pytest.mark.parametrize("what", FAULTS)
def test_a_fault_is_named_and_leaves_no_bag(what, tmp_path):
    text, said = FAULTS[what]
    out = tmp_path / "out"
    out.mkdir()
    done = rosrun("make_bag", text if text == "nowhere" else world_file(tmp_path, text), out / "a.bag", "--seconds", "0.1")
    assert done.returncode != 0 and said in done.stderr
    assert list(out.iterdir()) == []


def test_a_folder_that_is_not_there_is_named(tmp_path):
    done = rosrun("make_bag", "quad_lab", tmp_path / "no/a.bag")
    assert done.returncode != 0 and "no/a.bag" in done.stderr


@pytest.mark.parametrize("seconds", ["nan", "inf", "0", "-1"])
def test_a_length_that_is_none_is_refused(seconds, tmp_path):
    done = rosrun("make_bag", "quad_lab", tmp_path / "a.bag", "--seconds", seconds)
    assert done.returncode != 0 and "--seconds" in done.stderr + done.stdout
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("sign", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_run_leaves_no_bag(sign, tmp_path):
    bag = tmp_path / "a.bag"
    command = ["bash", "-c", '. "$0" && exec "$(catkin_find --first-only --libexec field_fusion make_bag)" "$@"', SETUP,
               "quad_lab", str(bag), "--seconds", "10000"]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    deadline = time.monotonic() + 60
    while not os.path.exists(f"{bag}.part") and time.monotonic() < deadline:
        time.sleep(0.01)
    process.send_signal(sign)
    assert process.wait(60) != 0 and "interrupted" in process.stderr.read()
    assert list(tmp_path.iterdir()) == []
