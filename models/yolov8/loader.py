"""Batches of training samples, made in threads while the network works on the one before."""
from collections import deque
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import torch

from .augment import augmented
from .loss import Bodies


def order_of(count, seed, epoch):
    return np.random.default_rng((seed, epoch)).permutation(count)


def collated(samples):
    """uint8 RGB images Nx3xHxW and their bodies."""
    images = np.stack([s.image[:, :, ::-1] for s in samples])  # NHWC: what a channels-last network wants
    boxes = np.concatenate([s.boxes for s in samples])
    classes = np.concatenate([s.classes for s in samples])
    owners = np.repeat(np.arange(len(samples)), [len(s.boxes) for s in samples])
    return (torch.from_numpy(images).permute(0, 3, 1, 2),
            Bodies(torch.from_numpy(boxes), torch.from_numpy(classes), torch.from_numpy(owners)))


def network_input(images, device):
    return images.to(device, non_blocking=True).float().div_(255)


class Loader:
    """Every sample follows from (seed, epoch, its place in the epoch) alone, so training goes on after an
    interruption as if there had been none."""

    def __init__(self, dataset, batch, seed, workers=1):
        self.dataset, self.seed = dataset, seed
        self.batch = min(batch, len(dataset))
        self.pool = ThreadPoolExecutor(workers)
        self.ahead = workers + 1

    def __len__(self):
        return len(self.dataset) // self.batch

    def _make(self, order, epoch, step, settings):
        places = range(step * self.batch, (step + 1) * self.batch)
        return collated([augmented(self.dataset, order[p], settings, np.random.default_rng((self.seed, epoch, p)))
                         for p in places])

    def epoch(self, epoch, first_step, settings_at):
        """Batches from `first_step` on; `settings_at(step)` is the augmentation of a step."""
        order = order_of(len(self.dataset), self.seed, epoch)
        pending = deque()
        for step in range(first_step, len(self) + self.ahead):
            if step < len(self):
                pending.append(self.pool.submit(self._make, order, epoch, step, settings_at(step)))
            if pending and (len(pending) > self.ahead or step >= len(self)):
                yield pending.popleft().result()
        while pending:
            yield pending.popleft().result()
