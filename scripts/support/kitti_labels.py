"""Labels and calibration of KITTI's object and tracking benchmarks (Geiger et al. 2012), and the labelled boxes
in the LiDAR's frame."""
import dataclasses
import math
import pathlib

import numpy

KINDS = ("Car", "Van", "Truck", "Pedestrian", "Person_sitting", "Person", "Cyclist", "Tram", "Misc", "DontCare")
DONT_CARE = "DontCare"


class BadFile(ValueError):
    """Names the file, the line where there is one, and what is wrong."""


@dataclasses.dataclass(frozen=True)
class Body:
    """A labelled body, in metres and radians, in the LiDAR's frame (x forward, y left, z up). Of a DontCare area
    only `kind` and `image_box` mean something."""
    kind: str
    track: int  # -1 where the recording has no tracks
    image_box: tuple  # px: left, top, right, bottom
    centre: numpy.ndarray  # of the box
    size: numpy.ndarray  # along its axes: length, width, height
    axes: numpy.ndarray  # 3x3, a row an axis

    @property
    def distance(self):
        """Horizontal, to the box's centre."""
        return math.hypot(*self.centre[:2])

    @property
    def pixels_high(self):
        return self.image_box[3] - self.image_box[1]

    def contains(self, points, margin=0.0):
        """Whether each of the points (n x 3) lies in the box, grown by `margin` on every side."""
        along = numpy.abs((points - self.centre) @ self.axes.T)
        return (along <= self.size / 2 + margin).all(axis=1)

    def outline(self):
        """The four corners of the box seen from above, in turn (4 x 2)."""
        length, width = self.axes[0, :2] * self.size[0] / 2, self.axes[1, :2] * self.size[1] / 2
        return self.centre[:2] + [length + width, length - width, -length - width, -length + width]

    def nearest_range(self):
        """[m] horizontal, from the LiDAR to the nearest of the box; 0 from within."""
        return box_range(self.centre, self.size, self.axes)

    def azimuth(self):
        """[rad] middle of the directions in which the LiDAR sees the box."""
        return middle_azimuth(self.outline())


def box_range(centre, size, axes):
    """[m] horizontal, from the origin to the nearest of an upright box; 0 from within. Its axes are rows."""
    return math.hypot(*numpy.maximum(numpy.abs(axes[:2, :2] @ centre[:2]) - size[:2] / 2, 0.0))


def middle_azimuth(points):
    """[rad] middle of the sector, less than half a turn, that holds all the points (n x 2 or more)."""
    facing = math.atan2(*numpy.mean(points[:, 1::-1], axis=0))
    off = numpy.arctan2(points[:, 1], points[:, 0]) - facing
    off = (off + math.pi) % math.tau - math.pi
    return math.remainder(facing + (off.min() + off.max()) / 2, math.tau)


@dataclasses.dataclass(frozen=True)
class Calibration:
    projection: numpy.ndarray  # 3x4, reference camera (rectified) -> pixels of the left colour camera
    T_camera_lidar: numpy.ndarray  # 4x4, to the rectified reference camera, in which the labels stand

    def pixels(self, points):
        """Where the colour camera sees points (n x 3) of the LiDAR's frame (n x 2); NaN for those behind it."""
        seen = numpy.c_[points, numpy.ones(len(points))] @ (self.projection @ self.T_camera_lidar).T
        return seen[:, :2] / numpy.where(seen[:, 2:] > 0.0, seen[:, 2:], math.nan)

    def from_colour_camera(self, points):
        """Points (n x 3) of the colour camera's optical frame in the LiDAR's frame."""
        in_reference = points - numpy.linalg.solve(self.projection[:, :3], self.projection[:, 3])
        T_lidar_camera = numpy.linalg.inv(self.T_camera_lidar)
        return in_reference @ T_lidar_camera[:3, :3].T + T_lidar_camera[:3, 3]


def calibration_file(folder, frame):
    """Of the frame of this name, in a folder of either layout."""
    folder = pathlib.Path(folder)
    return folder / "calib" / f"{frame}.txt" if (folder / "calib").is_dir() else folder / "calib.txt"


def read_calibration(file):
    rows = {}
    for number, line in enumerate(_lines(file), 1):
        key, *values = line.replace(":", " ").split() or [""]
        if key in ("P2", "R0_rect", "R_rect", "Tr_velo_to_cam", "Tr_velo_cam"):
            rows[{"R_rect": "R0_rect", "Tr_velo_cam": "Tr_velo_to_cam"}.get(key, key)] = _numbers(values, file, number)
    for key, count in (("P2", 12), ("R0_rect", 9), ("Tr_velo_to_cam", 12)):
        if len(rows.get(key, [])) != count:
            raise BadFile(f"{file}: {key} should be {count} numbers, has {len(rows.get(key, []))}")
    rectified, lidar = numpy.eye(4), numpy.eye(4)
    rectified[:3, :3] = numpy.reshape(rows["R0_rect"], (3, 3))
    lidar[:3] = numpy.reshape(rows["Tr_velo_to_cam"], (3, 4))
    projection = numpy.reshape(rows["P2"], (3, 4))
    for name, matrix in (("R0_rect times Tr_velo_to_cam", rectified @ lidar), ("P2", projection[:, :3])):
        if abs(numpy.linalg.det(matrix)) < 1e-6:
            raise BadFile(f"{file}: {name} cannot be inverted")
    return Calibration(projection, rectified @ lidar)


def read_object_labels(file, calibration):
    """The bodies of `label_2/NAME.txt`, DontCare areas among them."""
    return [_body(words, -1, calibration, file, number)
            for number, words in enumerate(map(str.split, _lines(file)), 1) if words]


def read_tracking_labels(file, calibration_of):
    """{frame: bodies} of `label.txt`; `calibration_of(frame)` gives the Calibration."""
    frames = {}
    for number, words in enumerate(map(str.split, _lines(file)), 1):
        if not words:
            continue
        if len(words) < 2 or not all(word.lstrip("-").isdigit() for word in words[:2]):
            raise BadFile(f"{file}:{number}: should begin with the numbers of a frame and a track")
        frame, track = map(int, words[:2])
        frames.setdefault(frame, []).append(_body(words[2:], track, calibration_of(frame), file, number))
    return frames


def _body(words, track, calibration, file, number):
    if not words or words[0] not in KINDS:
        raise BadFile(f"{file}:{number}: should name one of {', '.join(KINDS)}, has {words[0] if words else 'nothing'}")
    values = _numbers(words[1:], file, number)
    if len(values) not in (14, 15):  # the last is a detector's score
        raise BadFile(f"{file}:{number}: should have 14 numbers behind {words[0]}, has {len(values)}")
    height, width, length, x, y, z, turn = values[7:14]
    if words[0] != DONT_CARE and min(height, width, length) <= 0.0:
        raise BadFile(f"{file}:{number}: the size of the {words[0]} is not above zero")
    T_lidar_camera = numpy.linalg.inv(calibration.T_camera_lidar)
    forward = numpy.array([math.cos(turn), 0.0, -math.sin(turn)])  # the camera's y points down
    up = numpy.array([0.0, -1.0, 0.0])
    axes = numpy.array([forward, numpy.cross(up, forward), up]) @ T_lidar_camera[:3, :3].T
    centre = T_lidar_camera @ [x, y - height / 2, z, 1.0]  # labels give the middle of the lower face
    return Body(words[0], track, tuple(values[3:7]), centre[:3], numpy.array([length, width, height]), axes)


def _numbers(words, file, number):
    try:
        values = [float(word) for word in words]
    except ValueError as error:
        raise BadFile(f"{file}:{number}: {error}") from None
    if not all(map(math.isfinite, values)):
        raise BadFile(f"{file}:{number}: a number is not finite")
    return values


def _lines(file):
    try:
        return pathlib.Path(file).read_text().splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise BadFile(f"cannot read {file}: {error}") from None
