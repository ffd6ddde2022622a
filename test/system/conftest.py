import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SETUP = os.environ.get("FIELD_FUSION_SETUP", str(ROOT / "catkin_ws/devel/setup.bash"))
sys.path.insert(0, str(ROOT / "scripts" / "support"))


def rosrun(*arguments):
    command = ["bash", "-c", '. "$0" && exec rosrun field_fusion "$@"', SETUP, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
