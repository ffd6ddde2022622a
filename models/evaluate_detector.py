#!/usr/bin/env python3
"""Scores a detector on a labelled data set as COCO does: AP by class, overlap and size of body.

  models/evaluate_detector.py MODEL DATA [--split held_out]

MODEL is a checkpoint of train_detector or an ONNX file, which runs on OpenCV. Images whose names differ in what
stands after the last "_" alone are of one scene; the intervals are over scenes. The classes of DATA are looked up
among the model's by their names; the model's others are left out, and those that it lacks are named.
"""
import argparse
import os
import sys

os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")  # before torch

import torch  # noqa: E402

from yolov8.arguments import number  # noqa: E402
from yolov8.checkpoint import CheckpointError, load, network_of  # noqa: E402
from yolov8.dataset import DataError, Dataset, class_names  # noqa: E402
from yolov8.evaluate import CONFIDENCE, OVERLAP, runner, score  # noqa: E402
from yolov8.onnx_model import OnnxError, OnnxModel, renamed  # noqa: E402
from yolov8.report import score_table  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model")
    parser.add_argument("data")
    parser.add_argument("--split", default="val")
    parser.add_argument("--overlap", type=number(float, 0, 1), default=OVERLAP, help=f"of boxes that suppress each other; {OVERLAP}")
    parser.add_argument("--figure", default="detector", help="first words of the two figures at the end; detector")
    return parser.parse_args()


def detector(path, overlap):
    """(detect, names, size)"""
    if path.endswith(".onnx"):
        model = OnnxModel(path)
        return lambda images: model(images, CONFIDENCE, overlap), model.names, model.size
    facts, tensors = load(path)
    device = "cuda" if torch.cuda.is_available() else "cpu"
    return runner(network_of(facts, tensors).to(device), overlap=overlap), facts["names"], tuple(facts["size"])


def main():
    args = arguments()
    torch.set_num_threads(len(os.sched_getaffinity(0)))
    try:
        detect, names, size = detector(args.model, args.overlap)
        wanted = class_names(args.data)
        missing = [name for name in wanted if name not in names]
        if len(missing) == len(wanted):
            raise DataError(f"{args.data}: none of its classes is among those of {args.model}: {', '.join(names)}")
        data = Dataset(args.data, args.split, size)
        scorer = score(lambda images: [renamed(found, names, wanted) for found in detect(images)], data)
    except (CheckpointError, DataError, OnnxError) as fault:
        sys.exit(f"evaluate_detector: {fault}")
    print(score_table(scorer))
    if missing:
        print(f"The model does not know: {', '.join(missing)}")
    scenes = [path.stem.rpartition("_")[0] or path.stem for path in data.paths]
    print(f"{len(data)} images of {len(set(scenes))} scenes of {args.split}, input {size[0]}x{size[1]}")
    for name, value, (low, high) in zip(("map50", "map50_95"), scorer.summary(), scorer.intervals(scenes)):
        print(f"figure {args.figure}/{name} {value:.4g} - n={len(data)} ci=[{low:.4g},{high:.4g}]")


if __name__ == "__main__":
    main()
