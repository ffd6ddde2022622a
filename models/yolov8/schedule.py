"""How far a training is, and what its learning rate is there."""
import math

WARM_UP = 0.03   # share of the training in which the rate rises
LEAST_RATE = 0.01  # at the end, of the highest


def rate_factor(progress):
    """0..1 of the highest learning rate at 0..1 of the training: up in a line, down in a cosine."""
    cosine = LEAST_RATE + (1 - LEAST_RATE) * (1 + math.cos(math.pi * min(progress, 1.0))) / 2
    return cosine * min(1.0, max(progress, 1e-4) / WARM_UP)


class Plan:
    """The end of a training: a number of epochs, or a time in which there are as many steps as fit."""

    def __init__(self, epochs=None, minutes=None):
        if (epochs is None) == (minutes is None) or max(epochs or 0, minutes or 0) <= 0:
            raise ValueError("a training ends after a number of epochs or of minutes above 0")
        self.epochs, self.seconds = epochs, minutes and 60.0 * minutes

    def progress(self, steps, steps_of_epoch, seconds):
        """0 at the start, 1 at the end."""
        if self.epochs is not None:
            return min(1.0, steps / (self.epochs * steps_of_epoch))
        return min(1.0, seconds / self.seconds)
