"""Moving average of a network's weights: what is measured and exported."""
import copy

import torch

WINDOW, LONGEST = 0.02, 10000  # of the steps so far; steps


class Average:
    """Over a window that grows with the training: weights move fast at its start, and little at its end."""

    def __init__(self, network):
        self.network = copy.deepcopy(network).eval().requires_grad_(False)
        self.updates = 0

    @torch.no_grad()
    def update(self, network):
        self.updates += 1
        share = 1 / (1 + min(WINDOW * self.updates, LONGEST))
        current = network.state_dict()
        for name, mean in self.network.state_dict().items():
            if mean.is_floating_point():
                mean.lerp_(current[name], share)
            else:
                mean.copy_(current[name])
