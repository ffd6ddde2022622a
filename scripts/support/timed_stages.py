"""The nodelets of usv.launch, fed by what arrives when: in the order of arrival, or in real time."""
from diagnostic_msgs.msg import DiagnosticArray
from dynamic_reconfigure.client import Client
from field_fusion.msg import ClusterArray, ImageDetectionArray, ObstacleArray
from sensor_msgs.msg import CameraInfo, Image, PointCloud2
import rospy

import stage_run
from arrivals import CLOUDS, DETECTIONS, IMAGES, INFOS
from real_time import RealTime
from ros_session import SessionError
from sim_stages import launch

NAME = "timed"
OBSTACLES, CLUSTERS = f"/{NAME}/obstacles", f"/{NAME}/clusters"
FRESH = 5.0  # s of wall time for the diagnostics of once a second


class TimedStages:
    """The vessel's stages with its parameters and `changes`. Without a `model` detections come from outside; `camera` False:
    they do not come at all. Bags may follow one another at the same stamps: each is a time jump that clears the stages."""

    def __init__(self, session, folder, static, changes=None, model=None, camera=True):
        robot = folder / "timed_robot.yaml"
        wrote = stage_run.robot(robot, changes or {})
        self.detect = {**stage_run.defaults("detect"), **wrote.get("detect", {})}
        self.match = {**stage_run.defaults("match"), **wrote.get("match", {})}
        self.session, self.launch = session, launch(session, NAME, "", robot, model)
        inputs = {CLOUDS: PointCloud2}
        inputs.update({IMAGES: Image, INFOS: CameraInfo} if model else {DETECTIONS: ImageDetectionArray} if camera else {})
        answers = {OBSTACLES: ObstacleArray, CLUSTERS: ClusterArray, **({DETECTIONS: ImageDetectionArray} if model else {})}
        self.steps, self.client, self.told = RealTime(inputs, static, answers), None, {}
        self.diagnostics = rospy.Subscriber("/diagnostics", DiagnosticArray, self._on_diagnostics, queue_size=100)
        try:
            session.require(self.steps.connected, stage_run.PATIENCE, "the stages did not start", self.launch)
        except SessionError:
            self.close()  # the next ones have the same names
            raise

    def set_match(self, **changes):
        """Parameters of the stage `match`, the others as at the start."""
        self.client = self.client or Client(f"/{NAME}/match", timeout=stage_run.PATIENCE)
        self.client.update_configuration({key: self.match[key] for key in ("partner_timeout", "time_offset")} | changes)

    def in_order(self, events, time_offset):
        """{stamp: ObstacleArray}, the last word on each cloud that has one: detections not before it, by their stamps and the
        parameter `time_offset`. It is awaited as soon as these are there, so that no queue overflows."""
        self.steps.clear()
        newest, waiting, words = float("-inf"), [], {}
        for _, topic, message in events:
            stamp = message.header.stamp
            self._answer([(topic, message)], {CLUSTERS: stamp} if topic == CLOUDS else {})
            if topic == CLOUDS:
                waiting.append(stamp)
            else:
                newest = max(newest, stamp.to_sec() + time_offset)
            while waiting and waiting[0].to_sec() <= newest:
                words[waiting[0]] = self._answer([], {OBSTACLES: waiting[0]})[OBSTACLES]
                waiting.pop(0)
        return words

    def _answer(self, messages, stamps):
        return self.steps.require(messages, stamps, stage_run.PATIENCE)

    def in_real_time(self, events):
        """The RealTime that has played them."""
        last = max(message.header.stamp for _, topic, message in events if topic == CLOUDS)
        self.steps.play(events, (OBSTACLES, last, 1))
        return self.steps

    def diagnosed(self, stage):
        """{key: value} of what a stage says after this call."""
        self.told.clear()
        name = f"{NAME}/{stage}: stage"
        self.session.require(lambda: name in self.told, FRESH, f"no diagnostics of {stage}", self.launch)
        return self.told[name]

    def _on_diagnostics(self, message):
        for status in message.status:
            self.told[status.name] = {value.key: value.value for value in status.values}

    def close(self):
        self.diagnostics.unregister()
        if self.client:
            self.client.close()
        self.steps.close()
        self.session.end(self.launch)
