#!/usr/bin/python3
"""Takes RViz's picture of every world, live, for docs/worlds.md. Arguments: worlds; none: all."""
import pathlib
import sys
import time

from demo import await_rviz, take_picture, virtual_display
from ros_session import RosSession

ROOT = pathlib.Path(__file__).resolve().parents[2]
VIEWS = {"usv_harbour": (32, 0.5), "usv_cages": (13, 0.5), "quad_corridor": (12, 1.15), "office": (26, 0.9)}
USUAL = (10, 0.8)  # m from the robot, rad above the horizon
SETTLED = 12.0  # s until RViz has drawn all
DRIVEN = 6.0  # simulated s, which pass slowly on a slow machine: until the robot is clear of the wall behind it


def main():
    worlds = sys.argv[1:] or sorted(file.stem for file in (ROOT / "config/worlds").glob("*.yaml"))
    for world in worlds:
        with RosSession() as session:
            virtual_display(session)
            distance, pitch = VIEWS.get(world, USUAL)
            session.launch("field_fusion", "sim.launch", f"world:={world}", f"distance:={distance}", f"pitch:={pitch}")
            await_rviz(session)
            drive = session.start("/usr/bin/python3", "-c", f"import rospy; rospy.init_node('drive'); rospy.sleep({DRIVEN})")
            time.sleep(SETTLED)
            session.require(lambda: drive.poll() == 0, 300.0, "simulated time does not pass", drive)
            take_picture(ROOT / f"docs/images/{world}.png")


if __name__ == "__main__":
    main()
