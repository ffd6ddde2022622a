"""The building blocks of the network."""
import torch
from torch import nn

NORM_EPS = 1e-3
# Faster than the usual 0.03: some 100 steps shall be enough to forget the variance 1 of the start, which is far
# from the true one and compounds from layer to layer. Average smooths what this makes noisy.
NORM_MOMENTUM = 0.1


class Conv(nn.Module):
    """Convolution, batch normalisation, SiLU. `folded` has the normalisation in its weights (see export)."""

    def __init__(self, inputs, outputs, kernel=1, stride=1, folded=False):
        super().__init__()
        self.conv = nn.Conv2d(inputs, outputs, kernel, stride, kernel // 2, bias=folded)
        self.norm = nn.Identity() if folded else nn.BatchNorm2d(outputs, eps=NORM_EPS, momentum=NORM_MOMENTUM)
        self.act = nn.SiLU(inplace=True)

    def forward(self, x):
        return self.act(self.norm(self.conv(x)))


class HalvedConv(Conv):
    """The same, its channels in two halves."""

    def forward(self, x):
        return super().forward(x).chunk(2, 1)


class Bottleneck(nn.Module):
    def __init__(self, channels, shortcut):
        super().__init__()
        self.first = Conv(channels, channels, 3)
        self.second = Conv(channels, channels, 3)
        self.shortcut = shortcut

    def forward(self, x):
        y = self.second(self.first(x))
        return x + y if self.shortcut else y


class C2f(nn.Module):
    """Half of the channels goes through `depth` bottlenecks in a row; the results of all are kept."""

    def __init__(self, inputs, outputs, depth, shortcut):
        super().__init__()
        half = outputs // 2
        self.enter = HalvedConv(inputs, 2 * half)
        self.blocks = nn.ModuleList(Bottleneck(half, shortcut) for _ in range(depth))
        self.leave = Conv((2 + depth) * half, outputs)

    def forward(self, x):
        parts = list(self.enter(x))
        for block in self.blocks:
            parts.append(block(parts[-1]))
        return self.leave(torch.cat(parts, 1))


class SPPF(nn.Module):
    """Maxima over windows of 5, 9 and 13 cells, as three pools of 5 in a row."""

    def __init__(self, channels):
        super().__init__()
        self.enter = Conv(channels, channels // 2)
        self.pool = nn.MaxPool2d(5, 1, 2)
        self.leave = Conv(4 * (channels // 2), channels)

    def forward(self, x):
        parts = [self.enter(x)]
        for _ in range(3):
            parts.append(self.pool(parts[-1]))
        return self.leave(torch.cat(parts, 1))
