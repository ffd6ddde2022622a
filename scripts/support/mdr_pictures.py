"""What a person looks at: the maps beside one another, as in the paper's Fig. 9, and scans before and after, as in its Fig. 8."""
import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

import corridor_length  # noqa: E402
import mdr_corridor  # noqa: E402
import mdr_worlds  # noqa: E402

NAMES = {"raw": "raw: no correction", "vicp": "VICP: velocity by scan matching", "imu": "IMU", "mdr": "odometry (MDR)",
         "instant": "ideal scanner: all beams at once"}


def maps(rows, file):
    """Of one seed. Black: occupied, white: seen free, grey: not seen; red: where the end walls truly are."""
    figure, axes = pyplot.subplots(len(rows), 3, figsize=(14, 1.75 * len(rows)), width_ratios=(1.2, 5.4, 1.2))
    for row, (west, whole, east) in zip(rows, axes):
        cells = row.map.cells
        shade = (cells < 0) * 0.25 + (cells >= corridor_length.OCCUPIED) * 1.0
        for axis in (west, whole, east):
            axis.imshow(shade, cmap="Greys", vmin=0, vmax=1, origin="lower", extent=row.map.extent(), interpolation="nearest")
            axis.set(ylim=(-1.5, 1.5), aspect="equal", yticks=[-1, 0, 1] if axis is west else [])
            for wall in (-mdr_corridor.LENGTH / 2, mdr_corridor.LENGTH / 2):
                axis.axvline(wall, color="red", linewidth=0.8)
        west.set(xlim=(-16, -14), ylabel="y [m]")
        whole.set(xlim=(-16, 16), title=f"{NAMES[row.kind]}: {row.length:.3f} m")
        east.set(xlim=(14, 16))
    axes[-1][1].set_xlabel("x [m]      left and right: the ends, larger; red: where the end walls truly are, 30 m apart")
    _save(figure, file)


def scans(overlays, file):
    """Each scan of a turning scanner where it was at the first beam: before, after, and the true walls."""
    figure, axes = pyplot.subplots(1, len(overlays), figsize=(7 * len(overlays), 5.6), squeeze=False)
    x, y = mdr_worlds.LONG / 2, mdr_worlds.WIDE / 2
    for axis, overlay in zip(axes[0], overlays):
        axis.plot([-x, x, x, -x, -x], [-y, -y, y, y, -y], color="0.6", linewidth=1, label="walls, truly")
        for kind, colour, label in (("raw", "red", "before: raw"), ("mdr", "tab:green", "after: odometry (MDR)")):
            axis.plot(*overlay.clouds[kind].T, ".", color=colour, markersize=2.5, label=label)
        axis.plot(*overlay.place, "k^", markersize=5, label="scanner")
        axis.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", title=f"turning at {overlay.case.rsplit('_')[-1]} deg/s")
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=4, fontsize=8, markerscale=2)
    _save(figure, file)


def _save(figure, file):
    figure.tight_layout()
    figure.savefig(file, dpi=110, bbox_inches="tight")
    pyplot.close(figure)
