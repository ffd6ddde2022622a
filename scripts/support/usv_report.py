"""Tables, plot and figures of the cages at known places."""
import statistics

import figures
import usv_positions

COLUMNS = ("place", "seed", "clouds", "found", "true_face_m", "true_centre_m", "true_azimuth_deg", "face_error_m", "centre_error_m",
           "angle_error_deg", "paper_method_distance_error_m", "paper_method_angle_error_deg", "single_face_mae_m",
           "single_centre_mae_m", "single_angle_mae_deg")
UNITS = {"face": "m", "centre": "m", "angle": "deg", "paper_distance": "m", "paper_angle": "deg"}


def csv_rows(rows):
    return [(*row[:7], *row.errors, *row.single[:3]) for row in rows]


def errors(rows, name, single=False):
    return [abs(getattr(row.single if single else row.errors, name)) for row in rows]


def table(rows):
    """The paper's Table I beside ours, errors as means over the seeds."""
    yield "Table I          paper (001)             the paper's method here      ours, error of"
    yield "place    distance   errors of             distance   errors of         face   centre    angle"
    for place, distance, angle, distance_error, angle_error in usv_positions.PAPER:
        mine = [row for row in rows if row.place == place]
        if not mine:
            continue
        mean = {name: statistics.fmean(errors(mine, name)) for name in UNITS}
        there = statistics.fmean(row.face + row.errors.paper_distance for row in mine)
        yield (f"{place:6} {distance:6.2f} m {distance_error:6.2f} m {angle_error:5.2f} deg   {there:6.2f} m "
               f"{mean['paper_distance']:6.2f} m {mean['paper_angle']:5.2f} deg   {mean['face']:6.3f} m {mean['centre']:5.3f} m "
               f"{mean['angle']:5.2f} deg")


def far_table(rows):
    yield "true face   found in       ours, error of            single clouds"
    yield "                          face   centre    angle      face   centre    angle"
    for row in rows:
        yield (f"{row.face:6.2f} m  {row.found:3} of {row.frames:3}  {row.errors.face:+6.3f} m {row.errors.centre:+6.3f} m "
               f"{row.errors.angle:+5.2f} deg  {row.single.face:6.3f} m {row.single.centre:6.3f} m {row.single.angle:5.2f} deg")


def lines(part, rows):
    """The figures. What was not found at all leaves its figure NaN."""
    yield figures.share(f"usv/{part.name}/found", sum(row.found for row in rows), sum(row.frames for row in rows))
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
        for name, mark in (("face", "o"), ("centre", "s"), ("angle", "o")):
            axes[int(name == "angle")].plot([row.face for row in rows], errors(rows, name), mark, markersize=4, alpha=0.7,
                                       label=f"{part.name}: {name}")
        if part is usv_positions.TABLE:
            axes[0].plot([row.face for row in rows], errors(rows, "paper_distance"), "x", label="table1: the paper's method")
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
