"""A map of voxels that is saved, gone on from, and gone when time jumps back."""
import subprocess

from conftest import SETUP
from ros_session import RosSession

# Starts with voxels of a file, then loses the file and jumps back in time.
PROGRAM = """
import os, struct, sys, rospy
from diagnostic_msgs.msg import DiagnosticArray
from field_fusion.srv import SaveMap
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import PointCloud2, PointField
from visualization_msgs.msg import MarkerArray

rospy.init_node("user")
heard = {}
def listen(topic, kind):
    return rospy.Subscriber(topic, kind, lambda message: heard.setdefault(topic, []).append(message), queue_size=100)
def wait(what, holds, step=lambda: None):
    for _ in range(1000):
        if holds():
            return
        step()
        rospy.rostime.wallsleep(0.02)
    sys.exit(what)
def cloud(at):
    fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate("xyz")]
    out = PointCloud2(height=1, width=1, fields=fields, point_step=12, row_step=12, data=struct.pack("<3f", 2.02, 0.02, 0.32))
    out.header.frame_id, out.header.stamp = "map", rospy.Time.from_sec(at)
    return out

file, mode = sys.argv[1:]
clouds = rospy.Publisher("points", PointCloud2, queue_size=10)
ears = [listen("/diagnostics", DiagnosticArray), listen("voxels", MarkerArray), listen("projected_map", OccupancyGrid)]
wait("no stage", lambda: clouds.get_num_connections() and all(e.get_num_connections() for e in ears))
now = [1000.0]
def send():
    now[0] += 0.1
    clouds.publish(cloud(now[0]))
occupied = lambda: any(cell > 50 for message in heard.get("projected_map", [])[-1:] for cell in message.data)
if mode == "save":
    wait("no map", occupied, send)
    answer = rospy.ServiceProxy("save_voxels", SaveMap)(file)
    sys.exit(None if answer.success else answer.message)
wait("no voxels before any cloud", lambda: any(m.markers[0].points for m in heard.get("voxels", [])))
send()
wait("no map", occupied, send)
os.remove(file)
now[0] = 500.0
said = lambda: any(f"{file}: cannot be read" in s.message for m in heard.get("/diagnostics", []) for s in m.status)
wait("the missing file is not told", said, send)
heard["projected_map"].clear()
wait("it does not go on", occupied, send)
"""


def run(folder, file, mode, *parameters):
    """What the program complains about."""
    with RosSession(folder) as session:
        stage = session.start("rosrun", "nodelet", "nodelet", "standalone", "field_fusion/voxel_map", *parameters)
        done = subprocess.run(["bash", "-c", '. "$0" && exec /usr/bin/python3 -c "$@"', SETUP, PROGRAM, str(file), mode],
                              capture_output=True, text=True, timeout=120)
        assert stage.poll() is None, "the stage has ended"
        return done.stderr if done.returncode else ""


def test_voxels_are_shown_at_once_and_a_lost_file_ends_no_stage(tmp_path):
    file = tmp_path / "voxels.ot"
    for name in ("save", "load"):
        (tmp_path / name).mkdir()
    assert run(tmp_path / "save", file, "save") == ""
    assert run(tmp_path / "load", file, "load", f"_map_file:={file}") == ""
