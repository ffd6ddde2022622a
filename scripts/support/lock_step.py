"""Feeds a bag to running stages one frame at a time: the next goes out when the answer to the last is in,
so that what comes out does not depend on the machine's load."""
import threading

import rosbag
import rospy

from field_fusion.msg import ClusterArray, ObstacleArray

TOPICS = ("/camera_info", "/image_raw", "/points")  # in this order: the image finds its camera there


def frames_of(bag_file):
    """[(stamp, {topic: message})] in the order of time, and the static transforms."""
    frames, static = {}, None
    with rosbag.Bag(bag_file) as bag:
        for topic, message, _ in bag.read_messages():
            if topic == "/tf_static":
                static = message
            elif topic in TOPICS:
                frames.setdefault(message.header.stamp, {})[topic] = message
    return sorted(frames.items()), static


class LockStep:
    """Publishes what `frames_of` gave. Needs an initialised node."""

    def __init__(self, frames, static):
        first = frames[0][1]
        self.publishers = {topic: rospy.Publisher(topic, type(first[topic]), queue_size=10) for topic in TOPICS}
        self.static = rospy.Publisher("/tf_static", type(static), queue_size=1, latch=True)
        self.static.publish(static)
        self.changed = threading.Condition()
        self.obstacles, self.clusters = {}, {}
        self.subscribers = [rospy.Subscriber("/obstacles", ObstacleArray, self._on_obstacles, queue_size=10),
                            rospy.Subscriber("/clusters", ClusterArray, self._on_clusters, queue_size=10)]

    def connected(self):
        """True when stages listen to every input, and to the transforms."""
        return all(p.get_num_connections() > 0 for p in (*self.publishers.values(), self.static))

    def answer(self, stamp, messages, seconds):
        """(ObstacleArray, ClusterArray) of a frame; None when the last word, with the camera's part, is
        not in by `seconds` of wall time."""
        for topic in TOPICS:
            self.publishers[topic].publish(messages[topic])
        with self.changed:
            if not self.changed.wait_for(lambda: stamp in self.obstacles and stamp in self.clusters, seconds):
                return None
            return self.obstacles[stamp], self.clusters[stamp]

    def _on_obstacles(self, message):
        if message.revision == 1:
            self._keep(self.obstacles, message)

    def _on_clusters(self, message):
        self._keep(self.clusters, message)

    def _keep(self, where, message):
        with self.changed:
            where[message.header.stamp] = message
            self.changed.notify_all()
