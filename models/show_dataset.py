#!/usr/bin/env python3
"""A sheet of labelled pictures to look at.

  models/show_dataset.py DATASET SHEET.jpg [--set train] [--rows 3] [--columns 4]
"""
import argparse
import pathlib
import sys

import cv2
import numpy

from yolov8.arguments import number
from yolov8.dataset import DataError, class_names, read_image, read_labels

TILE = (400, 225)  # px


def tile(picture, names):
    image = read_image(picture)
    scale = min(TILE[0] / image.shape[1], TILE[1] / image.shape[0])
    image = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    height, width = image.shape[:2]
    label = picture.parents[2] / "labels" / picture.parent.name / f"{picture.stem}.txt"
    for kind, *box in read_labels(label, len(names)):
        x, y, w, h = numpy.multiply(box, (width, height, width, height))
        low = (int(x - w / 2), int(y - h / 2))
        cv2.rectangle(image, low, (int(x + w / 2), int(y + h / 2)), (0, 255, 0), 1)
        cv2.putText(image, names[int(kind)], (low[0], max(8, low[1] - 2)), cv2.FONT_HERSHEY_SIMPLEX, 0.32, (0, 255, 255), 1,
                    cv2.LINE_AA)
    framed = numpy.zeros((TILE[1], TILE[0], 3), numpy.uint8)
    framed[:height, (TILE[0] - width) // 2:(TILE[0] + width) // 2] = image
    return framed


def sheet(args):
    names = class_names(args.dataset)
    pictures = sorted((args.dataset / "images" / args.set).glob("*.jpg"))
    count = args.rows * args.columns
    if len(pictures) < count:
        raise DataError(f"{len(pictures)} pictures in {args.dataset}/images/{args.set}, {count} are needed")
    chosen = [tile(pictures[i * len(pictures) // count], names) for i in range(count)]
    return numpy.vstack([numpy.hstack(chosen[i:i + args.columns]) for i in range(0, count, args.columns)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dataset", type=pathlib.Path)
    parser.add_argument("sheet")
    parser.add_argument("--set", default="train")
    parser.add_argument("--rows", type=number(int, 1), default=3)
    parser.add_argument("--columns", type=number(int, 1), default=4)
    args = parser.parse_args()
    try:
        image = sheet(args)
    except (DataError, OSError) as fault:
        sys.exit(f"show_dataset: {fault}")
    try:
        written = cv2.imwrite(args.sheet, image, [cv2.IMWRITE_JPEG_QUALITY, 80])
    except cv2.error as fault:  # of an ending that is no image's
        sys.exit(f"show_dataset: {args.sheet}: {fault.err}")
    if not written:
        sys.exit(f"show_dataset: {args.sheet} cannot be written")


if __name__ == "__main__":
    main()
