"""A bag of the quadruped through the nodelets of quadruped.launch in lock-step: every map that comes of it."""
import genpy
import rosbag
import rospy
import yaml

from nav_msgs.msg import OccupancyGrid, Odometry, Path
from sensor_msgs.msg import CameraInfo, Image, LaserScan
from tf2_msgs.msg import TFMessage

import sim_bag
import sim_world
import stage_run
from lock_step import MapSteps
from ros_session import RosSession, SessionError

ODOM, SCAN, IMAGE, INFO = "/odom", "/scan/scan", "/depth/depth/image_raw", "/depth/depth/camera_info"
KINDS = {"/tf": TFMessage, ODOM: Odometry, SCAN: LaserScan, IMAGE: Image, INFO: CameraInfo}
# Of each way to fuse: map A, and what is made of it. PF is the paper's scan of both sensors.
MAPS = {"lidar": "/map", "pf": "/pf/map", "pmf": "/fused_map", "pmf_pf": "/pf/fused_map"}
QUEUE = 100  # maps that wait to be heard
BURST = 1000  # messages between two answers, at most
RATE, MOUNTS = 10.0, ("scan", "depth", "odom")  # depth images a second that are played, and sensors that take part
LINKING = 5.0  # s of wall time for an answer before the first
AHEAD = genpy.Duration.from_sec(0.02)  # that odometry is sent beyond a scan or an image

# quadruped.launch, and beside it the maps that are made of the fused scan, below pf/
LAUNCH = """<launch>
  <include file="{package}/launch/quadruped.launch">
    <arg name="scan" value="{scan}"/> <arg name="odom" value="{odom}"/>
    <arg name="image" value="{image}"/> <arg name="camera_info" value="{info}"/>
    <arg name="robot" value="{robot}"/> <arg name="rviz" value="false"/>
  </include>
  <group ns="pf">
    <include file="{package}/launch/grid_slam.launch"> <arg name="scan" value="/scan_merged"/> </include>
    <include file="{package}/launch/map_fusion.launch"> <arg name="projected_map" value="/projected_map"/> </include>
    <rosparam command="load" file="{robot}"/>
    <param name="grid_slam/publish_tf" value="false"/>
  </group>
</launch>
"""


def _robot(file):
    """The robot's own parameters, with waits that only a broken stage exceeds and maps that come at once."""
    values = stage_run.shipped_robot("quadruped")
    changes = {"deskew_scan": {}, "depth_scan": {}, "scan_merge": {}, "grid_slam": {"map_update_interval": 0.0},
               "voxel_map": {"publish_interval": 0.0}, "map_fusion": {"publish_interval": 0.0}}
    for stage, changed in changes.items():
        values[stage] = {**values.get(stage, {}), **changed, "hold_limit": 10.0}
    file.write_text(yaml.safe_dump(values))
    return values


def bag(experiment, world, seconds, seed):
    """With what `play` plays alone."""
    return experiment.bag(sim_world.with_mounts(world, {"depth": {"rate": RATE}}), seconds, seed, "--mounts", *MOUNTS)


def play(experiment, bag_file, heard=None):
    """({name of MAPS: the last OccupancyGrid}, the Path of the first map). `heard(name, map)` gets every map that comes."""
    robot = experiment.folder / "quadruped.yaml"
    values = _robot(robot)
    launch = experiment.folder / "quadruped.launch"
    launch.write_text(LAUNCH.format(package=stage_run.package(), scan=SCAN, odom=ODOM, image=IMAGE, info=INFO, robot=robot))
    session = experiment.session
    process = session.start("roslaunch", str(launch))
    latest = {}
    keep = lambda message, topic: latest.__setitem__(topic, message)

    def keep_map(grid, name):
        keep(grid, MAPS[name])
        if heard:
            heard(name, grid)

    subscribers = [rospy.Subscriber(topic, OccupancyGrid, keep_map, name, queue_size=QUEUE) for name, topic in MAPS.items()]
    subscribers.append(rospy.Subscriber("/path", Path, keep, "/path", queue_size=1))
    steps = MapSteps(KINDS, sim_bag.static_transforms(bag_file),
                      {"/tf": TFMessage, "/scan_merged": LaserScan, "/projected_map": OccupancyGrid},
                      {"/tf": 4}, BURST)  # three processes of stages hear of transforms, and this one
    try:
        session.require(steps.connected, stage_run.PATIENCE, "the stages did not start", process)
        last = _feed(steps, bag_file, genpy.Duration.from_sec(values["grid_slam"]["tf_delay"]))
        there = lambda: all(topic in latest for topic in (*MAPS.values(), "/path")) and all(
            latest[topic].header.stamp >= last for topic in (MAPS["pmf"], MAPS["pmf_pf"]))
        if not RosSession.wait(there, stage_run.PATIENCE):
            raise SessionError(f"no map on {', '.join(topic for topic in MAPS.values() if topic not in latest) or 'time'}")
        return {name: latest[topic] for name, topic in MAPS.items()}, latest["/path"]
    finally:
        steps.close()
        for subscriber in subscribers:
            subscriber.unregister()
        session.end(process)


def _feed(steps, bag_file, delay):
    """Stamp of the last depth image that was answered. An answer is waited for once the odometry is beyond its message; until
    the first is in, not all stages may listen to one another yet."""
    waiting, asked, newest, last = [], {}, genpy.Time(), genpy.Time()
    apart = genpy.Duration.from_sec(0.9 / RATE)
    began = mapped = due = None  # first odometry, first transform of the map
    with rosbag.Bag(str(bag_file)) as bag:
        for topic, message, time in bag.read_messages(topics=list(KINDS)):
            if asked and topic == ODOM and time > due:
                if mapped:
                    steps.require(waiting, asked, stage_run.PATIENCE)
                elif steps.answer(waiting, asked, LINKING):
                    mapped = asked["/tf"]
                last = asked.get("/projected_map", last)
                waiting, asked = [], {}
            stamp = message.header.stamp if topic != "/tf" else None
            began = began or (stamp if topic == ODOM else None)
            if topic == SCAN and (began is None or stamp < began):
                continue  # no odometry tells where it was
            if topic in (IMAGE, INFO) and (mapped is None or stamp < mapped or stamp < newest + apart):
                continue  # nothing tells where it was in the map, or left out
            waiting.append((topic, message))
            if topic == SCAN:
                asked.update({"/tf": stamp + delay, "/scan_merged": stamp})
            elif topic == IMAGE:
                asked["/projected_map"] = newest = stamp
            if topic in (SCAN, IMAGE):
                due = time + AHEAD
    return last
