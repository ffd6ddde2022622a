"""Maps of the quadruped side by side, as in the paper's Figs. 13 and 16."""
import matplotlib
import numpy

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import grids  # noqa: E402

MARGIN = 0.3  # m


def maps(of_names, titles, file, missed=None):
    """Of `of_names`, {name: OccupancyGrid}. White: free; black: occupied; grey: unknown.

    Red: `missed`, {name: n x 2 places in the map [m]}.
    """
    figure, axes = plt.subplots(len(of_names), 1, figsize=(8, 3.4 * len(of_names)), squeeze=False)
    for axis, (name, grid) in zip(axes[:, 0], of_names.items()):
        info = grid.info
        cells = grids.cells(grid)
        shades = numpy.where(cells < 0, 0.7, 1.0 - cells / 100.0)
        x, y, side = info.origin.position.x, info.origin.position.y, info.resolution
        axis.imshow(shades, cmap="gray", vmin=0.0, vmax=1.0, origin="lower",
                    extent=(x, x + info.width * side, y, y + info.height * side), interpolation="nearest")
        rows, columns = numpy.nonzero(cells >= 0)
        if len(rows):
            axis.set_xlim(x + columns.min() * side - MARGIN, x + (columns.max() + 1) * side + MARGIN)
            axis.set_ylim(y + rows.min() * side - MARGIN, y + (rows.max() + 1) * side + MARGIN)
        if missed is not None:
            axis.plot(*missed[name].T, "r.", markersize=2)
        axis.set_title(titles[name])
        axis.set_xlabel("x [m]")
        axis.set_ylabel("y [m]")
    figure.tight_layout()
    figure.savefig(file, dpi=90)
    plt.close(figure)
