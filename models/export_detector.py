#!/usr/bin/env python3
"""Writes a trained detector as ONNX, for the `detect` stage: raw heads, fixed size, names of the classes inside.

  models/export_detector.py CHECKPOINT OUT.onnx [--size 640x480]

The file is then run through OpenCV beside the network itself; where they differ, it is not kept.
"""
import argparse
import os
import sys

import cv2
import numpy as np
import torch

from yolov8.checkpoint import CheckpointError, load, network_of
from yolov8.arguments import input_size
from yolov8.export import export
from yolov8.whole_file import whole

LARGEST_ERROR = 1e-3


def difference(path, network, size):
    """The largest between OpenCV's outputs and the network's, for noise and for grey."""
    net = cv2.dnn.readNetFromONNX(str(path))
    noise = np.random.default_rng(0).uniform(0, 1, (1, 3, size[1], size[0])).astype(np.float32)
    largest = 0.0
    for image in (noise, np.full_like(noise, 0.5)):
        net.setInput(image)
        outputs = net.forward(net.getUnconnectedOutLayersNames())
        with torch.no_grad():
            wanted = {tuple(m.shape): m.numpy() for m in network(torch.from_numpy(image))}
        largest = max(largest, *(float(np.abs(found - wanted[found.shape]).max()) for found in outputs), key=_badness)
    return largest


def _badness(error):
    """NaN is worse than any number."""
    return float("inf") if np.isnan(error) else error


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkpoint")
    parser.add_argument("out")
    parser.add_argument("--size", type=input_size, help="of the input [px]; that of the training")
    args = parser.parse_args()
    try:
        facts, tensors = load(args.checkpoint)
    except CheckpointError as fault:
        sys.exit(f"export_detector: {fault}")
    network, size = network_of(facts, tensors), args.size or facts["size"]
    try:
        with whole(args.out) as part:
            export(network, facts["names"], size, part, {"license": "BSD-3-Clause", "author": "The field_fusion authors"})
            error = difference(part, network, size)
            if not error <= LARGEST_ERROR:
                sys.exit(f"export_detector: OpenCV {cv2.__version__} computes outputs that are off by {error:.2g}; nothing written")
    except OSError as fault:
        sys.exit(f"export_detector: {fault}")
    except RuntimeError as fault:  # of torch, also where it cannot write
        sys.exit(f"export_detector: {args.out} cannot be written: {fault}")
    print(f"{args.out}: input {size[0]}x{size[1]}, {len(facts['names'])} classes, {os.path.getsize(args.out) / 1e6:.1f} MB, "
          f"OpenCV {cv2.__version__} differs by {error:.1g} at most")


if __name__ == "__main__":
    main()
