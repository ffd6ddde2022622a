"""What a training says on the terminal, and its table."""
import csv
import os
import sys
import time

SECONDS = 30  # between lines where the output is no terminal


def duration(seconds):
    minutes = int(seconds) // 60
    return f"{minutes // 60}:{minutes % 60:02d} h" if minutes >= 60 else f"{minutes} min {int(seconds) % 60:02d} s"


class Report:
    def __init__(self, stream=sys.stdout):
        self.stream, self.last = stream, 0.0
        self.first = None  # (seconds of training, images) when this process began

    def step(self, training):
        images = (training.epoch * len(training.loader) + training.step) * training.loader.batch
        if self.first is None:
            self.first = (training.seconds, images)
        terminal = self.stream.isatty()
        now = time.monotonic()
        if now - self.last < (0.2 if terminal else SECONDS):
            return
        self.last = now
        self.stream.write(("\r\033[K" if terminal else "") + self.line(training, images) + ("" if terminal else "\n"))
        self.stream.flush()

    def line(self, training, images):
        progress, seconds = training.progress(), training.seconds
        rate = (images - self.first[1]) / max(1e-9, seconds - self.first[0])
        left = seconds * (1 - progress) / max(progress, 1e-9)
        mean = training.losses.sum().item() / max(1, training.step)
        return (f"epoch {training.epoch + 1}, step {training.step}/{len(training.loader)}: loss {mean:.3f}, "
                f"{rate:.1f} images/s, {100 * progress:.1f} % done, {duration(left)} left")

    def epoch(self, training):
        row = training.history[-1]
        text = (f"epoch {row['epoch']}: score {row['score_loss']:.3f}, box {row['box_loss']:.3f}, "
                f"distribution {row['distribution_loss']:.3f}, after {duration(row['seconds'])}")
        if row["map50"] is not None:
            text += f"; validation: mAP50 {row['map50']:.3f}, mAP50-95 {row['map50_95']:.3f}"
        self.stream.write(("\r\033[K" if self.stream.isatty() else "") + text + "\n")
        self.stream.flush()
        write_table(training.out / "epochs.csv", training.history)


def write_table(path, rows):
    part = path.with_name(path.name + ".part")
    with open(part, "w", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    os.replace(part, path)


def score_table(scorer):
    """AP50 and AP50-95 of each class and size, in Markdown."""
    def cell(value):
        return "-" if value != value else f"{value:.3f}"

    sizes = [s for s in scorer.sizes if s != "all"]
    lines = ["| class | bodies | AP50 | AP50-95 | " + " | ".join(f"AP50-95 {s}" for s in sizes) + " |",
             "|---|---|---|---|" + "---|" * len(sizes)]
    tables = {size: scorer.table(size) for size in scorer.sizes}
    for c, name in enumerate(scorer.names):
        values = [tables["all"][c, 0], tables["all"][c].mean(), *(tables[s][c].mean() for s in sizes)]
        lines.append(f"| {name} | {scorer.bodies(c)} | " + " | ".join(map(cell, values)) + " |")
    values = [*scorer.summary(), *(scorer.summary(s)[1] for s in sizes)]
    bodies = sum(map(scorer.bodies, range(len(scorer.names))))
    return "\n".join([*lines, f"| **all** | {bodies} | " + " | ".join(map(cell, values)) + " |"])
