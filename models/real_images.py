#!/usr/bin/env python3
"""Writes the labelled photographs of FIELD_FUSION_DATA as a data set, to score detectors of simulated bodies on.

  models/real_images.py OUT [--data FOLDER]

OUT gets images/real, labels/real and data.yaml with the classes person and car: the frames of KITTI's object
benchmark with their labels, and bus.jpg with the boxes that YOLOv8n is known to find there. Score with
`models/evaluate_detector.py MODEL OUT --split real`.
"""
import argparse
import json
import os
import pathlib
import sys

import cv2
import yaml

NAMES = ["person", "car"]
OF_KITTI = {"Pedestrian": "person", "Person_sitting": "person", "Car": "car"}


def kitti(folder):
    """(image's file, [(class, box [px])]) of each frame."""
    for labels in sorted((folder / "label_2").glob("*.txt")):
        rows = [line.split() for line in labels.read_text().splitlines()]
        yield folder / "image_2" / f"{labels.stem}.png", [(OF_KITTI[row[0]], [float(word) for word in row[4:8]])
                                                          for row in rows if row[0] in OF_KITTI]


def bus(folder):
    for entry in json.loads((folder / "bus_reference.json").read_text()):
        yield folder / entry["image"], [(found["class_name"], found["box_xyxy"]) for found in entry["detections"]
                                        if found["class_name"] in NAMES]


def line_of(name, box, width, height):
    x_min, y_min, x_max, y_max = box
    values = [(x_min + x_max) / 2 / width, (y_min + y_max) / 2 / height, (x_max - x_min) / width, (y_max - y_min) / height]
    return " ".join([str(NAMES.index(name)), *(f"{value:.6f}" for value in values)])


def write(out, name, file, bodies):
    image = cv2.imread(str(file))
    if image is None:
        raise OSError(f"{file}: cannot be read as an image")
    height, width = image.shape[:2]
    cv2.imwrite(str(out / "images/real" / f"{name}.png"), image)
    lines = [line_of(label, box, width, height) for label, box in bodies]
    (out / "labels/real" / f"{name}.txt").write_text("".join(f"{line}\n" for line in lines))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path, default=os.environ.get("FIELD_FUSION_DATA"))
    args = parser.parse_args()
    if not args.data:
        sys.exit("real_images: name the recordings: --data FOLDER, or FIELD_FUSION_DATA")
    try:
        found = [*kitti(args.data / "kitti_object"), *bus(args.data / "yolov8n_coco")]
        for kind in ("images", "labels"):
            (args.out / kind / "real").mkdir(parents=True, exist_ok=True)
        for file, bodies in found:
            write(args.out, f"{file.parent.parent.name}-{file.stem}".replace("_", "-"), file, bodies)
    except (OSError, ValueError) as fault:
        sys.exit(f"real_images: {fault}")
    (args.out / "data.yaml").write_text(yaml.safe_dump({"path": ".", "real": "images/real", "names": NAMES}, sort_keys=False))
    print(f"{args.out}: {len(found)} photographs, {sum(len(bodies) for _, bodies in found)} bodies")


if __name__ == "__main__":
    main()
