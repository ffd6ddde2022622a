"""The lines that scripts read: `figure NAME VALUE UNIT n=.. ci=[..,..]`, with 95 % intervals."""
import math
import random
import statistics


def line(name, value, unit, n, interval):
    low, high = interval
    return f"figure {name} {value:.4g} {unit} n={n} ci=[{low:.4g},{high:.4g}]"


def wilson(hits, n):
    """Interval of a share `hits` / `n` (Wilson 1927)."""
    if n == 0:
        return math.nan, math.nan
    z = 1.96
    share = hits / n
    middle = (share + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(share * (1 - share) / n + z * z / (4 * n * n))
    return max(0.0, middle - half), min(1.0, middle + half)


def bootstrap(values, statistic, resamples=2000):
    """Percentile interval of a statistic (Efron 1979); the same for the same values. One value has none."""
    if len(values) < 2:
        return math.nan, math.nan
    draw = random.Random(1)
    results = sorted(statistic(draw.choices(values, k=len(values))) for _ in range(resamples))
    return results[resamples // 40], results[resamples - 1 - resamples // 40]


def share(name, hits, n):
    return line(name, hits / n if n else math.nan, "-", n, wilson(hits, n))


def median(name, values, unit):
    """NaN of no values."""
    value = statistics.median(values) if values else math.nan
    return line(name, value, unit, len(values), bootstrap(values, statistics.median, 400))


def mean(name, values, unit):
    """NaN when one of the values is, and of no values."""
    if not values or any(map(math.isnan, values)):
        return line(name, math.nan, unit, len(values), (math.nan, math.nan))
    return line(name, statistics.fmean(values), unit, len(values), bootstrap(values, statistics.fmean))


def worst(name, values, unit):
    """NaN when one of the values is: what was not measured must not flatter the figure."""
    if not values or any(map(math.isnan, values)):
        return line(name, math.nan, unit, len(values), (math.nan, math.nan))
    return line(name, max(values), unit, len(values), bootstrap(values, max))
