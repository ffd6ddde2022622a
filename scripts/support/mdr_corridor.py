"""The corridor of the quadruped paper, scanned on a walk, and the grids and lengths that its scans give."""
import typing

import corridor_map
import corridor_match
import dead_reckoning
import figures
import mdr_worlds
import walk_bag

LENGTH = 30.0  # m
EACH = 3  # so many scans are deskewed for one that enters the map: 0.2 m of the way
PAPER = {"raw": 28.73, "vicp": 29.36, "imu": 29.22, "mdr": 29.67}  # m, its Table 1
LEAD = {"vicp": 48.4, "imu": 57.7}  # % less error of mdr, likewise
COLUMNS = ["seed", "scans", "top_m", "middle_m", "bottom_m", "mean_m", "mean_by_odometry_alone_m", "passed_on_raw"]


class Row(typing.NamedTuple):
    seed: int
    kind: str
    lengths: dict  # {strip: m}
    alone: float  # m, of the map in which scans lie where odometry says
    raw: int  # scans that were not deskewed
    grid: corridor_map.Grid

    @property
    def length(self):
        return corridor_map.mean_length(self.lengths)


def run(experiment, stages):
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
    kinds = ["raw", *stages.methods, "instant"]
    maps, raw = {kind: (corridor_match.MatchedGrid(), corridor_map.Grid()) for kind in kinds}, dict.fromkeys(kinds, 0)
    for i, (scan, place, answer) in enumerate(zip(swept.scans, dead_reckoning.places(swept), stages.play(swept))):
        clouds = {"raw": walk_bag.returns(scan.message)[1], **{kind: deskewed.points for kind, deskewed in answer.items()}}
        for kind, deskewed in answer.items():
            raw[kind] += not deskewed.done
        for kind, points in clouds.items() if i % EACH == 0 else ():
            _add(maps[kind], place, points)
    for scan, place in list(zip(instant.scans, dead_reckoning.places(instant)))[::EACH]:
        _add(maps["instant"], place, walk_bag.returns(scan.message)[1])
    for bag in bags:
        experiment.done(bag)
    return [Row(seed, kind, matched.grid.length(), corridor_map.mean_length(alone.length()), raw[kind], matched.grid)
            for kind, (matched, alone) in maps.items()]


def _add(maps, place, points):
    for grid in maps:
        grid.add(*corridor_map.level(place, points))


def csv_rows(rows):
    return [[row.seed, row.kind, *(f"{row.lengths[strip]:.4f}" for strip in corridor_map.STRIPS), f"{row.length:.4f}",
             f"{row.alone:.4f}", row.raw] for row in rows]


def table(rows):
    yield "corridor of 30 m   length  its error    worst   top / middle / bottom, seed 1   by odometry alone   paper   its error"
    for kind in dict.fromkeys(row.kind for row in rows):
        mine = [row for row in rows if row.kind == kind]
        length, off, alone = (sum(values) / len(mine) for values in ([row.length for row in mine], errors(mine), alone_errors(mine)))
        strips = " / ".join(f"{mine[0].lengths[strip]:.3f}" for strip in corridor_map.STRIPS)
        paper = f"{PAPER[kind]:5.2f} m   {LENGTH - PAPER[kind]:5.2f} m" if kind in PAPER else "-"
        yield f"{kind:14} {length:8.3f} m   {off:6.3f} m {max(errors(mine)):6.3f} m   {strips:27} m   {alone:15.3f} m   {paper}"
    for rival, lead in LEAD.items():
        if any(row.kind == rival for row in rows):
            less = 100 * (1 - mean_error(rows, "mdr") / mean_error(rows, rival))
            yield f"mdr errs by {less:.1f} % less than {rival} (paper: {lead} %)"


def errors(rows):
    return [abs(row.length - LENGTH) for row in rows]


def alone_errors(rows):
    return [abs(row.alone - LENGTH) for row in rows]


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
    yield figures.mean("quadruped/corridor/mdr_error/odometry_alone", alone_errors(of["mdr"]), "m")
