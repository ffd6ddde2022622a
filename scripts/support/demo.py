#!/usr/bin/python3
"""Plays a recording through usv.launch, shows it in RViz and prints what was found. Called by scripts/demo."""
import argparse
import dataclasses
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import kitti_data
import sim_world
import stage_run
from ros_session import RosSession

SIZE = "1600x900"
WORLD = "usv_harbour"


def options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--picture", type=pathlib.Path)
    parser.add_argument("--scene", action="store_true")
    given = parser.parse_args()
    given.display = bool(os.environ.get("DISPLAY"))
    if not given.display:
        given.picture = given.picture or pathlib.Path("demo.png")
        given.seconds = given.seconds or 20.0
    return given


@dataclasses.dataclass
class Recording:
    """What is played, and with what."""
    bag: pathlib.Path
    model: pathlib.Path  # of the detector
    report: str  # program that tells what was found
    topics: tuple = ()  # further arguments of usv.launch
    known: dict = dataclasses.field(default_factory=dict)  # the robot's file


def recording(folder, scene):
    data = kitti_data.folder() or pathlib.Path("/nonexistent")
    drive, model = data / kitti_data.SEQUENCE, data / kitti_data.MODEL
    bag = folder / "demo.bag"
    if not scene and drive.is_dir() and model.is_file():
        print(f"real recording: {drive}, ten frames again and again; YOLOv8n with COCO classes")
        subprocess.run(["rosrun", "field_fusion", "kitti_to_bag", drive, bag, "--repeat", "60"],
                       check=True, stdout=subprocess.DEVNULL)
        return Recording(bag, model, "drive_report.py")
    print(f"simulated world {WORLD}, and the detector that learnt from such worlds, {stage_run.DETECTOR} (set "
          "FIELD_FUSION_DATA for a real drive)", flush=True)
    subprocess.run(["rosrun", "field_fusion", "make_bag", WORLD, bag, "--seconds", "40"], check=True, stdout=subprocess.DEVNULL)
    return Recording(bag, stage_run.package() / stage_run.DETECTOR, "scene_report.py", stage_run.SIM_TOPICS, sim_world.KNOWN[WORLD])


def virtual_display(session):
    """Starts one on a free number and makes it this process's display."""
    read, write = os.pipe()
    os.set_inheritable(write, True)
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{SIZE}x24", "-nolisten", "tcp"],
                              pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    session.adopt(server)
    with os.fdopen(read) as answer:
        number = answer.readline().strip()
    if not number:
        sys.exit("demo: Xvfb did not start")
    os.environ.update(DISPLAY=f":{number}", LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1")


def await_rviz(session, *needed):
    """Until it has made its displays: a slow machine needs a minute."""
    shows = lambda: any("/rviz" in nodes for topic, nodes in session.system_state()[1] if "markers" in topic)
    session.require(shows, 120.0, "RViz did not come up", *needed)


def take_picture(file):
    file.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run(["import", "-window", "root", str(file)], check=True)
    print(f"picture of RViz: {file}")


def main():
    given = options()
    if given.picture and not shutil.which("import"):
        sys.exit("demo: ImageMagick's `import` is missing; run scripts/install_dependencies")
    with tempfile.TemporaryDirectory(prefix="field_fusion_demo_") as scratch, RosSession() as session:
        played = recording(pathlib.Path(scratch), given.scene)
        if not given.display:
            virtual_display(session)
        robot = pathlib.Path(scratch) / "robot.yaml"
        stage_run.robot(robot, played.known)
        launch = session.launch("field_fusion", "usv.launch", f"bag:={played.bag}", f"model:={played.model}",
                                "bag_args:=--loop", f"robot:={robot}", *played.topics)
        if given.picture:
            await_rviz(session, launch)
        limit = ["--limit", str(given.seconds)] if given.seconds else []
        report = pathlib.Path(__file__).with_name(played.report)
        reporter = session.adopt(subprocess.Popen([sys.executable, report, *limit]))
        started = time.monotonic()
        over = lambda: launch.poll() is not None or (given.seconds and time.monotonic() - started > given.seconds)
        try:
            session.wait(over, seconds=float("inf"))
            if given.picture and launch.poll() is None:
                take_picture(given.picture)
            session.wait(lambda: reporter.poll() is not None, 10.0)
        except KeyboardInterrupt:
            pass
        return launch.poll() or reporter.poll() or 0


if __name__ == "__main__":
    sys.exit(main())
