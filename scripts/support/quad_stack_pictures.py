"""Typical obstacles in four representations, and heaps and frames on three maps, as in the paper's Figs. 10, 12 and 13."""
import matplotlib
import numpy

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import poses  # noqa: E402

AROUND = 0.5  # m about the middle of a body that stands alone
STACK = (1.0, 5.6), (-2.8, 3.5)  # m, x and y in the world
OUTLINE, SEEN = "tab:orange", "red"


def alone(drawn, truth, bodies, titles, file):
    """A row for each body, a column for each of `titles` {form: title}. Red: the true outline that some sensor could see, orange: the rest."""
    figure, axes = pyplot.subplots(len(bodies), len(titles), figsize=(3 * len(titles), 3 * len(bodies)))
    for body, row in zip(bodies, axes):
        middle = body.T_world_box[:2, 3]
        for axis, (form, title) in zip(row, titles.items()):
            _draw(axis, drawn[form], truth)
            axis.set(xlim=(middle[0] - AROUND, middle[0] + AROUND), ylim=(middle[1] - AROUND, middle[1] + AROUND), xticks=[], yticks=[])
            if body is bodies[0]:
                axis.set_title(title)
        row[0].set_ylabel(body.name)
    _save(figure, file)


def stack(drawn, truth, titles, file):
    """A column for each of `titles`."""
    figure, axes = pyplot.subplots(1, len(titles), figsize=(5 * len(titles), 7))
    for axis, (form, title) in zip(axes, titles.items()):
        _draw(axis, drawn[form], truth)
        axis.set(xlim=STACK[0], ylim=STACK[1], title=title, xlabel="x [m]")
    axes[0].set_ylabel("y [m]      black: occupied; red: true outline that could be seen; orange: the rest")
    _save(figure, file)


def _draw(axis, one, truth):
    points = poses.apply_flat(one.T_world_own, one.points)
    axis.set_aspect("equal")
    if one.is_cloud:
        axis.plot(*points.T, "k,")
    else:
        for x, y in points:
            axis.add_patch(pyplot.Rectangle((x - one.cell / 2, y - one.cell / 2), one.cell, one.cell, color="0.2", linewidth=0))
    axis.plot(*truth.outline.T, ".", color=OUTLINE, markersize=1)
    axis.plot(*truth.seen.T, ".", color=SEEN, markersize=1)


def _save(figure, file):
    figure.tight_layout()
    figure.savefig(file, dpi=90)
    pyplot.close(figure)
