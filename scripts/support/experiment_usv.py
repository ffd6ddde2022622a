"""USV paper (001), section VII: Table I beside ours, 30 further positions, and the harbour."""
import argparse
import pathlib

import stage_run
import usv_harbour
import usv_latency
import usv_positions
import usv_report
import usv_small
import usv_timing

TITLE = __doc__
METHODS = {"optimal": "", "paper": "paper"}  # what runs, and the argument `method` of usv.launch
PARTS = ("table1", "far", "harbour", "small")
TIMED = ("timing", "latency")  # in real time: on a machine that does nothing else


def options(parser):
    parser.add_argument("--model", type=pathlib.Path, help=f"ONNX file of the detector (default: {stage_run.DETECTOR} of the package)")
    parser.add_argument("--detections", choices=("model", "truth"), default="model",
                        help="truth: what the simulated picture truly shows stands in for the detector")
    parser.add_argument("--places", nargs="+", metavar="PLACE", help="only these places of table1 (0200 ...) and far (0 ... 29)")
    parser.add_argument("--parts", nargs="+", choices=PARTS + TIMED, default=PARTS,
                        help=f"of the experiment (default: {' '.join(PARTS)})")
    parser.formatter_class = argparse.RawDescriptionHelpFormatter


def check(given):
    """Sets the model, None for the truth. Raises ValueError where there is none: the truth never stands in silently."""
    known = {str(place) for part in (usv_positions.TABLE, usv_positions.FURTHER) for place in part.places}
    unknown = set(given.places or []) - known
    if unknown:
        raise ValueError(f"no such place: {', '.join(sorted(unknown))}; there are {', '.join(sorted(known))}")
    asked = {str(place) for part in (usv_positions.TABLE, usv_positions.FURTHER) if part.name in given.parts for place in part.places}
    if given.places and not asked & set(given.places):
        raise ValueError(f"none of --places {' '.join(given.places)} is of --parts {' '.join(given.parts)}")
    if set(given.parts) <= {"timing"}:
        given.detections = "truth"  # a detector has no part in it
    if given.detections == "truth" and "latency" in given.parts:
        raise ValueError("the part latency needs a detector: --model FILE, and not the truth")
    if given.detections == "truth":
        if given.model:
            raise ValueError("--model and --detections truth exclude one another")
        return
    given.model = (given.model or stage_run.package() / stage_run.DETECTOR).resolve()
    if not given.model.is_file():
        raise ValueError(f"no such model: {given.model} (train one as models/ says, name another with --model FILE, or "
                         "look at the rest of the pipeline with --detections truth)")


def run(experiment):
    """Lines: tables, then figures."""
    given = experiment.given
    if not given.model:
        experiment.say("DETECTIONS ARE THE TRUTH of the simulator, not a detector's")
    tables, figures = [], []
    for part in (_places, _harbour, _small, _timed):
        for name, columns, rows, table, lines in part(experiment):
            experiment.table(f"usv_{name}", columns, rows)
            tables += table
            figures += lines
    return tables + figures


# Of each part: (name, columns and rows of its CSV, lines of its table, figures).

def _places(experiment):
    given, measured = experiment.given, []
    for part in (usv_positions.TABLE, usv_positions.FURTHER):
        if part.name in given.parts and usv_positions.chosen(experiment, part):
            rows = usv_positions.run(experiment, METHODS, part)
            measured.append((part, rows))
            table = usv_report.table if part is usv_positions.TABLE else usv_report.far_table
            yield part.name, usv_report.COLUMNS, usv_report.csv_rows(rows), table(rows), usv_report.lines(part, rows)
    if measured and given.out:
        usv_report.plot(measured, experiment.folder / "usv_errors.png")


def _harbour(experiment):
    if "harbour" in experiment.given.parts:
        tallies = usv_harbour.run(experiment, METHODS)
        yield "harbour", usv_harbour.COLUMNS, usv_harbour.csv_rows(tallies), usv_harbour.table(tallies), usv_harbour.lines(tallies)


def _small(experiment):
    if "small" in experiment.given.parts:
        found = usv_small.run(experiment, METHODS)
        yield "small", usv_small.COLUMNS, usv_small.csv_rows(found), usv_small.table(found), usv_small.lines(found)


def _timed(experiment):
    for name, module in (("timing", usv_timing), ("latency", usv_latency)):
        if name in experiment.given.parts:
            rows = module.run(experiment)
            yield name, module.COLUMNS, module.csv_rows(rows), module.table(rows), module.lines(rows)
