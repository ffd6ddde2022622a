"""The corridor of the quadruped paper, scanned on a walk, and the grids and lengths that its scans give."""
import typing

import corridor_length
import figures
import mdr_worlds
import poses
import slam_stage
import walk_bag

LENGTH = 30.0  # m
PAPER = {"raw": 28.73, "vicp": 29.36, "imu": 29.22, "mdr": 29.67}  # m, its Table 1
LEAD = {"vicp": 48.4, "imu": 57.7}  # % less error of mdr, likewise
COLUMNS = ["seed", "scans", "top_m", "middle_m", "bottom_m", "mean_m", "passed_on_raw"]


class Row(typing.NamedTuple):
    seed: int
    kind: str
    lengths: dict  # {strip: m}
    raw: int  # scans that were not deskewed
    map: corridor_length.Map

    @property
    def length(self):
        return corridor_length.mean_length(self.lengths)


def run(experiment, stages):
    """`stages()`: a context of DeskewStages, which end before others listen to the same transforms."""
    rows = []
    for seed in experiment.seeds:
        experiment.say(f"corridor, seed {seed}")
        rows += _seed(experiment, stages, seed)
        experiment.say("  ".join(f"{row.kind} {row.length:.3f} m" for row in rows if row.seed == seed))
        experiment.table("mdr_corridor", COLUMNS, csv_rows(rows))  # what there is, should it be interrupted
    return rows


def _seed(experiment, stages, seed):
    bags = [experiment.bag(mdr_worlds.corridor(at_once), mdr_worlds.SECONDS["corridor"], seed, *mdr_worlds.MOUNTS)
            for at_once in (False, True)]
    swept, instant = map(walk_bag.read, bags)
    with stages() as running:
        scans, raw = _deskewed(swept, running)
    scans["instant"] = [scan.message for scan in instant.scans]
    for bag in bags:
        experiment.done(bag)
    return [_row(experiment, seed, kind, of_kind, instant if kind == "instant" else swept, raw[kind])
            for kind, of_kind in scans.items()]


def _deskewed(walk, stages):
    """Scans of each kind, and how many of them were passed on raw."""
    scans = {kind: [] for kind in ("raw", *stages.methods)}
    raw = dict.fromkeys((*scans, "instant"), 0)
    for scan, answer in zip(walk.scans, stages.play(walk)):
        scans["raw"].append(scan.message)
        for kind, deskewed in answer.items():
            scans[kind].append(deskewed.scan)
            raw[kind] += not deskewed.done
    return scans, raw


def _row(experiment, seed, kind, scans, walk, raw):
    fed = ((poses.flat(walk.odometry.at(scan.header.stamp.to_sec())), scan) for scan in scans)
    grid = slam_stage.run_pairs(experiment, fed, walk.static, seed).grid
    begin = walk.truth.at(walk.scans[0].begin)[:2, 3]  # there the map has its origin
    drawn = corridor_length.Map(grid, begin)
    return Row(seed, kind, drawn.lengths(), raw, drawn)


def csv_rows(rows):
    return [[row.seed, row.kind, *(f"{row.lengths[strip]:.4f}" for strip in corridor_length.STRIPS), f"{row.length:.4f}", row.raw]
            for row in rows]


def table(rows):
    yield "corridor of 30 m   length  its error    worst   top / middle / bottom, seed 1   paper   its error"
    for kind in dict.fromkeys(row.kind for row in rows):
        mine = [row for row in rows if row.kind == kind]
        length, off = (sum(values) / len(mine) for values in ([row.length for row in mine], errors(mine)))
        strips = " / ".join(f"{mine[0].lengths[strip]:.3f}" for strip in corridor_length.STRIPS)
        paper = f"{PAPER[kind]:5.2f} m   {LENGTH - PAPER[kind]:5.2f} m" if kind in PAPER else "-"
        yield f"{kind:14} {length:8.3f} m   {off:6.3f} m {max(errors(mine)):6.3f} m   {strips:27} m   {paper}"
    for rival, lead in LEAD.items():
        if any(row.kind == rival for row in rows):
            less = 100 * (1 - mean_error(rows, "mdr") / mean_error(rows, rival))
            yield f"mdr errs by {less:.1f} % less than {rival} (paper: {lead} %)"


def errors(rows):
    return [abs(row.length - LENGTH) for row in rows]


def mean_error(rows, kind):
    off = errors([row for row in rows if row.kind == kind])
    return sum(off) / len(off)


def lines(rows):
    of = {kind: [row for row in rows if row.kind == kind] for kind in (*PAPER, "instant")}
    for kind in PAPER:
        if of[kind]:
            yield figures.mean(f"quadruped/corridor/{kind}_error", errors(of[kind]), "m")
    apart = [abs(mdr.length - instant.length) for mdr, instant in zip(of["mdr"], of["instant"])]
    yield figures.mean("quadruped/corridor/mdr_to_instant", apart, "m")
