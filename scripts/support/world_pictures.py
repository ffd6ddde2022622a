#!/usr/bin/python3
"""Takes RViz's picture of every world, live, for docs/worlds.md. Arguments: worlds; none: all."""
import pathlib
import sys
import time

from demo import take_picture, virtual_display
from ros_session import RosSession

ROOT = pathlib.Path(__file__).resolve().parents[2]
DISTANCE = {"usv_harbour": 32, "usv_cages": 15, "quad_corridor": 12, "office": 26}  # m to the robot; others: 10
SETTLED = 12.0  # s until RViz has drawn all


def main():
    worlds = sys.argv[1:] or sorted(file.stem for file in (ROOT / "config/worlds").glob("*.yaml"))
    for world in worlds:
        with RosSession() as session:
            virtual_display(session)
            session.launch("field_fusion", "sim.launch", f"world:={world}", f"distance:={DISTANCE.get(world, 10)}")
            rviz_runs = lambda: any("/rviz" in nodes for _, nodes in session.system_state()[1])
            session.require(rviz_runs, 120.0, "RViz did not come up")
            time.sleep(SETTLED)
            take_picture(ROOT / f"docs/images/{world}.png")


if __name__ == "__main__":
    main()
