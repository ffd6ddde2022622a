"""Two robots under one master, each in a namespace and with frames of its own: nothing of one reaches the other."""
import json
import math

import genpy
import rosbag
import sensor_msgs.point_cloud2
import std_msgs.msg
from field_fusion.msg import ImageDetection, ImageDetectionArray
from geometry_msgs.msg import Vector3
from ros_session import RosSession

LAUNCH = """<launch>{}</launch>"""
ROBOT = """
  <include file="$(find field_fusion)/launch/usv.launch" ns="{0}">
    <arg name="rviz" value="false"/>
    <arg name="frame" value="{0}/lidar"/>
  </include>
  <node pkg="tf2_ros" type="static_transform_publisher" name="{0}_camera_mount"
        args="{1} 0 0 -0.5 0.5 -0.5 0.5 {0}/lidar {0}/camera"/>"""
# robot: (body ahead of its LiDAR [m], camera ahead of its LiDAR [m], what the camera calls it: classes of no known size,
# so that its place is that of the wall that is seen)
ROBOTS = {"a": (8.0, 1.0, "person"), "b": (15.0, 3.0, "puppet")}
LISTENER = """
import json, math, rospy, sys, threading
from field_fusion.msg import ObstacleArray
from sensor_msgs.msg import LaserScan
seen, lock = {}, threading.Lock()
def note(key, value):
    with lock:
        if value not in seen.setdefault(key, []):
            seen[key].append(value)
            json.dump(seen, open(sys.argv[1] + ".new", "w"))
            __import__("os").replace(sys.argv[1] + ".new", sys.argv[1])
def obstacles(m, robot):
    note(robot, [m.header.frame_id, [[round(o.range), o.source, o.label] for o in m.obstacles]])
def scan(m, robot):
    note(robot + "/scan", [m.header.frame_id, round(min(m.ranges))])
rospy.init_node("listener")
for robot in "ab":
    rospy.Subscriber(f"/{robot}/obstacles", ObstacleArray, obstacles, robot)
    rospy.Subscriber(f"/{robot}/obstacle_scan", LaserScan, scan, robot)
rospy.spin()
"""


def header(robot, sensor, stamp):
    return std_msgs.msg.Header(stamp=stamp, frame_id=f"{robot}/{sensor}")


def cloud(robot, stamp, ahead):
    """A wall of 2 m x 1 m, and the water 1.5 m below it."""
    wall = [(ahead, 0.1 * y, 0.1 * z) for y in range(-10, 11) for z in range(-5, 6)]
    water = [(2.0 + 0.7 * x, 0.7 * y, -1.5) for x in range(30) for y in range(-15, 16)]
    return sensor_msgs.point_cloud2.create_cloud_xyz32(header(robot, "lidar", stamp), wall + water)


def detections(robot, stamp, ahead, label):
    body = ImageDetection(label=label, score=0.9, range=ahead, range_sigma=0.2, depth=ahead)
    for vector in (v for v in map(body.__getattribute__, body.__slots__) if isinstance(v, Vector3)):
        vector.x = vector.y = vector.z = math.nan  # not known
    body.ray = Vector3(0, 0, 1)
    return ImageDetectionArray(header=header(robot, "camera", stamp), width=640, height=480, detections=[body])


def record(file, seconds):
    with rosbag.Bag(str(file), "w") as bag:
        for tenth in range(10 * seconds):
            stamp = genpy.Time(1000 + tenth // 10, tenth % 10 * 100000000)
            for robot, (ahead, mount, label) in ROBOTS.items():
                bag.write(f"/{robot}/points", cloud(robot, stamp, ahead), stamp)
                bag.write(f"/{robot}/detections", detections(robot, stamp, ahead - mount, label), stamp)


def test_each_robot_sees_its_own_body_in_its_own_frame(tmp_path):
    bag, launch, result = tmp_path / "a.bag", tmp_path / "two.launch", tmp_path / "seen.json"
    record(bag, 60)
    launch.write_text(LAUNCH.format("".join(ROBOT.format(robot, mount) for robot, (_, mount, _) in ROBOTS.items())))
    expected = {robot: [f"{robot}/lidar", [[round(ahead), 3, label]]] for robot, (ahead, _, label) in ROBOTS.items()}

    def seen():
        return json.loads(result.read_text()) if result.exists() else {}

    def complete():
        now = seen()
        return all(expected[robot] in now.get(robot, []) and now.get(robot + "/scan") for robot in ROBOTS)

    with RosSession() as session:
        session.launch(str(launch))
        session.start("/usr/bin/python3", "-c", LISTENER, str(result))
        session.start("rosbag", "play", "--quiet", "--loop", str(bag))
        assert session.wait(complete, 90.0), seen()
        topics = {topic for topic, _ in session.system_state()[0]}
    for robot, (ahead, _, label) in ROBOTS.items():
        for frame, bodies in seen()[robot]:
            assert frame == f"{robot}/lidar"
            assert {(range, name) for range, _, name in bodies} <= {(round(ahead), label), (round(ahead), "")}
        assert {(frame, range) for frame, range in seen()[robot + "/scan"]} == {(f"{robot}/lidar", round(ahead))}
    shared = {"/clock", "/diagnostics", "/rosout", "/rosout_agg", "/tf", "/tf_static"}
    assert {topic for topic in topics if topic.split("/")[1] not in ROBOTS} <= shared
