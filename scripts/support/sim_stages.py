"""Bags of a simulated world through the nodelets of usv.launch in lock-step, by several methods at once."""
import typing

from field_fusion.msg import ClusterArray, ImageDetectionArray, ObstacleArray
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

import sim_bag
import stage_run
import stand_in
from lock_step import LockStep
from ros_session import SessionError

BETWEEN = 100  # s between the bags, so that stamps rise: nothing is remembered from one to the next
INPUTS = {"/detections": ImageDetectionArray, "/camera/camera_info": CameraInfo, "/camera/image_raw": Image,
          "/lidar/points": PointCloud2}


class Answer(typing.NamedTuple):
    frame: sim_bag.Frame
    detections: object  # ImageDetectionArray that the stages matched
    obstacles: dict  # {method: ObstacleArray}
    clusters: dict  # {method: ClusterArray}


class Stages:
    """One set of stages for each of `methods` {name: argument `method` of usv.launch}, below /NAME, with the vessel's
    parameters and `changes` {stage: {parameter: value}}. The first of them has the detector, of the ONNX file `model`;
    without one the truth stands in. The process must have a node in `session`."""

    def __init__(self, session, folder, methods, changes, model):
        self.session, self.methods, self.model = session, list(methods), model
        self.bags, self.steps = 0, None
        robot = folder / "robot.yaml"
        wrote = stage_run.patient_robot(robot, True, changes)
        self.detect = {**stage_run.defaults("detect"), **wrote.get("detect", {})}
        self.launches = [self._launch(name, method, robot, model if i == 0 else None)
                         for i, (name, method) in enumerate(methods.items())]

    def _launch(self, name, method, robot, model):
        return self.session.start(
            "env", f"ROS_NAMESPACE={name}", "roslaunch", str(stage_run.package() / "launch/usv.launch"), "rviz:=false",
            "points:=/lidar/points", "image:=/camera/image_raw", "camera_info:=/camera/camera_info",
            "detections:=/detections", f"method:={method}", f"robot:={robot}", f"model:={model or ''}")

    def play(self, bag):
        """An Answer for each cloud of the bag that has a picture."""
        if not self.steps:
            self._connect(sim_bag.static_transforms(bag))
        self.bags += 1
        for frame in sim_bag.frames(bag, pictures=bool(self.model), shift=BETWEEN * self.bags):
            if frame.detections:
                yield self._answer(frame)

    def _connect(self, static):
        detect = {"/detections": ImageDetectionArray} if self.model else {}
        unused = {"/detections"} if self.model else {"/camera/camera_info", "/camera/image_raw"}
        answers = {f"/{name}/{topic}": kind for name in self.methods
                   for topic, kind in (("obstacles", ObstacleArray), ("clusters", ClusterArray))}
        self.steps = LockStep({topic: kind for topic, kind in INPUTS.items() if topic not in unused}, static,
                              {**answers, **detect})
        self.session.require(self.steps.connected, stage_run.PATIENCE, "the stages did not start", *self.launches)

    def _answer(self, frame):
        inputs = dict(frame.inputs)
        if not self.model:
            inputs["/detections"] = stand_in.seen(frame.detections, frame.inputs["/camera/camera_info"], self.detect)
        stamps = {topic: inputs["/camera/image_raw"].header.stamp if topic == "/detections" else frame.stamp
                  for topic in self.steps.answers}
        answer = self.steps.answer(inputs, stamps, stage_run.PATIENCE)
        if answer is None:
            raise SessionError(f"no answer to the cloud of {frame.stamp.to_sec():.1f} s within {stage_run.PATIENCE:.0f} s")
        return Answer(frame, answer["/detections"] if self.model else inputs["/detections"],
                      {name: answer[f"/{name}/obstacles"] for name in self.methods},
                      {name: answer[f"/{name}/clusters"] for name in self.methods})

    def close(self):
        if self.steps:
            self.steps.close()
        for launch in self.launches:
            self.session.end(launch)
