"""A recording in KITTI's layout through the nodelets of usv.launch, in lock-step."""
import pathlib

import stage_run
from ros_session import SessionError

PATIENCE = stage_run.PATIENCE
TOPICS = ("/camera_info", "/image_raw", "/points")  # in this order: the image finds its camera there


def names_of(recording):
    """Of the frames, in their order."""
    return [file.stem for file in sorted((pathlib.Path(recording) / "velodyne").glob("*.bin"))]


def frames_of(bag_file):
    """[(stamp, {topic: message})] in the order of time, and the static transforms at the start. Those that change
    later are among the messages of their frame."""
    import rosbag  # of ROS, that the function above does without

    frames, static = {}, None
    with rosbag.Bag(str(bag_file)) as bag:
        for topic, message, stamp in bag.read_messages():
            if topic == "/tf_static" and static is None:
                static = message
            elif topic in (*TOPICS, "/tf_static"):
                frames.setdefault(stamp, {})[topic] = message
    return sorted(frames.items()), static


def play(session, recording, folder, model=None, rate=10.0, every=1, also=None):
    """Yields (place of the frame, {topic: message}) with the obstacles, the clusters and the topics of `also`
    {topic: type}. Without `model` the LiDAR is alone. Bag and parameters are written to `folder`; the process must
    have a node in `session`."""
    from field_fusion.msg import ClusterArray, ObstacleArray
    from lock_step import LockStep

    folder.mkdir(parents=True, exist_ok=True)
    bag = folder / "recording.bag"
    stage_run.tool("kitti_to_bag", recording, bag, "--rate", rate)
    frames, static = frames_of(bag)
    if not model:
        frames = [(stamp, {topic: messages[topic] for topic in messages.keys() & {"/points", "/tf_static"}})
                  for stamp, messages in frames]
    robot = folder / "robot.yaml"
    stage_run.patient_robot(robot, bool(model))
    stages = session.launch(stage_run.package() / "launch/usv.launch", "rviz:=false", f"model:={model or ''}",
                            f"robot:={robot}")
    inputs = {topic: type(frames[0][1][topic]) for topic in TOPICS if topic in frames[0][1]}
    answers = {"/obstacles": ObstacleArray, "/clusters": ClusterArray, **(also or {})}
    steps = LockStep(inputs, static, answers)
    session.require(steps.connected, PATIENCE, "the stages did not start", stages)
    for place in range(0, len(frames), every):
        stamp, messages = frames[place]
        if "/tf_static" in messages:
            steps.transform(messages["/tf_static"])
        answer = steps.answer(messages, dict.fromkeys(answers, stamp), PATIENCE)
        if answer is None:
            raise SessionError(f"no answer to frame {place} of {recording} within {PATIENCE:.0f} s")
        yield place, answer
    steps.close()
    session.end(stages)
