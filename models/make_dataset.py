#!/usr/bin/env python3
"""Writes the detector's data set with the simulator: random worlds, their bags, pictures and labels.

  models/make_dataset.py OUT [--train 2540] [--val 300] [--held-out 400] [--seed 1] [--jobs 2]

OUT/images/SET/*.jpg and OUT/labels/SET/*.txt as YOLO takes them, OUT/data.yaml, and OUT/worlds/ with the world
of each picture. `held_out` has shapes, patterns and skies that the others lack. The same seed writes the same
files; an interrupted run goes on where it ended when it is called again.
"""
import argparse
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import yaml

from data import random_world
from yolov8.arguments import number

CLASSES = pathlib.Path(__file__).with_name("classes.yaml")
SETS = ("train", "val", "held_out")
WORLDS_OF_A_SEED = 1_000_000
PARTIAL = ".partial_"  # of folders in OUT that an interrupted run leaves
LAST_EXPOSURE = 0.1  # s in which the last picture's message comes


def program(name):
    """Path of a built program; rosrun looks for it anew at each call, which takes longer than it runs."""
    found = subprocess.run(["catkin_find", "--first-only", "--libexec", "field_fusion", name], text=True,
                           capture_output=True, check=False).stdout.strip()
    if not found:
        sys.exit(f"make_dataset: no {name}; build the package and source its setup.bash")
    return found


def run(*command):
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(map(str, command))}\n{done.stderr}")


def make_world(out, name, split, seed, frames, programs):
    """Pictures of one world; its file, written last, says that they are all there."""
    with tempfile.TemporaryDirectory(dir=out, prefix=PARTIAL) as folder:
        world, bag = pathlib.Path(folder) / f"{name}.yaml", pathlib.Path(folder) / f"{name}.bag"
        random_world.write(world, split, seed)
        seconds = random_world.PAUSE * (frames - 1) + LAST_EXPOSURE
        run(programs["make_bag"], world, bag, "--mounts", "camera", "--seconds", seconds, "--seed", seed % 2**31)
        run(programs["bag_to_images"], bag, folder, "--labels", "/truth/camera/detections", "--classes", CLASSES,
            "--set", split)
        for kind in ("images", "labels"):
            for file in (pathlib.Path(folder) / kind / split).iterdir():
                os.replace(file, out / kind / split / file.name)
        os.replace(world, out / "worlds" / world.name)


def jobs_of(out, split, images, seed):
    """(name, split, seed, frames) of the worlds that are not there yet, and how many pictures they have."""
    frames = random_world.FRAMES
    every = [(f"{split}_{i:05d}", split, seed * WORLDS_OF_A_SEED + i, min(frames, images - i * frames))
             for i in range(-(-images // frames))]
    return [job for job in every if not is_there(out, *job)]


def is_there(out, name, split, _, frames):
    """A run that asked for fewer pictures may have left a world half filmed."""
    files = [out / "worlds" / f"{name}.yaml"] + [out / kind / split / f"{name}_{i:06d}.{ending}" for i in range(frames)
                                                 for kind, ending in (("images", "jpg"), ("labels", "txt"))]
    return all(file.exists() for file in files)


def make_all(out, jobs, workers, programs):
    began, done, everything = time.monotonic(), 0, sum(job[3] for job in jobs)
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        running = {pool.submit(make_world, out, *job, programs): job[3] for job in jobs}
        try:
            for future in concurrent.futures.as_completed(running):
                future.result()
                done += running[future]
                rate = done / (time.monotonic() - began)
                if sys.stderr.isatty():
                    print(f"\r{done}/{everything} pictures, {(everything - done) / rate:.0f} s to go  ", end="", file=sys.stderr)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return time.monotonic() - began


def write_description(out, seed):
    names = yaml.safe_load(CLASSES.read_text())["names"]
    text = {"path": ".", **{split: f"images/{split}" for split in SETS}, "names": names, "seed": seed}
    (out / "data.yaml").write_text(yaml.safe_dump(text, sort_keys=False, default_flow_style=None))


def check_seed(out, seed):
    """One folder holds the pictures of one seed."""
    file = out / "data.yaml"
    if not file.exists():
        return
    try:
        known = yaml.safe_load(file.read_text())["seed"]
    except (KeyError, TypeError, ValueError, yaml.YAMLError):
        raise RuntimeError(f"{file} is not of make_dataset; name an empty folder") from None
    if known != seed:
        raise RuntimeError(f"{file} is of another seed; name an empty folder")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    count = number(int, 0)
    parser.add_argument("--train", type=count, default=2540, help="pictures")
    parser.add_argument("--val", type=count, default=300)
    parser.add_argument("--held-out", type=count, default=400)
    parser.add_argument("--seed", type=count, default=1)
    parser.add_argument("--jobs", type=number(int, 1), default=os.cpu_count())
    args = parser.parse_args()
    programs = {name: program(name) for name in ("make_bag", "bag_to_images")}
    for split in SETS:
        for kind in ("images", "labels"):
            (args.out / kind / split).mkdir(parents=True, exist_ok=True)
    (args.out / "worlds").mkdir(exist_ok=True)
    check_seed(args.out, args.seed)
    write_description(args.out, args.seed)
    for left in args.out.glob(f"{PARTIAL}*"):
        shutil.rmtree(left)
    counts = {"train": args.train, "val": args.val, "held_out": args.held_out}
    jobs = [job for split in SETS for job in jobs_of(args.out, split, counts[split], args.seed)]
    took = make_all(args.out, jobs, args.jobs, programs)
    print(f"{args.out}: {sum(counts.values())} pictures, {sum(job[3] for job in jobs)} of them made in {took:.0f} s")


if __name__ == "__main__":
    try:
        main()
    except (RuntimeError, OSError, KeyboardInterrupt) as fault:
        sys.exit(f"make_dataset: {str(fault) or 'interrupted'}")
