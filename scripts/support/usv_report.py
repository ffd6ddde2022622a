"""Tables, plot and figures of the cages at known places."""
import math
import statistics

import figures
import usv_positions

COLUMNS = ("place", "seed", "clouds", "found", "paper_method_found", "true_face_m", "true_centre_m", "true_azimuth_deg", "face_error_m", "centre_error_m",
           "angle_error_deg", "paper_method_distance_error_m", "paper_method_angle_error_deg", "single_face_mae_m",
           "single_centre_mae_m", "single_angle_mae_deg")
UNITS = {"face": "m", "centre": "m", "angle": "deg", "paper_distance": "m", "paper_angle": "deg"}


def csv_rows(rows):
    return [(*row[:8], *row.errors, *row.single[:3]) for row in rows]


def errors(rows, name, single=False):
    """Of the places where it was found."""
    return [abs(error) for row in rows if not math.isnan(error := getattr(row.single if single else row.errors, name))]


def mean_error(rows, name, decimals, unit):
    found = errors(rows, name)
    return f"{statistics.fmean(found):.{decimals}f} {unit}" if found else "-"


def share(rows, method="found"):
    return f"{sum(getattr(row, method) for row in rows)} of {sum(row.frames for row in rows)}"


def table(rows):
    """The paper's Table I beside ours, errors as means over the seeds in which the cage was found."""
    yield f"{'Table I':8}{'paper (001): errors of':>32}   {'its method here: errors of':>43}   {'ours: errors of':>41}"
    yield (f"{'place':8}{'distance':>10} {'distance':>10} {'angle':>10}   {'found in':>12} {'distance':>9} {'distance':>9} {'angle':>10}   "
           f"{'found in':>12} {'face':>8} {'centre':>8} {'angle':>10}")
    for place, distance, angle, distance_error, angle_error in usv_positions.PAPER:
        mine = [row for row in rows if row.place == place]
        if not mine:
            continue
        there = [row.face + row.errors.paper_distance for row in mine if row.paper_found]
        told = f"{statistics.fmean(there):.2f} m" if there else "-"
        yield (f"{place:8}{distance:8.2f} m {distance_error:8.2f} m {angle_error:6.2f} deg   {share(mine, 'paper_found'):>12} {told:>9} "
               f"{mean_error(mine, 'paper_distance', 2, 'm'):>9} {mean_error(mine, 'paper_angle', 2, 'deg'):>10}   "
               f"{share(mine):>12} {mean_error(mine, 'face', 3, 'm'):>8} {mean_error(mine, 'centre', 3, 'm'):>8} "
               f"{mean_error(mine, 'angle', 2, 'deg'):>10}")
    yield "The paper's distance, and its error, is to the nearest of the cage by the middle of its box; angles are to the cage's middle."


def far_table(rows):
    yield "true face   found in       ours, error of            single clouds"
    yield "                          face   centre    angle      face   centre    angle"
    for row in rows:
        if not row.found:
            yield f"{row.face:6.2f} m  {row.found:3} of {row.frames:3}"
            continue
        yield (f"{row.face:6.2f} m  {row.found:3} of {row.frames:3}  {row.errors.face:+6.3f} m {row.errors.centre:+6.3f} m "
               f"{row.errors.angle:+5.2f} deg  {row.single.face:6.3f} m {row.single.centre:6.3f} m {row.single.angle:5.2f} deg")


def lines(part, rows):
    """The figures; errors are means over those of the places where it was found, which the first two tell."""
    missed = [f"{row.place} seed {row.seed}" for row in rows if not row.found]
    if missed:
        yield f"FOUND IN NO CLOUD, and so in no error below: {', '.join(missed)}"
    yield figures.share(f"usv/{part.name}/found", sum(row.found for row in rows), sum(row.frames for row in rows))
    yield figures.share(f"usv/{part.name}/places_found", len(rows) - len(missed), len(rows))
    for name in ("face", "centre", "angle"):
        yield figures.mean(f"usv/{part.name}/single_{name}_mae", errors(rows, name, single=True), UNITS[name])
    for name in ("face", "centre", "angle"):
        yield figures.mean(f"usv/{part.name}/{name}_mae", errors(rows, name), UNITS[name])
    if part is usv_positions.TABLE:
        for name in ("angle", "distance"):
            yield figures.mean(f"usv/table1/paper_{name}_mae/paper_method", errors(rows, f"paper_{name}"), UNITS[f"paper_{name}"])


def plot(parts, file):
    """Errors against distance, of [(Part, rows)]."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(11, 4.5))
    for part, rows in parts:
        found, papers = ([row for row in rows if getattr(row, method)] for method in ("found", "paper_found"))
        for name, mark in (("face", "o"), ("centre", "s"), ("angle", "o")):
            axes[int(name == "angle")].plot([row.face for row in found], errors(found, name), mark, markersize=4, alpha=0.7,
                                       label=f"{part.name}: {name}")
        if part is usv_positions.TABLE:
            axes[0].plot([row.face for row in papers], errors(papers, "paper_distance"), "x", label="table1: the paper's method")
            places = {name: int(name[-4:-2]) for name, *_ in usv_positions.PAPER}  # m
            axes[0].plot([places[p[0]] for p in usv_positions.PAPER], [p[3] for p in usv_positions.PAPER], "k+", label="the paper")
            axes[1].plot([places[p[0]] for p in usv_positions.PAPER], [p[4] for p in usv_positions.PAPER], "k+", label="the paper")
    for axis, unit in zip(axes, ("m", "deg")):
        axis.set(xlabel="range of the near face [m]", ylabel=f"error [{unit}]", yscale="log")
        axis.legend(fontsize=7)
        axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(file, dpi=110)
    pyplot.close(figure)
