#!/usr/bin/env python3
"""A sheet of labelled pictures to look at.

  models/show_dataset.py DATASET SHEET.jpg [--set train] [--rows 3] [--columns 4]
"""
import argparse
import pathlib
import sys

import cv2
import numpy
import yaml

TILE = (400, 225)  # px


def tile(picture, names):
    image = cv2.imread(str(picture))
    scale = min(TILE[0] / image.shape[1], TILE[1] / image.shape[0])
    image = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    height, width = image.shape[:2]
    label = picture.parents[2] / "labels" / picture.parent.name / f"{picture.stem}.txt"
    for line in label.read_text().splitlines():
        kind, *box = line.split()
        x, y, w, h = (float(number) * size for number, size in zip(box, (width, height, width, height)))
        low = (int(x - w / 2), int(y - h / 2))
        cv2.rectangle(image, low, (int(x + w / 2), int(y + h / 2)), (0, 255, 0), 1)
        cv2.putText(image, names[int(kind)], (low[0], max(8, low[1] - 2)), cv2.FONT_HERSHEY_SIMPLEX, 0.32, (0, 255, 255), 1,
                    cv2.LINE_AA)
    framed = numpy.zeros((TILE[1], TILE[0], 3), numpy.uint8)
    framed[:height, (TILE[0] - width) // 2:(TILE[0] + width) // 2] = image
    return framed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("dataset", type=pathlib.Path)
    parser.add_argument("sheet")
    parser.add_argument("--set", default="train")
    parser.add_argument("--rows", type=int, default=3)
    parser.add_argument("--columns", type=int, default=4)
    args = parser.parse_args()
    names = yaml.safe_load((args.dataset / "data.yaml").read_text())["names"]
    pictures = sorted((args.dataset / "images" / args.set).glob("*.jpg"))
    count = args.rows * args.columns
    if len(pictures) < count:
        sys.exit(f"show_dataset: {len(pictures)} pictures in {args.dataset}/images/{args.set}, {count} are needed")
    chosen = [tile(pictures[i * len(pictures) // count], names) for i in range(count)]
    rows = [numpy.hstack(chosen[i:i + args.columns]) for i in range(0, count, args.columns)]
    cv2.imwrite(args.sheet, numpy.vstack(rows), [cv2.IMWRITE_JPEG_QUALITY, 80])


if __name__ == "__main__":
    main()
