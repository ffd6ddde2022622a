"""When what a simulated bag holds reaches the stages: a cloud when its turn is over, a picture after its camera's delay."""
import copy
import random
import typing

import genpy

import stand_in

TURN = 0.1  # s, of the LiDAR: a cloud's stamp is that of its first beam
CLOUDS, DETECTIONS, INFOS, IMAGES = "/lidar/points", "/detections", "/camera/camera_info", "/camera/image_raw"


class Arrival(typing.NamedTuple):
    due: float  # s, by the clock of the stamps
    topic: str
    message: object


class Camera(typing.NamedTuple):
    """How pictures come. A driver that stamps them as they come has its stamps late by the delay."""
    delay: float = 0.0  # s from the picture to its message
    stamped_late: bool = False
    lost: float = 0.0  # share of the pictures


def clouds(frames):
    return [Arrival(frame.stamp.to_sec() + TURN, CLOUDS, frame.cloud) for frame in frames]


def kept(pictures, camera, seed):
    """Those that are not lost; the same for the same seed."""
    draw = random.Random(seed)
    return [picture for picture in pictures if draw.random() >= camera.lost]


def detections(pictures, camera, parameters, seed):
    """Of the pictures that are not lost, what they truly show, as the stage `detect` with its `parameters` would tell it."""
    for picture in kept(pictures, camera, seed):
        message = stand_in.seen(picture.detections, picture.info, parameters)
        if camera.stamped_late:
            message.header = copy.deepcopy(message.header)
            message.header.stamp += genpy.Duration.from_sec(camera.delay)
        yield Arrival(picture.stamp.to_sec() + camera.delay, DETECTIONS, message)


def images(pictures, delay):
    for picture in pictures:
        due = picture.stamp.to_sec() + delay
        yield from (Arrival(due, INFOS, picture.info), Arrival(due, IMAGES, picture.image))


def ordered(*streams):
    return sorted((arrival for stream in streams for arrival in stream), key=lambda arrival: arrival.due)
