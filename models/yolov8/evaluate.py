"""A detector's score on a split of a data set."""
import torch

from .augment import letterboxed
from .average_precision import SIZES, Scorer
from .detections import detections_of, in_image
from .loader import collated, network_input

CONFIDENCE = 0.001  # low, as precision is wanted at every recall
OVERLAP = 0.7


def score(detect, dataset, batch=16, sizes=SIZES):
    """A filled Scorer. `detect`: from images Nx3xHxW (RGB uint8) to one Detections each [px of the input]."""
    scorer = Scorer(dataset.names, sizes)
    for start in range(0, len(dataset), batch):
        samples = dataset.samples[start:start + batch]
        images, _ = collated([letterboxed(sample, dataset.size) for sample in samples])
        for sample, size, found in zip(samples, dataset.original_sizes[start:], detect(images)):
            fitted = sample.image.shape[1::-1]
            factor = [s / f for s, f in zip(size, fitted)] * 2
            scorer.add(in_image(found, size, dataset.size, fitted), sample.boxes * factor, sample.classes)
    return scorer


def runner(network, confidence=CONFIDENCE, overlap=OVERLAP):
    """`detect` for `score` from a network, on the device where it is."""
    device = next(network.parameters()).device

    @torch.no_grad()
    def detect(images):
        return detections_of(network(network_input(images, device)), confidence, overlap)

    return detect
