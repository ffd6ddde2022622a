"""What runs of the package's stages share: its folder, its programs, the parameters of its robot."""
import pathlib
import subprocess

import yaml

from ros_session import SessionError

DETECTOR = "models/usv.onnx"  # of the package
SIM_TOPICS = ("points:=/lidar/points", "image:=/camera/image_raw", "camera_info:=/camera/camera_info")  # of simulated worlds, to usv.launch
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


def shipped_robot(name):
    """{stage: {parameter: value}}, what differs from the defaults."""
    return yaml.safe_load((package() / f"config/robots/{name}.yaml").read_text())


def defaults(stage):
    return yaml.safe_load((package() / f"config/{stage}.yaml").read_text())


def robot(file, changes):
    """Writes the vessel's parameters with `changes` {stage: {parameter: value}} (of a table {class: value}). Returns
    what it wrote."""
    values = yaml.safe_load((package() / "config/robots/usv.yaml").read_text())
    for stage, changed in changes.items():
        known = values.setdefault(stage, {})
        for key, value in changed.items():
            table = known.get(key, defaults(stage)[key]) if isinstance(value, dict) else None
            known[key] = {**table, **value} if table is not None else value
    file.write_text(yaml.safe_dump(values))
    return values


def patient_robot(file, camera, changes=None):
    """The same, with waits that only a broken stage exceeds: a slow machine must not change the score."""
    patience = {"match": {"partner_timeout": PATIENCE, "hold_limit": 10.0}, "detect": {"hold_limit": 10.0}} if camera else {}
    both = {stage: {**(changes or {}).get(stage, {}), **patience.get(stage, {})} for stage in {**(changes or {}), **patience}}
    return robot(file, both)
