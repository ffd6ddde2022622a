#!/usr/bin/env python3
"""Trains a YOLOv8 detector.

  models/train_detector.py DATA OUT [--epochs N | --minutes N] [--width 0.25] [--size 640 | 640x480] ...

DATA holds images/{train,val}/*.jpg, labels/{train,val}/*.txt with a line "class x y width height" for each body
(relative to the image; an empty file where there is none), and data.yaml with the `names`. OUT gets last.pt
(everything, for --resume), best.pt (the best validation) and epochs.csv. After an interruption, the same
command with --resume goes on where the last checkpoint was. Uses a GPU where torch finds one.
"""
import argparse
import dataclasses
import fcntl
import os
import pathlib
import signal
import sys

os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")  # before torch: threads that spin are slower on a busy machine

import torch  # noqa: E402

from yolov8.arguments import input_size, number  # noqa: E402
from yolov8.checkpoint import CheckpointError, load  # noqa: E402
from yolov8.dataset import DataError, Dataset  # noqa: E402
from yolov8.report import Report  # noqa: E402
from yolov8.train import Settings, Training  # noqa: E402


CORES = len(os.sched_getaffinity(0))


def arguments():
    default = {field.name: field.default for field in dataclasses.fields(Settings)}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data")
    parser.add_argument("out")
    end = parser.add_mutually_exclusive_group()
    end.add_argument("--epochs", type=number(int, 1), help="default: 100")
    end.add_argument("--minutes", type=number(float, 0, above=True), help="of training; as many epochs as fit")
    parser.add_argument("--resume", action="store_true", help="go on from OUT/last.pt, with its settings")
    parser.add_argument("--weights", metavar="FILE", help="begin with those of a best.pt, last.pt or exported .onnx of the same shape")
    parser.add_argument("--size", type=input_size, default=default["size"], help="of the network's input [px]; 640")
    parser.add_argument("--optimizer", choices=("adamw", "sgd"), default=default["optimizer"])
    parser.add_argument("--rate", type=number(float, 0, above=True), help="highest learning rate; default: 0.002 for adamw, 0.01 for sgd")
    parser.add_argument("--threads", type=number(int, 1, CORES), default=CORES, help="of the CPU; all of them")
    parser.add_argument("--bf16", action="store_true", help="16-bit arithmetic: faster on GPUs, slower on most CPUs")
    whole, part, positive = number(int, 1), number(float, 0, 1), number(float, 0, 4, above=True)
    kinds = {"width": positive, "depth": positive, "batch": whole, "seed": number(int, 0, 2**63 - 1), "validate": whole, "workers": whole}
    for name, help_text in (("width", "share of the channels: 0.25 is YOLOv8n"), ("depth", "share of the blocks: 1/3 is YOLOv8n"),
                            ("batch", "images a step"), ("seed", "of weights and samples"),
                            ("mosaic", "share of samples made of four images"),
                            ("plain", "last share of the training, without mosaics"),
                            ("cuttings", "first share of the training, on quarters of images around bodies"),
                            ("validate", "epochs from one validation to the next"), ("workers", "threads that make batches")):
        parser.add_argument(f"--{name}", type=kinds.get(name, part), default=default[name],
                            help=f"{help_text}; {default[name]:g}")
    args = parser.parse_args()
    if args.resume:
        given = {word.split("=")[0] for word in sys.argv[1:] if word.startswith("--")} - {"--resume", "--threads"}
        if given:
            parser.error(f"--resume goes on with the settings of OUT/last.pt; it does not take {', '.join(sorted(given))}. "
                         "To train on with others, name a new OUT and --weights OUT/last.pt")
    return args


def settings_of(args):
    chosen = {field.name: getattr(args, field.name) for field in dataclasses.fields(Settings)}
    if args.epochs is None and args.minutes is None:
        chosen["epochs"] = 100
    return Settings(**chosen)


def settings_from(saved, path):
    names = {field.name for field in dataclasses.fields(Settings)}
    if set(saved) != names:
        raise CheckpointError(f"{path}: made by another version; they differ in {', '.join(sorted(names ^ set(saved)))}")
    return Settings(**{**saved, "size": tuple(saved["size"]), "weights": None})  # its own go on


def started(args):
    last, facts = pathlib.Path(args.out) / "last.pt", None
    if args.resume:
        facts, tensors = load(last, resumed=True)
        settings = settings_from(facts["settings"], last)
    elif last.exists():
        raise CheckpointError(f"{last} exists: --resume goes on with it, another OUT begins anew")
    else:
        settings = settings_of(args)
    data, validation = (Dataset(args.data, split, settings.size) for split in ("train", "val"))
    if facts and facts["names"] != data.names:
        raise CheckpointError(f"{last}: its classes are {facts['names']}, those of {args.data} {data.names}")
    if facts and facts.get("images") != data.fingerprint():
        raise CheckpointError(f"{last}: was made from other images than the {len(data)} of {args.data}. To train on with these, "
                              f"name a new OUT and --weights {last}")
    training = Training(settings, data, validation, args.out, Report())
    if facts:
        training.restore(facts, tensors)
    print(f"{len(data)} images to train, {len(validation)} to validate, {len(data.names)} classes, on {training.device} with "
          f"{torch.get_num_threads()} threads, torch {torch.__version__}", flush=True)
    return training


def lock(out):
    """Until this process ends, however it does: two trainings in one folder would overwrite each other's."""
    try:
        fcntl.flock(os.open(out, os.O_RDONLY | os.O_DIRECTORY), fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise CheckpointError(f"{out}: another training writes to it") from None


def stop_by_signal(training):
    def on_signal(*_):
        training.stop = True

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, on_signal)


def main():
    args = arguments()
    torch.set_num_threads(args.threads)
    try:
        pathlib.Path(args.out).mkdir(parents=True, exist_ok=True)
        lock(args.out)
        training = started(args)
    except (DataError, CheckpointError, ValueError, OSError) as fault:
        sys.exit(f"train_detector: {fault}")
    except KeyboardInterrupt:
        sys.exit("train_detector: interrupted before it began")
    if training.ended:
        sys.exit(f"train_detector: {training.out / 'last.pt'} has ended; to train on, name a new OUT and --weights {training.out / 'last.pt'}")
    stop_by_signal(training)
    try:
        training.run()
    except KeyboardInterrupt:
        sys.exit(f"\ntrain_detector: interrupted; --resume goes on from {training.out / 'last.pt'}")
    except FloatingPointError as fault:
        sys.exit(f"train_detector: {fault}")
    except OSError as fault:
        sys.exit(f"\ntrain_detector: {args.out}: {fault}")
    if training.best < 0:
        sys.exit(f"train_detector: no body to find in {args.data}/images/val: nothing tells which weights are best; {training.out / 'last.pt'} has the last")
    print(f"done: {training.out / 'best.pt'}, mAP50-95 {training.best:.3f}")


if __name__ == "__main__":
    main()
