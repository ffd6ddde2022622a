#!/usr/bin/env python3
"""Scores a detector on a labelled data set as COCO does: AP by class, overlap and size of body.

  models/evaluate_detector.py MODEL DATA [--split held_out] [--size 640x480]

MODEL is a checkpoint of train_detector.
"""
import argparse
import os
import sys

os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")

import torch  # noqa: E402

from yolov8.checkpoint import CheckpointError, load, network_of  # noqa: E402
from yolov8.dataset import DataError, Dataset  # noqa: E402
from yolov8.evaluate import OVERLAP, runner, score  # noqa: E402
from yolov8.report import score_table  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model")
    parser.add_argument("data")
    parser.add_argument("--split", default="val")
    parser.add_argument("--overlap", type=float, default=OVERLAP, help=f"of boxes that suppress each other; {OVERLAP}")
    return parser.parse_args()


def main():
    args = arguments()
    torch.set_num_threads(len(os.sched_getaffinity(0)))
    try:
        facts, tensors = load(args.model)
        data = Dataset(args.data, args.split, tuple(facts["size"]))
        if facts["names"] != data.names:
            raise DataError(f"{args.data}: classes {data.names}, but those of {args.model} are {facts['names']}")
    except (CheckpointError, DataError) as fault:
        sys.exit(f"evaluate_detector: {fault}")
    device = "cuda" if torch.cuda.is_available() else "cpu"
    scorer = score(runner(network_of(facts, tensors).to(device)), data, overlap=args.overlap)
    print(score_table(scorer))


if __name__ == "__main__":
    main()
