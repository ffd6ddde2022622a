"""Bags of a simulated world through the nodelets of usv.launch in lock-step, by several methods at once."""
import typing

from field_fusion.msg import ClusterArray, ImageDetectionArray, ObstacleArray
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

import sim_bag
import stage_run
import stand_in
from lock_step import LockStep

BETWEEN = 100  # s between the bags, so that stamps rise: nothing is remembered from one to the next
INPUTS = {"/detections": ImageDetectionArray, "/camera/camera_info": CameraInfo, "/camera/image_raw": Image,
          "/lidar/points": PointCloud2}


def launch(session, name, method, robot, model):
    """The stages below /NAME, with the parameters of the file `robot`; without a model, no detector."""
    return session.start(
        "env", f"ROS_NAMESPACE={name}", "roslaunch", str(stage_run.package() / "launch/usv.launch"), "rviz:=false",
        *stage_run.SIM_TOPICS, "detections:=/detections", f"method:={method}", f"robot:={robot}", f"model:={model or ''}")


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
        self.bags, self.steps, self.detections = 0, None, {}
        robot = folder / "robot.yaml"
        wrote = stage_run.patient_robot(robot, True, changes)
        self.detect = {**stage_run.defaults("detect"), **wrote.get("detect", {})}
        self.launches = [launch(session, name, method, robot, model if i == 0 else None)
                         for i, (name, method) in enumerate(methods.items())]

    def play(self, bag):
        """An Answer for each cloud of the bag that has a picture."""
        if not self.steps:
            self._connect(sim_bag.static_transforms(bag))
        self.bags += 1
        for frame in sim_bag.frames(bag, images=bool(self.model), shift=BETWEEN * self.bags):
            if frame.picture:
                yield self._answer(frame)

    def _connect(self, static):
        detect = {"/detections": ImageDetectionArray} if self.model else {}
        unused = {"/detections"} if self.model else {"/camera/camera_info", "/camera/image_raw"}
        self.answers = {f"/{name}/{topic}": kind for name in self.methods
                        for topic, kind in (("obstacles", ObstacleArray), ("clusters", ClusterArray))}
        self.steps = LockStep({topic: kind for topic, kind in INPUTS.items() if topic not in unused}, static,
                              {**self.answers, **detect},
                              dict.fromkeys(("/lidar/points", "/detections", "/tf_static"), len(self.methods)))
        self.session.require(self.steps.connected, stage_run.PATIENCE, "the stages did not start", *self.launches)

    def _answer(self, frame):
        for picture in frame.pictures:
            self.detections[picture.stamp] = self._detected(picture)
            while len(self.detections) > sim_bag.KEPT:
                del self.detections[min(self.detections)]
        answer = self._wait([("/lidar/points", frame.cloud)], dict.fromkeys(self.answers, frame.stamp))
        return Answer(frame, self.detections[frame.picture.stamp],
                      {name: answer[f"/{name}/obstacles"] for name in self.methods},
                      {name: answer[f"/{name}/clusters"] for name in self.methods})

    def _detected(self, picture):
        """One at a time: the detector takes the newest picture and leaves out those before."""
        if not self.model:
            detections = stand_in.seen(picture.detections, picture.info, self.detect)
            self._wait([("/detections", detections)], {})
            return detections
        messages = [("/camera/camera_info", picture.info), ("/camera/image_raw", picture.image)]
        return self._wait(messages, {"/detections": picture.stamp})["/detections"]

    def _wait(self, messages, stamps):
        return self.steps.require(messages, stamps, stage_run.PATIENCE)

    def close(self):
        if self.steps:
            self.steps.close()
        for process in self.launches:
            self.session.end(process)
