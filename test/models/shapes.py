"""Pictures of coloured shapes with their boxes, for tests of the training."""
import cv2
import numpy as np

NAMES = ["box", "disc", "triangle"]


def draw(rng, size, most=3):
    """A picture of (width, height), rows (class, x_min, y_min, x_max, y_max) [px]; the shapes do not overlap."""
    width, height = size
    image = np.full((height, width, 3), rng.integers(90, 160), np.uint8)
    rows = []
    for _ in range(rng.integers(0, most + 1)):
        w, h = rng.integers(height // 5, height // 2, 2)
        x, y = rng.integers(0, width - w), rng.integers(0, height - h)
        if any(x < r[3] and r[1] < x + w and y < r[4] and r[2] < y + h for r in rows):
            continue
        kind = int(rng.integers(3))
        colour = tuple(int(v) for v in rng.choice([10, 240], 3))
        if kind == 0:
            cv2.rectangle(image, (x, y), (x + w - 1, y + h - 1), colour, -1)
        elif kind == 1:
            cv2.ellipse(image, (x + w // 2, y + h // 2), (w // 2, h // 2), 0, 0, 360, colour, -1)
        else:
            cv2.fillPoly(image, [np.array([[x, y + h - 1], [x + w - 1, y + h - 1], [x + w // 2, y]])], colour)
        rows.append((kind, x, y, x + w, y + h))
    return image, rows


def label_lines(rows, size):
    width, height = size
    relative = [(c, (x0 + x1) / 2 / width, (y0 + y1) / 2 / height, (x1 - x0) / width, (y1 - y0) / height)
                for c, x0, y0, x1, y1 in rows]
    return "".join("{} {:.6f} {:.6f} {:.6f} {:.6f}\n".format(*row) for row in relative)


def write_dataset(folder, counts, size, seed=0):
    rng = np.random.default_rng(seed)
    for split, count in counts.items():
        images, labels = folder / "images" / split, folder / "labels" / split
        images.mkdir(parents=True)
        labels.mkdir(parents=True)
        for index in range(count):
            image, rows = draw(rng, size)
            cv2.imwrite(str(images / f"{index:03}.png"), image)
            (labels / f"{index:03}.txt").write_text(label_lines(rows, size))
    (folder / "data.yaml").write_text(f"names: [{', '.join(NAMES)}]\n")
    return folder
