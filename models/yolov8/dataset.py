"""A folder of labelled images: images/SPLIT/NAME.jpg, labels/SPLIT/NAME.txt and data.yaml with the `names`."""
import pathlib
import zlib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import cv2
import numpy as np
import yaml

IMAGE_SUFFIXES = {".jpg", ".jpeg", ".png"}
GREY = 114  # of the padding, as the `detect` stage has it


class DataError(Exception):
    pass


@dataclass
class Sample:
    image: np.ndarray    # HxWx3 uint8 BGR, scaled to fit into the network's input
    boxes: np.ndarray    # Mx4 float32, corners [px of `image`]
    classes: np.ndarray  # M int64


def numbered(names):
    if sorted(names) != list(range(len(names))):
        raise ValueError(f"'names' are numbered {', '.join(map(repr, names))}, not 0 to {len(names) - 1}")
    return names.items()


def class_names(folder):
    path = pathlib.Path(folder) / "data.yaml"
    try:
        names = yaml.safe_load(path.read_text())["names"]
        if isinstance(names, dict):
            names = [name for _, name in sorted(numbered(names))]
        if not names or not all(isinstance(name, str) for name in names):
            raise ValueError("'names' is no list of words")
        if len(set(names)) < len(names):
            raise ValueError("'names' has a name twice")
    except (OSError, KeyError, TypeError, ValueError, yaml.YAMLError) as fault:
        raise DataError(f"{path}: no class names: {fault}") from None
    return list(names)


def read_labels(path, classes):
    """Rows (class, x, y, width, height), relative to the image. An empty file is an image of nothing."""
    rows = []
    try:
        lines = path.read_text().splitlines()
    except UnicodeDecodeError:
        raise DataError(f"{path}: is no text") from None
    for number, line in enumerate(lines, 1):
        try:
            row = [float(word) for word in line.split()]
        except ValueError:
            raise DataError(f"{path}:{number}: '{line}' is not five numbers") from None
        if not row:
            continue
        if len(row) != 5 or not np.isfinite(row).all():
            raise DataError(f"{path}:{number}: '{line}' is not five numbers")
        if row[0] not in range(classes):
            raise DataError(f"{path}:{number}: class {row[0]:g}, but there are {classes}")
        if min(row[1:]) < 0 or max(row[1:]) > 1 or min(row[3:]) == 0:
            raise DataError(f"{path}:{number}: box {line.split()[1:]} has no area or is not within 0..1")
        rows.append(row)
    return np.array(rows, np.float32).reshape(-1, 5)


def read_image(path):
    """HxWx3 uint8 BGR. OpenCV fills with grey what a JPEG lacks: one whose last scan does not end is refused."""
    content = path.read_bytes()
    image = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR) if content else None
    if image is None:
        raise DataError(f"{path}: cannot be read as an image")
    if content.startswith(b"\xff\xd8") and content.rfind(b"\xff\xd9") < content.rfind(b"\xff\xda"):
        raise DataError(f"{path}: is cut short")
    return image


def fitted_size(width, height, size):
    """Of an image scaled to fit into `size` (width, height), as src/core/detect/letterbox.cpp rounds it."""
    scale = min(size[0] / width, size[1] / height)
    return max(1, round(width * scale)), max(1, round(height * scale))


class Dataset:
    """One split, all of its images in memory. `size`: (width, height) of the network's input [px]."""

    def __init__(self, folder, split, size, workers=2):
        self.folder, self.split, self.size = pathlib.Path(folder), split, size
        self.names = class_names(folder)
        images = self.folder / "images" / split
        self.paths = sorted(p for p in images.glob("*") if p.suffix.lower() in IMAGE_SUFFIXES)
        if not self.paths:
            raise DataError(f"{images}: no images")
        with ThreadPoolExecutor(workers) as pool:
            loaded = list(pool.map(self._load, self.paths))
        self.samples = [sample for sample, _ in loaded]
        self.original_sizes = [size for _, size in loaded]  # (width, height)

    def __len__(self):
        return len(self.samples)

    def fingerprint(self):
        """Of which images these are, by their names."""
        return zlib.crc32("\n".join(path.name for path in self.paths).encode())

    def _load(self, path):
        labels = self.folder / "labels" / self.split / (path.stem + ".txt")
        if not labels.is_file():
            raise DataError(f"{labels}: no such file, but there is {path}")
        rows = read_labels(labels, len(self.names))
        image = read_image(path)
        height, width = image.shape[:2]
        fitted = fitted_size(width, height, self.size)
        if fitted != (width, height):
            image = cv2.resize(image, fitted, interpolation=cv2.INTER_LINEAR)
        middle, half = rows[:, 1:3] * fitted, rows[:, 3:5] * fitted / 2
        boxes = np.concatenate([middle - half, middle + half], 1).astype(np.float32)
        return Sample(image, boxes, rows[:, 0].astype(np.int64)), (width, height)
