"""The corridor of the quadruped paper, scanned on a walk, and the grids and lengths that its scans give."""
import typing

import corridor_map
import dead_reckoning
import figures
import mdr_worlds
import walk_bag

LENGTH = 30.0  # m
EACH = 3  # so many scans are deskewed for one that enters the map: 0.2 m of the way
PAPER = {"raw": 28.73, "vicp": 29.36, "imu": 29.22, "mdr": 29.67}  # m, its Table 1
LEAD = {"vicp": 48.4, "imu": 57.7}  # % less error of mdr, likewise
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
    kinds = ["raw", *stages.methods, "instant"]
    grids, raw = {kind: corridor_map.Grid() for kind in kinds}, dict.fromkeys(kinds, 0)
    for i, (scan, place, answer) in enumerate(zip(swept.scans, dead_reckoning.places(swept), stages.play(swept))):
        clouds = {"raw": walk_bag.returns(scan.message)[1], **{kind: deskewed.points for kind, deskewed in answer.items()}}
        for kind, deskewed in answer.items():
            raw[kind] += not deskewed.done
        for kind, points in clouds.items() if i % EACH == 0 else ():
            grids[kind].add(*corridor_map.level(place, points))
    for scan, place in list(zip(instant.scans, dead_reckoning.places(instant)))[::EACH]:
        grids["instant"].add(*corridor_map.level(place, walk_bag.returns(scan.message)[1]))
    for bag in bags:
        experiment.done(bag)
    return [Row(seed, kind, grid.length(), raw[kind], grid) for kind, grid in grids.items()]


def csv_rows(rows):
    return [[row.seed, row.kind, *(f"{row.lengths[strip]:.4f}" for strip in corridor_map.STRIPS), f"{row.length:.4f}", row.raw]
            for row in rows]


def table(rows):
    yield "corridor of 30 m   ours: mean   error: mean   worst   top / middle / bottom, first seed   paper   its error"
    for kind in dict.fromkeys(row.kind for row in rows):
        mine = [row for row in rows if row.kind == kind]
        off = errors(mine)
        told = " / ".join(f"{mine[0].lengths[strip]:.3f}" for strip in corridor_map.STRIPS)
        paper = f"{PAPER[kind]:7.2f} m  {LENGTH - PAPER[kind]:6.2f} m" if kind in PAPER else "      -         -"
        yield (f"{kind:17}  {sum(row.length for row in mine) / len(mine):8.3f} m  {sum(off) / len(off):9.3f} m  {max(off):6.3f} m"
               f"   {told:24} m  {paper}")
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
