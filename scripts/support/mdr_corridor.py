"""The corridor of the quadruped paper, scanned on a walk, and the grids and lengths that its scans give."""
import typing

import corridor_map
import dead_reckoning
import figures
import mdr_worlds
import walk_bag

LENGTH = 30.0  # m
QUICK_SECONDS = 46.0  # up to the far end
PAPER = {"raw": 28.73, "vicp": 29.36, "imu": 29.22, "mdr": 29.67}  # m, its Table 1
KINDS = (*PAPER, "instant")  # of scans: as they came, deskewed by three methods, and those that no motion bent
COLUMNS = ["seed", "scans", "top_m", "middle_m", "bottom_m", "mean_m", "passed_on_raw"]


class Row(typing.NamedTuple):
    seed: int
    kind: str
    lengths: dict  # {strip: m}
    raw: int  # scans that were not deskewed
    grid: corridor_map.Grid

    @property
    def length(self):
        return corridor_map.mean_length(self.lengths)


def run(experiment, stages):
    return [row for seed in experiment.seeds for row in _seed(experiment, stages, seed)]


def _seed(experiment, stages, seed):
    experiment.say(f"corridor, seed {seed}")
    bags = [experiment.bag(mdr_worlds.corridor(at_once), mdr_worlds.SECONDS["corridor"], seed, *mdr_worlds.MOUNTS)
            for at_once in (False, True)]
    swept, instant = map(walk_bag.read, bags)
    grids, raw = {kind: corridor_map.Grid() for kind in KINDS}, dict.fromkeys(KINDS, 0)
    for scan, place, answer in zip(swept.scans, dead_reckoning.places(swept), stages.play(swept)):
        grids["raw"].add(*corridor_map.level(place, walk_bag.returns(scan.message)[1]))
        for kind, deskewed in answer.items():
            grids[kind].add(*corridor_map.level(place, deskewed.points))
            raw[kind] += not deskewed.done
    for scan, place in zip(instant.scans, dead_reckoning.places(instant)):
        grids["instant"].add(*corridor_map.level(place, walk_bag.returns(scan.message)[1]))
    for bag in bags:
        experiment.done(bag)
    return [Row(seed, kind, grid.length(), raw[kind], grid) for kind, grid in grids.items()]


def csv_rows(rows):
    return [[row.seed, row.kind, *(f"{row.lengths[strip]:.4f}" for strip in corridor_map.STRIPS), f"{row.length:.4f}", row.raw]
            for row in rows]


def table(rows):
    yield "corridor of 30 m   ours: mean   error: mean   worst   top / middle / bottom, first seed   paper   its error"
    for kind in KINDS:
        mine = [row for row in rows if row.kind == kind]
        off = errors(mine)
        told = " / ".join(f"{mine[0].lengths[strip]:.3f}" for strip in corridor_map.STRIPS)
        paper = f"{PAPER[kind]:7.2f} m  {LENGTH - PAPER[kind]:6.2f} m" if kind in PAPER else "      -         -"
        yield (f"{kind:17}  {sum(row.length for row in mine) / len(mine):8.3f} m  {sum(off) / len(off):9.3f} m  {max(off):6.3f} m"
               f"   {told:24} m  {paper}")
    for rival in ("vicp", "imu"):
        yield f"mdr errs by {100 * (1 - mean_error(rows, 'mdr') / mean_error(rows, rival)):.1f} % less than {rival} (paper: {LEAD[rival]} %)"


LEAD = {"vicp": 48.4, "imu": 57.7}  # %, of its Table 1


def errors(rows):
    return [abs(row.length - LENGTH) for row in rows]


def mean_error(rows, kind):
    off = errors([row for row in rows if row.kind == kind])
    return sum(off) / len(off)


def lines(rows):
    of = {kind: [row for row in rows if row.kind == kind] for kind in KINDS}
    for kind in PAPER:
        yield figures.mean(f"quadruped/corridor/{kind}_error", errors(of[kind]), "m")
    apart = [abs(mdr.length - instant.length) for mdr, instant in zip(of["mdr"], of["instant"])]
    yield figures.mean("quadruped/corridor/mdr_to_instant", apart, "m")
