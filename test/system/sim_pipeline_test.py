"""A bag of make_bag through usv.launch: bodies are found, and no stage sees the truth."""
import sys

import pytest

from conftest import rosrun
from ros_session import RosSession

# Plays the clouds of a bag one at a time, each when the answer to the one before is in; with argument `truth` all
# of its truth too. Writes every answer's bytes, a line for each.
PLAYER = """
import io, sys, threading, rosbag, rospy
from field_fusion.msg import ClusterArray, ObstacleArray
from sensor_msgs.msg import PointCloud2
bag_file, out, truth = sys.argv[1], sys.argv[2], sys.argv[3] == "truth"
rospy.init_node("player")
answers, changed = {}, threading.Condition()
def keep(message, topic):
    if topic == "/obstacles" and message.provisional:
        return
    message.header.seq = 0
    buffer = io.BytesIO()
    message.serialize(buffer)
    with changed:
        answers[topic, message.header.stamp] = (buffer.getvalue(), message)
        changed.notify_all()
ears = [rospy.Subscriber(t, k, keep, t) for t, k in (("/obstacles", ObstacleArray), ("/clusters", ClusterArray),
                                                      ("/points_obstacle", PointCloud2))]
voices = {}
def say(topic, message):
    if topic not in voices:
        voices[topic] = rospy.Publisher(topic, type(message), queue_size=50, latch=topic == "/tf_static")
    voices[topic].publish(message)
messages = [m for m in rosbag.Bag(bag_file).read_messages()
            if m.topic in ("/lidar/points", "/tf_static") or (truth and m.topic.startswith("/truth/"))]
say(*next(m[:2] for m in messages if m.topic == "/tf_static"))
voices["/lidar/points"] = rospy.Publisher("/lidar/points", PointCloud2, queue_size=50)
while not (voices["/lidar/points"].get_num_connections() and all(e.get_num_connections() for e in ears)):
    rospy.rostime.wallsleep(0.01)
with open(out, "w") as file:
    for topic, message, _ in messages:
        if topic != "/tf_static":
            say(topic, message)
        if topic != "/lidar/points":
            continue
        wanted = [(e.name, message.header.stamp) for e in ears]
        with changed:
            assert changed.wait_for(lambda: all(w in answers for w in wanted), 60), wanted
            bodies = answers[wanted[0]][1].obstacles
            file.write(f"{len(bodies)} " + " ".join(answers[w][0].hex() for w in wanted) + "\\n")
"""


@pytest.fixture(scope="module")
def harbour(tmp_path_factory):
    bag = tmp_path_factory.mktemp("harbour") / "harbour.bag"
    done = rosrun("make_bag", "usv_harbour", bag, "--seconds", "1.05")
    assert done.returncode == 0, done.stderr
    return bag


def answers(bag, folder, truth):
    """Lines of the player, and who listened to any topic of the truth."""
    out = folder / truth
    with RosSession() as session:
        stages = session.launch("field_fusion", "usv.launch", "rviz:=false", "points:=lidar/points")
        player = session.start(sys.executable, "-c", PLAYER, str(bag), str(out), truth)
        session.require(lambda: player.poll() is not None, 300, "the player did not end", stages)
        assert player.returncode == 0, (session.folder / "3_python3.log").read_text()
        listeners = [entry for entry in session.system_state()[1] if "truth" in entry[0]]
    return out.read_text().splitlines(), listeners


def test_bodies_are_found_and_the_truth_changes_nothing(harbour, tmp_path):
    seen, listeners = answers(harbour, tmp_path, "truth")
    blind, _ = answers(harbour, tmp_path, "blind")
    assert len(blind) == 10 and all(int(line.split()[0]) > 2 for line in blind)
    assert seen == blind
    assert listeners == []
