"""Feeds running stages one frame at a time: the next goes out when the answer to the last is in, so that what
comes out does not depend on the machine's load."""
import threading
import time

import rospy

from ros_session import SessionError

LISTENING = 0.5  # s of wall time: nobody says when he has heard of a new transform


class LockStep:
    """Publishes on `topics` {topic: type} and waits in each frame for a message on each of `answers`
    {topic: type}; of obstacles for the last revision. `static`: the transforms at the start. `listeners` {topic: how many}
    where there is more than one. `burst`: how many messages may go out at once on a topic. Needs an initialised node."""

    def __init__(self, topics, static, answers, listeners=None, burst=10):
        self.listeners = listeners or {}
        self.publishers = {topic: rospy.Publisher(topic, kind, queue_size=burst) for topic, kind in topics.items()}
        self.static = rospy.Publisher("/tf_static", type(static), queue_size=1, latch=True)
        self.static.publish(static)
        self.changed = threading.Condition()
        self.answers = {topic: {} for topic in answers}
        self.subscribers = [rospy.Subscriber(topic, kind, self._keep, topic, queue_size=10)
                            for topic, kind in answers.items()]

    def connected(self):
        """True when stages listen to every input, and to the transforms, and this to every output."""
        publishers = {**self.publishers, "/tf_static": self.static}
        return (all(p.get_num_connections() >= self.listeners.get(topic, 1) for topic, p in publishers.items())
                and all(s.get_num_connections() > 0 for s in self.subscribers))

    def transform(self, static):
        """Tells of other static transforms than those at the start."""
        self.static.publish(static)
        time.sleep(LISTENING)

    def answer(self, messages, stamps, seconds):
        """Sends `messages` [(topic, message)] in their order. {topic: message} of the answers, each with its stamp in
        `stamps` {topic: stamp}; None when the last of it is not in by `seconds` of wall time."""
        for topic, message in messages:
            self.publishers[topic].publish(message)
        with self.changed:
            if not self.changed.wait_for(lambda: all(stamp in self.answers[topic] for topic, stamp in stamps.items()), seconds):
                return None
            return {topic: self.answers[topic].pop(stamp) for topic, stamp in stamps.items()}

    def require(self, messages, stamps, seconds):
        """The same; raises SessionError where that is None."""
        answer = self.answer(messages, stamps, seconds)
        if answer is None:
            raise SessionError(f"no answer on {', '.join(stamps)} within {seconds:.0f} s")
        return answer

    def close(self):
        for port in (*self.publishers.values(), self.static, *self.subscribers):
            port.unregister()

    def _keep(self, message, topic):
        if getattr(message, "provisional", False):
            return
        with self.changed:
            self.answers[topic][message.header.stamp] = message
            self.changed.notify_all()


class MapSteps(LockStep):
    """Its answer on /tf is the transform that grid_slam sends for a scan, by that transform's stamp."""

    def _keep(self, message, topic):
        if topic != "/tf":
            return super()._keep(message, topic)
        for transform in message.transforms:
            if transform.header.frame_id == "map":
                super()._keep(transform, topic)
