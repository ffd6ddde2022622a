#!/usr/bin/env python3
"""Averages two exported detectors, one of which was trained on from the other: what the later one has learnt, without all
that it has forgotten meanwhile (Wortsman et al. 2022, "Model soups").

  models/average_detectors.py EARLIER.onnx LATER.onnx OUT.onnx [--share 0.5]
"""
import argparse
import sys

import onnx
from onnx import numpy_helper

from yolov8.arguments import number
from yolov8.onnx_weights import check_finite, names_of
from yolov8.whole_file import whole


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("earlier")
    parser.add_argument("later")
    parser.add_argument("out")
    parser.add_argument("--share", type=number(float, 0, 1), default=0.5, help="of the later one, 0 to 1; 0.5")
    return parser.parse_args()


def read(path):
    try:
        model = onnx.load(path)
        names_of(model)
        check_finite(model)
        return model
    except Exception as fault:  # onnx, protobuf and the names each have kinds of their own
        raise ValueError(f"{path}: {fault}") from None


def average(model, other, share):
    """Into `model`. ValueError where the two are no networks of one kind."""
    theirs = {tensor.name: tensor for tensor in other.graph.initializer}
    shapes = [{tensor.name: tuple(tensor.dims) for tensor in one.graph.initializer} for one in (model, other)]
    if shapes[0] != shapes[1] or names_of(model) != names_of(other):
        raise ValueError("the two are not of one shape, or know other classes")
    for tensor in model.graph.initializer:
        mine = numpy_helper.to_array(tensor)
        if mine.dtype.kind == "f":
            mean = (1.0 - share) * mine + share * numpy_helper.to_array(theirs[tensor.name])
            tensor.CopyFrom(numpy_helper.from_array(mean.astype(mine.dtype), tensor.name))


def main():
    args = arguments()
    try:
        model = read(args.earlier)
        average(model, read(args.later), args.share)
        with whole(args.out) as part:
            onnx.save(model, str(part))
    except (OSError, ValueError) as fault:
        sys.exit(f"average_detectors: {fault}")
    print(f"{args.out}: {1.0 - args.share:g} of {args.earlier}, {args.share:g} of {args.later}")


if __name__ == "__main__":
    main()
