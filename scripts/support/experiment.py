"""What the experiments of `reproduce` share: each is a module experiment_NAME.py beside this file with a TITLE,
`options(parser)` for arguments of its own, and `run(experiment)`, which returns the lines to print, figures last."""
import csv
import importlib
import pathlib

import sim_world
import stage_run

PREFIX = "experiment_"


def names():
    return sorted(file.stem[len(PREFIX):].replace("_", "-") for file in pathlib.Path(__file__).parent.glob(f"{PREFIX}*.py"))


def module(name):
    return importlib.import_module(PREFIX + name.replace("-", "_"))


class Experiment:
    """`given`: what was asked for on the command line. Everything is written to `folder`; bags are kept there where
    `given.out` says so."""

    def __init__(self, given, session, folder):
        self.given, self.session, self.folder = given, session, folder
        self.quick, self.seeds = given.quick, range(1, (given.seeds or (1 if given.quick else 5)) + 1)

    def say(self, text):
        print(text, flush=True)

    def world_file(self, world):
        """Of a world (a dictionary), with the sensors as bad as was asked for."""
        return sim_world.write(sim_world.degraded(world, self.given.degrade), self.folder)

    def bag(self, world, seconds, seed, *more):
        file = self.world_file(world)
        bag = self.folder / "bags" / f"{world['name']}_{seed}.bag"
        bag.parent.mkdir(exist_ok=True)
        stage_run.tool("make_bag", file, bag, "--seconds", seconds, "--seed", seed, *more, quiet=True)
        return bag

    def done(self, bag):
        if not self.given.out:
            bag.unlink()

    def table(self, name, columns, rows):
        with open(self.folder / f"{name}.csv", "w", newline="") as file:
            csv.writer(file).writerows([columns, *rows])
