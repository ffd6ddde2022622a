"""Scores, tables and pictures of the grid SLAM."""
import re
import statistics
import subprocess
import typing

import matplotlib
import numpy

import figures
import grids
from ros_session import SessionError

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


class Score(typing.NamedTuple):
    translation: float  # m, mean
    median: float  # m
    without_worst: float  # m, mean
    rotation: float  # deg, mean
    relations: int


def write_poses(file, poses):
    """Lines "stamp x y yaw" [s m m rad]."""
    with open(file, "w") as out:
        for stamp, (x, y, yaw) in poses:
            out.write(f"{stamp // 10**9}.{stamp % 10**9:09d} {x:.6f} {y:.6f} {yaw:.8f}\n")


def relations(poses, file, ahead):
    """What score_relations says."""
    done = subprocess.run(["rosrun", "field_fusion", "score_relations", str(poses), str(file), "--laser", str(ahead), "0", "0"],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        raise SessionError(done.stderr.strip())
    mean = {what: float(value) for what, value in re.findall(r"^(translation|rotation) +([0-9.]+) \+-", done.stdout, re.M)}
    median, rest = re.search(r"([0-9.]+) m \(median\), (nan|[0-9.]+) m", done.stdout).groups()
    return Score(mean["translation"], float(median), float(rest), mean["rotation"], int(done.stdout.split()[0]))


def table(name, rows, published):
    lines = [f"{name}: relative errors by {rows[0][6]} relations",
             "seed   translation   median   without the worst   rotation   CPU a scan   memory"]
    for _, seed, mean, median, rest, rotation, _, _, cpu, memory in rows:
        lines.append(f"{seed:4}   {mean:9.4f} m  {median:.4f} m  {rest:12.4f} m   {rotation:7.3f} deg  {cpu:6.1f} ms  {memory:6.0f} MB")
    return lines + ([f"Gmapping: {published}"] if published else []) + [""]


def lines(name, rows):
    translation, rotation = [row[2] for row in rows], [row[5] for row in rows]
    return [figures.mean(f"slam/{name}/translation_mean", translation, "m"),
            figures.worst(f"slam/{name}/translation_worst", translation, "m"),
            figures.mean(f"slam/{name}/rotation_mean", rotation, "deg"),
            figures.line(f"slam/{name}/cpu", statistics.median(row[8] for row in rows), "ms", len(rows),
                         figures.bootstrap([row[8] for row in rows], statistics.median, 400)),
            figures.worst(f"slam/{name}/memory", [row[9] for row in rows], "MB")]


def picture(grid, poses, file, title):
    info = grid.info
    cells = grids.cells(grid)
    shade = numpy.where(cells < 0, 205, numpy.where(cells >= grids.OCCUPIED, 0, 254))
    rows, columns = numpy.nonzero(cells >= 0)
    x0, y0, side = info.origin.position.x, info.origin.position.y, info.resolution
    extent = (x0, x0 + info.width * side, y0, y0 + info.height * side)
    figure, axes = plt.subplots(figsize=(9, 9))
    axes.imshow(shade, cmap="gray", vmin=0, vmax=255, origin="lower", extent=extent, interpolation="nearest")
    way = numpy.array([pose for _, pose in poses])
    axes.plot(way[:, 0], way[:, 1], color="tab:red", linewidth=0.6)
    axes.set_xlim(x0 + side * (columns.min() - 20), x0 + side * (columns.max() + 20))
    axes.set_ylim(y0 + side * (rows.min() - 20), y0 + side * (rows.max() + 20))
    axes.set(title=title, xlabel="x [m]", ylabel="y [m]")
    figure.savefig(file, dpi=110, bbox_inches="tight")
    plt.close(figure)
