"""Feeds running stages as sensors do: each message at its time, whether or not the last has been answered.

Times are those of this process: from just before a message is handed to the middleware until the answer has come back from
it. Two hops between processes are in it, so a latency told here is more than that between first and last nodelet."""
import gc
import time

import figures
from lock_step import LockStep

LAST = 2.0  # s of wall time for what is still under way at the end


class RealTime(LockStep):
    """`left` {(topic, stamp): s}, `came` {(topic, stamp, revision): s}: monotonic times of the last `play`. Answers without
    revisions have 0."""

    def __init__(self, *arguments):
        self.left, self.came, self.coming = {}, {}, {}
        super().__init__(*arguments)

    def clear(self):
        with self.changed:
            self.left, self.coming = {}, {}
            for kept in self.answers.values():
                kept.clear()

    def play(self, arrivals, awaited):
        """`awaited` (topic, stamp, revision): what should have come before this returns."""
        self.clear()
        gc.collect()
        gc.disable()  # over a whole recording it takes tens of ms, which would count as the stages'
        try:
            start = time.monotonic() - arrivals[0].due
            for due, topic, message in arrivals:
                time.sleep(max(0.0, start + due - time.monotonic()))
                self.left[topic, message.header.stamp] = time.monotonic()
                self.publishers[topic].publish(message)
            with self.changed:
                self.changed.wait_for(lambda: awaited in self.coming, LAST)
                self.came = dict(self.coming)  # more may come while it is read
        finally:
            gc.enable()

    def _keep(self, message, topic):
        now = time.monotonic()
        with self.changed:
            self.coming[topic, message.header.stamp, getattr(message, "revision", 0)] = now
        super()._keep(message, topic)


def sent(left, topic):
    """[(stamp, s)] of a topic in what `RealTime.left` holds, in the order of the stamps."""
    return sorted((stamp, at) for (of, stamp), at in left.items() if of == topic)


def percentile(values, share):
    """The least of them that a `share` of them does not exceed; NaN of none."""
    ordered = sorted(values)
    return ordered[max(0, -(-len(ordered) * share // 100) - 1)] if ordered else float("nan")


def percentile_line(name, values, share, unit):
    """`share` in per cent, a whole number."""
    statistic = lambda drawn: percentile(drawn, share)
    return figures.line(name, statistic(values), unit, len(values), figures.bootstrap(values, statistic, 400))
