"""The laboratory mapped from raw and from deskewed scans, and how far off its ten dimensions are, as in the paper's Fig. 18."""
import matplotlib
import numpy

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

NAMES = {"raw": "without MDR", "mdr": "with MDR"}
COLOURS = {"raw": "tab:red", "mdr": "tab:green"}
X, Y = (-6.7, 6.7), (-5.2, 5.2)  # m, of the laboratory


def maps(drawn, dimensions, rows, file):
    """`drawn` {raw or mdr: map_lines.Map}. Black: occupied, grey: seen free; blue: the dimensions as they truly are."""
    figure, axes = pyplot.subplots(1, 3, figsize=(19, 5.6), width_ratios=(3, 3, 2.2))
    for axis, (kind, one) in zip(axes, drawn.items()):
        axis.plot(*one.free.T, "s", color="0.85", markersize=1.2, markeredgewidth=0)
        axis.plot(*one.occupied.T, "ks", markersize=1.0, markeredgewidth=0)
        for number, dimension in enumerate(dimensions, 1):
            ends = numpy.array([dimension["from"][:2], dimension["to"][:2]])
            axis.plot(*ends.T, "o-", color="tab:blue", linewidth=1, markersize=2)
            axis.annotate(str(number), 0.7 * ends[0] + 0.3 * ends[1], color="tab:blue", fontsize=9, xytext=(2, 2), textcoords="offset points")
        axis.set(xlim=X, ylim=Y, aspect="equal", xlabel="x [m]", ylabel="y [m]", title=NAMES[kind])
    _errors(axes[2], dimensions, rows)
    figure.tight_layout()
    figure.savefig(file, dpi=100)
    pyplot.close(figure)


def _errors(axis, dimensions, rows):
    names = [dimension["name"] for dimension in dimensions]
    for place, kind in enumerate(NAMES):
        errors = [1e3 * row.error for name in names for row in rows if (row.kind, row.name) == (kind, name)]
        axis.barh(numpy.arange(len(names)) + 0.4 * place - 0.2, errors, 0.4, color=COLOURS[kind], label=NAMES[kind])
    axis.set_yticks(range(len(names)), [f"{number} {name}" for number, name in enumerate(names, 1)])
    axis.invert_yaxis()
    axis.axvline(0.0, color="black", linewidth=0.8)
    axis.set(xlabel="measured less true [mm]")
    axis.legend(loc="lower right", fontsize=8)
