"""A boat that crosses ahead of the vessel at 3 m/s, with a camera whose pictures are late, stamped late, lost, or free of the
LiDAR's turns.

Scores come from runs in the order of arrival, in which each cloud waits for what belongs to it, so that they do not depend
on the machine; latencies and offsets from runs in real time. The truth stands in for the detector and takes no time: what
is measured is how clouds and detections are brought together. The boat's place is scored at the stamp of its cloud. The
LiDAR sees what lies ahead half a turn after that, 0.15 m farther on; `when_seen` is the error against that instant.
"""
import math
import statistics
import typing

import numpy

import arrivals
import crossing
import figures
import sim_bag
import sim_world
from arrivals import Camera
from real_time import percentile, percentile_line, sent
from stage_run import PATIENCE
from timed_stages import CLOUDS, OBSTACLES, TimedStages

SECONDS, QUICK_SECONDS = 9.05, 5.05
RATES = {"trigger": 30.0, "free": 29.7}  # Hz: each third picture at a cloud's stamp; phases that drift
SETTLED = 1.0  # s that the stages get to know of each other before anything counts
LATE, MUCH = 0.05, 0.12  # s
OFFSETS = "camera: offset to clusters [ms]"  # in /diagnostics


class Case(typing.NamedTuple):
    clock: str  # of RATES
    name: str
    camera: Camera
    time_offset: float = 0.0  # s, the parameter of the stage `match`


CASES = tuple(Case(clock, *case) for clock in RATES for case in (
    ("on_time", Camera()),
    ("late_50ms", Camera(LATE)),
    ("late_120ms", Camera(MUCH)),
    ("stamped_50ms_late", Camera(LATE, stamped_late=True)),
    ("stamped_120ms_late", Camera(MUCH, stamped_late=True)),
    ("stamped_120ms_late_corrected", Camera(MUCH, stamped_late=True), -MUCH),
    ("lost_5_percent", Camera(lost=0.05))))
QUICK = tuple(case for case in CASES if case.clock == "free" and case.name in ("on_time", "stamped_120ms_late"))


class Row(typing.NamedTuple):
    """Of one case and seed, of clouds unless said otherwise."""
    case: Case
    seed: int
    matched: list  # whether both sensors are said to see the boat
    errors: list  # m, horizontal, where it was found
    when_seen: list  # m, the same against where it was when the beams met it
    behind: list  # s, where matched: by how much the camera's bearing is older than the LiDAR's, by the boat's true speed
    latencies: list  # s, from the cloud to the last word on it, in real time
    offsets: dict  # {(low, high) [ms]: count} of the nearest picture to each cloud, as /diagnostics tells


COLUMNS = ("clock", "case", "seed", "clouds", "matched", "position_error_m", "when_seen_error_m", "camera_behind_ms",
           "latency_p50_ms", "latency_p99_ms", "offset_p5_ms", "offset_median_ms", "offset_p95_ms")


def world(clock, seed):
    """The vessel and waves of usv_harbour, and one boat; it comes from the left and from the right in turn."""
    exact = {"clock_error": 0.0} if clock == "trigger" else {}
    changes = {"lidar": exact, "camera": {"rate": RATES[clock], **exact}}
    side = 1 if seed % 2 else -1
    boat = {"name": "crosser", "label": "boat", "shape": "boat", "floats": True,
            "motion": {"points": [[12, side * 14], [12, -side * 25]], "speed": crossing.SPEED, "acceleration": 3.0}}
    return sim_world.at_anchor(sim_world.with_mounts(sim_world.shipped("usv_harbour"), changes), f"crossing_{clock}", [boat])


def histogram(text):
    """{(low, high): count} as /diagnostics writes it: `-5..0: 12, 0..5: 3, above 250: 1`."""
    out = {}
    for part in filter(None, text.split(", ")):
        edges, count = part.split(": ")
        side, _, edge = edges.partition(" ")
        low, high = (edges.split("..") if not edge else (-math.inf, edge) if side == "below" else (edge, math.inf))
        out[float(low), float(high)] = int(count)
    return out


def quantile(counts, share):
    """Middle of the bin in which that share of a histogram ends; NaN of an empty one."""
    left = share * sum(counts.values())
    for (low, high), count in sorted(counts.items()):
        left -= count
        if left <= 0:
            return (low + high) / 2
    return math.nan


def scored(case, seed, moments, obstacles):
    """A Row without what is measured in real time, of {stamp: ObstacleArray}."""
    row = Row(case, seed, [], [], [], [], [], {})
    for moment in moments:
        boat = moment.found(obstacles[moment.stamp].obstacles)
        both = boat is not None and boat.source == boat.SOURCE_BOTH
        row.matched.append(both)
        if both:
            row.behind.append(boat.azimuth_difference / moment.azimuth_rate())
        if boat:
            off = numpy.array([boat.position.x, boat.position.y]) - moment.middle
            row.errors.append(float(numpy.linalg.norm(off)))
            row.when_seen.append(float(numpy.linalg.norm(off - moment.seen_after * moment.velocity)))
    return row


def latencies(left, came, settled):
    """[s] Of the clouds after the first `settled` ones, from the cloud to the last word on it; of none that got no answer."""
    words = [(at, [came[OBSTACLES, stamp, revision] for revision in (0, 1) if (OBSTACLES, stamp, revision) in came])
             for stamp, at in sent(left, CLOUDS)[settled:]]
    return [max(answers) - at for at, answers in words if answers]


def measured(stages, case, seed, frames):
    pictures = [picture for frame in frames for picture in frame.pictures]
    events = arrivals.ordered(arrivals.clouds(frames), arrivals.detections(pictures, case.camera, stages.detect, seed))
    stages.set_match(partner_timeout=PATIENCE, time_offset=case.time_offset)
    words = stages.in_order(events, case.time_offset)
    # not those that wait at the end of the bag for what would come after it
    row = scored(case, seed, [moment for moment in crossing.moments(frames, SETTLED) if moment.stamp in words], words)
    stages.set_match(time_offset=case.time_offset)
    run = stages.in_real_time(events)
    return row._replace(latencies=latencies(run.left, run.came, round(SETTLED / arrivals.TURN)),
                        offsets=histogram(stages.diagnosed("match").get(OFFSETS, "")))


def run(experiment):
    """A Row for each case and seed."""
    rows, stages = [], None
    for seed in experiment.seeds:
        for clock in dict.fromkeys(case.clock for case in chosen(experiment)):
            bag = experiment.bag(world(clock, seed), QUICK_SECONDS if experiment.quick else SECONDS, seed,
                                 "--mounts", "lidar", "camera")
            frames = list(sim_bag.frames(bag, images=False))
            stages = stages or TimedStages(experiment.session, experiment.folder, sim_bag.static_transforms(bag))
            rows += [measured(stages, case, seed, frames) for case in chosen(experiment) if case.clock == clock]
            experiment.done(bag)
            experiment.say(f"crossing, {clock}, seed {seed}: {len(rows)} runs")
    stages.close()
    return rows


def chosen(experiment):
    return QUICK if experiment.quick else CASES


def mean(values):
    return statistics.fmean(values) if values else math.nan


def numbers(row):
    """What COLUMNS tells from `matched` on."""
    behind = statistics.median(row.behind) if row.behind else math.nan
    return (mean(row.matched), mean(row.errors), mean(row.when_seen), 1e3 * behind,
            1e3 * percentile(row.latencies, 50), 1e3 * percentile(row.latencies, 99), *(quantile(row.offsets, share) for share in (0.05, 0.5, 0.95)))


def csv_rows(rows):
    return [(row.case.clock, row.case.name, row.seed, len(row.matched), *numbers(row)) for row in rows]


def pooled(rows):
    """One Row for each case, of all seeds."""
    for case in dict.fromkeys(row.case for row in rows):
        mine = [row for row in rows if row.case == case]
        counts = {}
        for row in mine:
            for edges, count in row.offsets.items():
                counts[edges] = counts.get(edges, 0) + count
        yield Row(case, 0, *(sum((getattr(row, name) for row in mine), []) for name in Row._fields[2:-1]), counts)


def table(rows):
    yield f"{'boat at 3 m/s':36} matched   error of place   camera    latency          offset by /diagnostics"
    yield f"{'':36}           (when seen)     behind    p50    p99       5 %  median   95 %"
    for row in pooled(rows):
        yield ("{:36} {:6.3f}   {:.2f} m ({:.2f} m) {:5.0f} ms {:5.0f} {:6.0f} ms {:8.1f} {:7.1f} {:6.1f} ms".format(
            f"{row.case.clock}, {row.case.name.replace('_', ' ')}", *numbers(row)))


def lines(rows):
    for row in pooled(rows):
        name = f"usv/timing/{row.case.clock}/{row.case.name}"
        yield figures.share(f"{name}/matched", sum(row.matched), len(row.matched))
        yield figures.mean(f"{name}/position_error", row.errors, "m")
        yield figures.mean(f"{name}/position_error_when_seen", row.when_seen, "m")
        for share in (50, 99):
            yield percentile_line(f"{name}/latency_p{share}", [1e3 * value for value in row.latencies], share, "ms")
