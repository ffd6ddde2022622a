"""From cloud and picture to fused obstacles, in real time, in the harbour.

A latency runs from the arrival of the later of the two, the cloud and the picture whose detections went to it, to the last
word on the cloud; of the LiDAR alone, from the cloud to its obstacles. `together`: pictures of a turn's start come when the
turn is over, with the cloud, so that the whole of the detector is in the latency; `prompt`: as they are taken, up to a
turn before, so that most of it is not. Times are those of a process outside: two hops through the middleware are in them.
"""
import os
import typing

import arrivals
import figures
import sim_bag
import sim_world
from arrivals import CLOUDS, DETECTIONS, IMAGES
from real_time import percentile, percentile_line, sent
from ros_session import SessionError
from timed_stages import OBSTACLES, TimedStages

SECONDS, QUICK_SECONDS = 20.05, 3.05
RATE = 30.0  # Hz, of the camera
SETTLED = 10  # clouds that do not count
OVERTAKEN = 0.02  # s by which two messages may come in another order than they were sent
BACKENDS = ("openvino", "opencv")


class Case(typing.NamedTuple):
    name: str
    every: int  # of how many pictures one is taken
    delay: float  # s


CASES = (Case("10hz_together", 3, arrivals.TURN), Case("30hz_together", 1, arrivals.TURN), Case("30hz_prompt", 1, 0.0))
HEADLINE = "openvino", CASES[0].name


class Row(typing.NamedTuple):
    backend: str  # "": the LiDAR alone
    case: str
    seed: int
    latencies: list  # s
    clouds: int  # that should have one


COLUMNS = ("backend", "case", "seed", "clouds", "with_picture", "latency_p50_ms", "latency_p99_ms")


def world():
    """usv_harbour with a camera that is triggered three times in a turn."""
    changes = {"lidar": {"clock_error": 0.0}, "camera": {"clock_error": 0.0, "rate": RATE}}
    return {**sim_world.with_mounts(sim_world.shipped("usv_harbour"), changes), "name": "harbour_latency"}


def alone(left, came):
    """[s] of each cloud that was answered."""
    return [came[OBSTACLES, stamp, 0] - at for stamp, at in _clouds(left) if (OBSTACLES, stamp, 0) in came]


def fused(left, came, interval):
    """[s] of each cloud with a last word that the detections of a picture not farther than `interval` [s] came before. The
    others went on without: their pictures were left out, or too late."""
    out = []
    for stamp, at in _clouds(left):
        word = came.get((OBSTACLES, stamp, 1))
        shown = [other for (topic, other, _), seen in came.items() if word and topic == DETECTIONS and seen <= word + OVERTAKEN
                 and abs((other - stamp).to_sec()) <= interval]
        if shown:
            nearest = min(shown, key=lambda other: abs((other - stamp).to_sec()))
            out.append(word - max(at, left[IMAGES, nearest]))
    return out


def _clouds(left):
    return sent(left, CLOUDS)[SETTLED:]


def run(experiment):
    """Rows of the LiDAR alone, and of each backend and case."""
    rows = []
    for seed in experiment.seeds:
        bag = experiment.bag(world(), QUICK_SECONDS if experiment.quick else SECONDS, seed, "--mounts", "lidar", "camera")
        frames = list(sim_bag.frames(bag, images=True))
        static = sim_bag.static_transforms(bag)
        rows.append(_lidar(experiment, seed, frames, static))
        for backend in BACKENDS:
            try:
                rows += _backend(experiment, seed, frames, static, backend)
            except SessionError as error:
                if backend != "openvino":
                    raise
                experiment.say(f"OpenVINO not measured: {str(error).strip().splitlines()[-1]}")
        experiment.done(bag)
    return rows


def _lidar(experiment, seed, frames, static):
    stages = TimedStages(experiment.session, experiment.folder, static, camera=False)
    run = stages.in_real_time(arrivals.clouds(frames))
    row = Row("", "lidar", seed, alone(run.left, run.came), len(_clouds(run.left)))
    stages.close()
    _tell(experiment, row)
    return row


def _backend(experiment, seed, frames, static, backend):
    stages = TimedStages(experiment.session, experiment.folder, static, {"detect": {"backend": backend}}, experiment.given.model)
    try:
        for case in CASES[:1] if experiment.quick else CASES:
            pictures = [picture for frame in frames for picture in frame.pictures][::case.every]
            run = stages.in_real_time(arrivals.ordered(arrivals.clouds(frames), arrivals.images(pictures, case.delay)))
            row = Row(backend, case.name, seed, fused(run.left, run.came, stages.match["max_interval"]), len(_clouds(run.left)))
            _tell(experiment, row)
            yield row
    finally:
        stages.close()


def _tell(experiment, row):
    experiment.say(f"latency, seed {row.seed}, {row.backend} {row.case}: {_p(row, 50):.1f} ms p50, {_p(row, 99):.1f} ms p99, load "
                   f"{os.getloadavg()[0]:.1f}")


def _p(row, share):
    return 1e3 * percentile(row.latencies, share)


def csv_rows(rows):
    return [(row.backend, row.case, row.seed, row.clouds, len(row.latencies), _p(row, 50), _p(row, 99)) for row in rows]


def pooled(rows):
    """One Row for each backend and case."""
    for backend, case in dict.fromkeys((row.backend, row.case) for row in rows):
        mine = [row for row in rows if (row.backend, row.case) == (backend, case)]
        yield Row(backend, case, 0, sum((row.latencies for row in mine), []), sum(row.clouds for row in mine))


def table(rows):
    yield f"{'latency':26} clouds  with picture     p50      p99"
    for row in pooled(rows):
        yield (f"{f'{row.backend} {row.case}'.strip():26} {row.clouds:6}  {len(row.latencies):12} {_p(row, 50):7.1f}  "
               f"{_p(row, 99):7.1f} ms")


def lines(rows):
    """The headline last, with the LiDAR's."""
    for row in pooled(rows):
        if row.backend:
            yield figures.share(f"usv/latency/with_picture/{row.backend}_{row.case}", len(row.latencies), row.clouds)
    known = {(row.backend, row.case): [1e3 * value for value in row.latencies] for row in pooled(rows)}
    for (backend, case), values in known.items():
        if backend:
            yield percentile_line(f"usv/latency/fused_p99/{backend}_{case}", values, 99, "ms")
    if HEADLINE in known:
        yield percentile_line("usv/latency/fused_p99", known[HEADLINE], 99, "ms")
    if known:
        yield percentile_line("usv/latency/lidar_p99", known["", "lidar"], 99, "ms")
