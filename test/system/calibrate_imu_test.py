"""Noise of an inertial unit: from numbers drawn with known noise, and of the simulator's through a bag."""
import math

import numpy
import pytest
import rosbag
import rospy
import yaml
from sensor_msgs.msg import Imu

import allan
from conftest import rosrun

RATE = 200.0  # Hz


def slow_variance(samples, m):
    """By the definition: half the mean square of the difference of means of m neighbours, at every place."""
    means = [numpy.mean(samples[i:i + m]) for i in range(len(samples) - m + 1)]
    return 0.5 * numpy.mean([(means[i + m] - means[i]) ** 2 for i in range(len(means) - m)])


def test_variances_are_those_of_the_definition():
    samples = numpy.random.default_rng(1).normal(3.0, 1.0, 300)
    times, found, _ = allan.variances(samples, 0.1)
    for time, variance in zip(times, found):
        assert variance == pytest.approx(slow_variance(samples, round(time / 0.1)), rel=1e-9)


@pytest.mark.parametrize("density, walk", [(0.01, 0.0), (0.01, 0.002), (0.0, 0.002)])
def test_drawn_noises_are_found(density, walk):
    draw, count = numpy.random.default_rng(2), 400_000
    white = draw.normal(0.0, density * math.sqrt(RATE), count)
    samples = white + numpy.cumsum(draw.normal(0.0, walk / math.sqrt(RATE), count))
    found = allan.noises(*allan.variances(samples, 1 / RATE))
    if density:
        assert found.density == pytest.approx(density, rel=0.03)
    if walk:
        assert found.walk == pytest.approx(walk, rel=0.2)
    else:
        assert found.walk is None


def test_too_few_samples_are_refused():
    with pytest.raises(ValueError, match="too few"):
        allan.variances(numpy.zeros(10), 0.1)


WORLD = """
ground: {kind: plane}
robot: {pose: [0, 0], mounts: [{name: imu, model: bmi055, pose: [0, 0, 0.5], gyro_walk: 0, accel_walk: 0}]}
"""


def test_the_simulators_densities_come_back(tmp_path):
    (tmp_path / "still.yaml").write_text(WORLD)
    bag = tmp_path / "still.bag"
    assert rosrun("make_bag", tmp_path / "still.yaml", bag, "--seconds", "60").returncode == 0
    done = rosrun("calibrate_imu", bag, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    found = yaml.safe_load((tmp_path / "out/imu.yaml").read_text())
    assert found["rostopic"] == "/imu/data" and found["update_rate"] == pytest.approx(RATE, abs=0.01)
    # a data sheet's one-sided density is sqrt(2) of this one; of three axes the worst
    assert found["gyroscope_noise_density"] == pytest.approx(math.radians(0.014) / math.sqrt(2), rel=0.05)
    assert found["accelerometer_noise_density"] == pytest.approx(150e-6 * 9.80665 / math.sqrt(2), rel=0.05)
    assert {file.name for file in (tmp_path / "out").iterdir()} == {"imu.yaml", "allan.csv", "allan.png"}


def recording(file, change=lambda i, message: message, seconds=25):
    draw = numpy.random.default_rng(3)
    with rosbag.Bag(str(file), "w") as bag:
        for i in range(int(seconds * 50)):
            message = Imu()
            message.header.stamp = rospy.Time.from_sec(1000 + i / 50)
            w, a = message.angular_velocity, message.linear_acceleration
            w.x, w.y, w.z, a.x, a.y, a.z = draw.normal(0, 0.01, 6)
            message = change(i, message)
            if message:
                bag.write("imu", message, rospy.Time.from_sec(1000 + i / 50))
    return file


def moved(i, message):
    message.angular_velocity.z += i > 600
    return message


def broken(i, message):
    message.linear_acceleration.x = math.nan if i == 600 else 0.0
    return message


def back(i, message):
    message.header.stamp -= rospy.Duration(5.0 if i >= 600 else 0.0)
    return message


def dead(i, message):
    message.angular_velocity.y = 0.0
    return message


def huge(i, message):
    message.linear_acceleration.z = 1e200 if i == 600 else 0.0
    return message


def slow(i, message):
    message.header.stamp = rospy.Time.from_sec(1000 + 2.5 * i)
    return message


@pytest.mark.parametrize("change, seconds, words", [
    (dead, 25, "gyroscope_y is the same in every sample"), (huge, 25, "1012.000: accelerometer_z is 1e+200"),
    (slow, 25, "0.4 samples a second"),
    (moved, 25, "1012.000: it moves, gyroscope_z"), (broken, 25, "1012.000: a sample is not finite"),
    (back, 25, "1007.000 does not come after"), (lambda i, m: m if i < 600 or i > 620 else None, 25, "1012.420 comes after a gap"),
    (lambda i, m: m if i % 100 else None, 25, "samples are lost"), (lambda i, m: m, 10, "500 samples"),
])
def test_what_is_wrong_with_a_recording_is_said(tmp_path, change, seconds, words):
    done = rosrun("calibrate_imu", recording(tmp_path / "imu.bag", change, seconds))
    assert done.returncode == 1 and words in done.stderr and "Traceback" not in done.stderr, done.stderr


def test_a_topic_is_found_or_asked_for(tmp_path):
    bag = recording(tmp_path / "imu.bag")
    assert rosrun("calibrate_imu", bag).returncode == 0
    done = rosrun("calibrate_imu", bag, "--topic", "/other")
    assert done.returncode == 1 and "no sensor_msgs/Imu on /other; there is imu" in done.stderr
    done = rosrun("calibrate_imu", tmp_path / "none.bag")
    assert done.returncode == 1 and "none.bag" in done.stderr and "Traceback" not in done.stderr
    (tmp_path / "noise.bag").write_bytes(bytes(range(256)) * 40)
    done = rosrun("calibrate_imu", tmp_path / "noise.bag")
    assert done.returncode == 1 and "no bag that can be read" in done.stderr and "Traceback" not in done.stderr
