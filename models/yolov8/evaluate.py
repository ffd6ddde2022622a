"""The network's score on a split of a data set."""
import torch

from .augment import letterboxed
from .average_precision import Scorer
from .detections import detections_of, in_image
from .loader import collated, network_input

CONFIDENCE = 0.001  # low, as precision is wanted at every recall
OVERLAP = 0.7


def batches(count, batch):
    return [range(start, min(start + batch, count)) for start in range(0, count, batch)]


def score(detect, dataset, batch=16, overlap=OVERLAP):
    """A filled Scorer. `detect`: from images Nx3xHxW (RGB uint8) to raw maps."""
    scorer = Scorer(dataset.names)
    for rows in batches(len(dataset), batch):
        samples = [dataset.samples[i] for i in rows]
        images, _ = collated([letterboxed(sample, dataset.size) for sample in samples])
        for index, sample, found in zip(rows, samples, detections_of(detect(images), CONFIDENCE, overlap)):
            size, fitted = dataset.original_sizes[index], sample.image.shape[1::-1]
            factor = [s / f for s, f in zip(size, fitted)] * 2
            scorer.add(in_image(found, size, dataset.size, fitted), sample.boxes * factor, sample.classes)
    return scorer


def runner(network):
    """`detect` for `score` from a network, on the device where it is."""
    device = next(network.parameters()).device

    @torch.no_grad()
    def detect(images):
        return network(network_input(images, device))

    return detect
