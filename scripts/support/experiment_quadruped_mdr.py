"""Quadruped paper (004), section 3: its corridor mapped from raw and from deskewed scans, points on a walk, turns on the spot."""
import contextlib

import mdr_corridor
import mdr_room
import mdr_tune
from deskew_stages import DeskewStages, Method

TITLE = __doc__
PARTS = ("corridor", "walk", "rotation")
TUNE = "tune"  # of the rivals; takes long
METHODS = ("vicp", "imu", "mdr")


def options(parser):
    parser.add_argument("--parts", nargs="+", choices=(*PARTS, TUNE), default=PARTS,
                        help=f"of the experiment (default: {' '.join(PARTS)}); tune: settings of VICP and IMU on walks of other seeds")
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=METHODS,
                        help="that deskew (default: all; VICP takes most of the time)")


def check(given):
    if "mdr" not in given.methods:
        raise ValueError("--methods must name mdr, which the others are compared with")


def run(experiment):
    """Lines: tables, then figures."""
    tables, figures = [], []
    if TUNE in experiment.given.parts:
        for table in mdr_tune.run(experiment):
            tables += table
    for part in (_corridor, _room):
        for table, lines in part(experiment):
            tables += table
            figures += lines
    return [_settings(), *tables, *figures]


def _methods(part):
    """{name: Method}, each at its best in this part."""
    return {name: Method("odometry" if name == "mdr" else name, mdr_tune.TAKEN[part].get(name, {})) for name in METHODS}


def _settings():
    told = (f"{name}, {part}: {', '.join(f'{key} {value}' for key, value in method.changes.items()) or 'as shipped'}"
            for part in mdr_tune.TAKEN for name, method in _methods(part).items())
    return "settings: " + "; ".join(told)


@contextlib.contextmanager
def _stages(experiment, part):
    stages = DeskewStages(experiment.session, experiment.folder,
                          {name: method for name, method in _methods(part).items() if name in experiment.given.methods})
    try:
        yield stages
    finally:
        stages.close()


# Of each part: lines of its table, figures.

def _corridor(experiment):
    if "corridor" not in experiment.given.parts:
        return
    rows = mdr_corridor.run(experiment, lambda: _stages(experiment, "corridor"))
    if experiment.given.out:
        import mdr_pictures  # matplotlib only where a picture is asked for

        mdr_pictures.maps([row for row in rows if row.seed == rows[0].seed], experiment.folder / "mdr_maps.png")
    yield list(mdr_corridor.table(rows)), list(mdr_corridor.lines(rows))


def _room(experiment):
    parts, cases = experiment.given.parts, {}
    if "walk" in parts:
        cases.update(mdr_room.walk_case(experiment.quick))
    if "rotation" in parts:
        cases.update(mdr_room.rotation_cases())
    if not cases:
        return
    with _stages(experiment, "room") as stages:
        tallies, overlays = mdr_room.run(experiment, stages, cases)
    experiment.table("mdr_room", mdr_room.COLUMNS, mdr_room.csv_rows(tallies))
    turned = [overlay for overlay in overlays if overlay.case != "walk"]
    if experiment.given.out and turned:
        import mdr_pictures

        mdr_pictures.scans(turned, experiment.folder / "mdr_scans.png")
    yield list(mdr_room.table(tallies)), list(mdr_room.lines(tallies)) if "walk" in parts else []
