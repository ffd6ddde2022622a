"""Allan variance of a rate's samples, and the noises that explain it (IEEE Std 952-1997, annex C)."""
import dataclasses
import math

import numpy
from scipy.optimize import nnls

PER_DECADE = 12
LONGEST = 1 / 9  # of the recording: beyond, too few intervals are left to tell a variance
FLICKER = 2 * math.log(2) / math.pi


@dataclasses.dataclass(frozen=True)
class Noises:
    """Unit: that of the samples, times: `density` sqrt(s) = 1/sqrt(Hz), `instability` 1, `walk` 1/sqrt(s). None:
    too small to be seen in this recording."""
    density: float
    instability: float
    walk: float


def variances(samples, interval):
    """(averaging times [s], overlapping Allan variances, number of independent differences in each)."""
    count = len(samples)
    longest = int(count * LONGEST)
    if longest < 2:
        raise ValueError(f"{count} samples are too few for an Allan variance")
    steps = numpy.unique(numpy.geomspace(1, longest, int(PER_DECADE * math.log10(longest)) + 2).astype(int))
    angle = numpy.concatenate([[0.0], numpy.cumsum(samples - numpy.mean(samples))]) * interval
    times = steps * interval
    found = [numpy.mean((angle[2 * m:] - 2 * angle[m:-m] + angle[:-2 * m]) ** 2) for m in steps]
    return times, numpy.array(found) / (2 * times**2), count / steps - 1


def noises(times, allan, freedom):
    """White noise falls as 1/t, flicker stays, a random walk rises as t/3: the share of each, none below 0, each variance
    weighted by how well it is known."""
    columns = numpy.stack([1 / times, numpy.full_like(times, FLICKER), times / 3], 1)
    deviation = allan * numpy.sqrt(2 / freedom)
    shares, _ = nnls(columns / deviation[:, None], allan / deviation)
    inverse = numpy.linalg.pinv((columns / deviation[:, None]).T @ (columns / deviation[:, None]))
    seen = shares > 2 * numpy.sqrt(numpy.diag(inverse))
    return Noises(*(math.sqrt(share) if known else None for share, known in zip(shares, seen)))
