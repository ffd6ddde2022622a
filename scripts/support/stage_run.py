"""What runs of the package's stages share: its folder, its programs, the parameters of its robot."""
import pathlib
import subprocess

import yaml

from ros_session import SessionError

PATIENCE = 120.0  # s of wall time for one frame


def package():
    found = subprocess.run(["rospack", "find", "field_fusion"], check=True, stdout=subprocess.PIPE, text=True)
    return pathlib.Path(found.stdout.strip())


def tool(*arguments, quiet=False):
    """Runs one of the package's programs; raises SessionError with what it wrote."""
    done = subprocess.run(["rosrun", "field_fusion", *map(str, arguments)], stdin=subprocess.DEVNULL, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if not quiet:
        print(done.stdout, end="")
    if done.returncode != 0:
        raise SessionError(f"{arguments[0]} failed: {done.stdout.strip()}")


def patient_robot(file, camera, changes=None):
    """Writes the vessel's parameters, with `changes` {stage: {parameter: value}}, and with waits that only a broken
    stage exceeds: a slow machine must not change the score."""
    robot = yaml.safe_load((package() / "config/robots/usv.yaml").read_text())
    patience = {"match": {"partner_timeout": PATIENCE, "hold_limit": 10.0}, "detect": {"hold_limit": 10.0}}
    for layer in (changes or {}, patience if camera else {}):
        for stage, values in layer.items():
            robot.setdefault(stage, {}).update(values)
    file.write_text(yaml.safe_dump(robot))
    return file
