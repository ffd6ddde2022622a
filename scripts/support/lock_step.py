"""Feeds a bag to running stages one frame at a time: the next goes out when the answer to the last is in,
so that what comes out does not depend on the machine's load."""
import threading
import time

import rosbag
import rospy

from field_fusion.msg import ClusterArray, ObstacleArray

TOPICS = ("/camera_info", "/image_raw", "/points")  # in this order: the image finds its camera there
LISTENING = 0.5  # s of wall time: nobody says when he has heard of a new transform


def frames_of(bag_file):
    """[(stamp, {topic: message})] in the order of time, and the static transforms at the start. Those that change
    later are among the messages of their frame."""
    frames, static = {}, None
    with rosbag.Bag(bag_file) as bag:
        for topic, message, stamp in bag.read_messages():
            if topic == "/tf_static" and static is None:
                static = message
            elif topic in (*TOPICS, "/tf_static"):
                frames.setdefault(stamp, {})[topic] = message
    return sorted(frames.items()), static


class LockStep:
    """Publishes what `frames_of` gave. Needs an initialised node. `also` {topic: type} is waited for in each frame,
    beside the obstacles and clusters."""

    def __init__(self, frames, static, also=None):
        first = frames[0][1]
        self.publishers = {topic: rospy.Publisher(topic, type(first[topic]), queue_size=10)
                           for topic in TOPICS if topic in first}
        self.static = rospy.Publisher("/tf_static", type(static), queue_size=1, latch=True)
        self.static.publish(static)
        self.changed = threading.Condition()
        types = {"/obstacles": ObstacleArray, "/clusters": ClusterArray, **(also or {})}
        self.answers = {topic: {} for topic in types}
        self.subscribers = [rospy.Subscriber(topic, kind, self._keep, topic, queue_size=10)
                            for topic, kind in types.items()]

    def connected(self):
        """True when stages listen to every input, and to the transforms, and this to every output."""
        return (all(p.get_num_connections() > 0 for p in (*self.publishers.values(), self.static))
                and all(s.get_num_connections() > 0 for s in self.subscribers))

    def answer(self, stamp, messages, seconds):
        """{topic: message} of a frame; None when the last of it, the camera's part, is not in by `seconds` of wall
        time."""
        if "/tf_static" in messages:
            self.static.publish(messages["/tf_static"])
            time.sleep(LISTENING)
        for topic, publisher in self.publishers.items():
            publisher.publish(messages[topic])
        with self.changed:
            if not self.changed.wait_for(lambda: all(stamp in got for got in self.answers.values()), seconds):
                return None
            return {topic: got.pop(stamp) for topic, got in self.answers.items()}

    def close(self):
        for port in (*self.publishers.values(), self.static, *self.subscribers):
            port.unregister()

    def _keep(self, message, topic):
        if topic == "/obstacles" and message.provisional:
            return
        with self.changed:
            self.answers[topic][message.header.stamp] = message
            self.changed.notify_all()
