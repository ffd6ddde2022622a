"""Exponential average of a network's weights: what is measured and exported."""
import copy
import math

import torch


class Average:
    """The average forgets slowly at the end of a training, and fast at its start, where weights still move."""

    def __init__(self, network, decay=0.9999, tau=2000):
        self.network = copy.deepcopy(network).eval().requires_grad_(False)
        self.decay, self.tau, self.updates = decay, tau, 0

    @torch.no_grad()
    def update(self, network):
        self.updates += 1
        share = 1 - self.decay * (1 - math.exp(-self.updates / self.tau))
        current = network.state_dict()
        for name, mean in self.network.state_dict().items():
            if mean.is_floating_point():
                mean.lerp_(current[name], share)
            else:
                mean.copy_(current[name])
