"""USV paper (001), section VII: Table I beside ours, 30 further positions, and the harbour."""
import argparse
import pathlib

import stage_run
import usv_harbour
import usv_positions

TITLE = __doc__
METHODS = {"optimal": "", "paper": "paper"}  # what runs, and the argument `method` of usv.launch
PARTS = ("table1", "far", "harbour")
HARBOUR = {"match": {"class_diameters": {"cage": 4.5}, "class_nets": {"cage": 3.9}, "size_spread": 0.2}}  # as the user knows them
MODEL = "models/usv.onnx"


def options(parser):
    parser.add_argument("--model", type=pathlib.Path, help=f"ONNX file of the detector (default: {MODEL} of the package)")
    parser.add_argument("--detections", choices=("model", "truth"), default="model",
                        help="truth: what the simulated picture truly shows stands in for the detector")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=PARTS, help="of the experiment (default: all)")
    parser.formatter_class = argparse.RawDescriptionHelpFormatter


def check(given):
    """Sets the model, None for the truth. Raises ValueError where there is none: the truth never stands in silently."""
    if given.detections == "truth":
        if given.model:
            raise ValueError("--model and --detections truth exclude one another")
        return
    given.model = (given.model or stage_run.package() / MODEL).resolve()
    if not given.model.is_file():
        raise ValueError(f"no such model: {given.model} (train one as models/ says, name another with --model FILE, or "
                         "look at the rest of the pipeline with --detections truth)")


def run(experiment):
    given = experiment.given
    if not given.model:
        print("DETECTIONS ARE THE TRUTH of the simulator, not a detector's", flush=True)
    for part in (usv_positions.TABLE, usv_positions.FURTHER):
        if part.name in given.parts:
            yield from usv_positions.run(experiment, METHODS, part)
    if "harbour" in given.parts:
        yield from usv_harbour.report(usv_harbour.run(experiment, METHODS, HARBOUR))
