"""A recording in KITTI's layout through the nodelets of usv.launch, in lock-step."""
import pathlib
import subprocess

import yaml

from ros_session import SessionError

PATIENCE = 120.0  # s of wall time for one frame


def package():
    found = subprocess.run(["rospack", "find", "field_fusion"], check=True, stdout=subprocess.PIPE, text=True)
    return pathlib.Path(found.stdout.strip())


def tool(*arguments):
    """Runs one of the package's programs; raises SessionError with what it wrote."""
    done = subprocess.run(["rosrun", "field_fusion", *map(str, arguments)], stdin=subprocess.DEVNULL, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    print(done.stdout, end="")
    if done.returncode != 0:
        raise SessionError(f"{arguments[0]} failed: {done.stdout.strip()}")


def names_of(recording):
    """Of the frames, in their order."""
    return [file.stem for file in sorted((pathlib.Path(recording) / "velodyne").glob("*.bin"))]


def patient_robot(folder, camera):
    """The robot's parameters with waits that only a broken stage exceeds: a slow machine must not change
    the score."""
    robot = yaml.safe_load((package() / "config/robots/usv.yaml").read_text())
    if camera:
        robot.setdefault("match", {}).update(partner_timeout=PATIENCE, hold_limit=10.0)
        robot.setdefault("detect", {}).update(hold_limit=10.0)
    path = folder / "robot.yaml"
    path.write_text(yaml.safe_dump(robot))
    return path


def play(session, recording, folder, model=None, rate=10.0, every=1, also=None):
    """Yields (place of the frame, {topic: message}) with the obstacles, the clusters and the topics of `also`
    {topic: type}. Without `model` the LiDAR is alone. Bag and parameters are written to `folder`; the process must
    have a node in `session`."""
    from lock_step import LockStep, frames_of  # of ROS, that the functions above do without

    folder.mkdir(parents=True, exist_ok=True)
    bag = folder / "recording.bag"
    tool("kitti_to_bag", recording, bag, "--rate", rate)
    frames, static = frames_of(bag)
    if not model:
        frames = [(stamp, {topic: messages[topic] for topic in messages.keys() & {"/points", "/tf_static"}})
                  for stamp, messages in frames]
    stages = session.launch(package() / "launch/usv.launch", "rviz:=false", f"model:={model or ''}",
                            f"robot:={patient_robot(folder, bool(model))}")
    steps = LockStep(frames, static, also)
    session.require(steps.connected, PATIENCE, "the stages did not start", stages)
    for place in range(0, len(frames), every):
        answer = steps.answer(*frames[place], PATIENCE)
        if answer is None:
            raise SessionError(f"no answer to frame {place} of {recording} within {PATIENCE:.0f} s")
        yield place, answer
    steps.close()
    session.end(stages)
