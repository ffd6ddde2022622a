"""The network: from images to the raw maps of strides 8, 16 and 32."""
import math

import torch
from torch import nn

from .layers import SPPF, C2f, Conv

STRIDES = (8, 16, 32)
BINS = 16  # of each distribution over a box side's distance [cells]
BOX_ROWS = 4 * BINS
# n, s, m, l, x: depth, width, most channels of the last stage before the width counts
VARIANTS = {"n": (1 / 3, 0.25, 1024), "s": (1 / 3, 0.5, 1024), "m": (2 / 3, 0.75, 768),
            "l": (1, 1, 512), "x": (1, 1.25, 512)}


def channels_of(nominal, width, most):
    return math.ceil(min(nominal, most) * width / 8) * 8


class Backbone(nn.Module):
    def __init__(self, c1, c2, c3, c4, c5, shallow, deep):
        super().__init__()
        self.stem = Conv(3, c1, 3, 2)
        self.down2, self.stage2 = Conv(c1, c2, 3, 2), C2f(c2, c2, shallow, True)
        self.down3, self.stage3 = Conv(c2, c3, 3, 2), C2f(c3, c3, deep, True)
        self.down4, self.stage4 = Conv(c3, c4, 3, 2), C2f(c4, c4, deep, True)
        self.down5, self.stage5 = Conv(c4, c5, 3, 2), C2f(c5, c5, shallow, True)
        self.pool = SPPF(c5)

    def forward(self, image):
        p3 = self.stage3(self.down3(self.stage2(self.down2(self.stem(image)))))
        p4 = self.stage4(self.down4(p3))
        return p3, p4, self.pool(self.stage5(self.down5(p4)))


class Neck(nn.Module):
    """Features go from coarse to fine and back to coarse."""

    def __init__(self, c3, c4, c5, depth):
        super().__init__()
        self.up5, self.top4 = nn.Upsample(scale_factor=2), C2f(c5 + c4, c4, depth, False)
        self.up4, self.out3 = nn.Upsample(scale_factor=2), C2f(c4 + c3, c3, depth, False)
        self.down3, self.out4 = Conv(c3, c3, 3, 2), C2f(c3 + c4, c4, depth, False)
        self.down4, self.out5 = Conv(c4, c4, 3, 2), C2f(c4 + c5, c5, depth, False)

    def forward(self, p3, p4, p5):
        t4 = self.top4(torch.cat([self.up5(p5), p4], 1))
        o3 = self.out3(torch.cat([self.up4(t4), p3], 1))
        o4 = self.out4(torch.cat([self.down3(o3), t4], 1))
        return o3, o4, self.out5(torch.cat([self.down4(o4), p5], 1))


class Head(nn.Module):
    """Boxes and scores of each cell, in branches of their own."""

    def __init__(self, channels, classes):
        super().__init__()
        boxes, scores = max(BINS, channels[0] // 4, BOX_ROWS), max(channels[0], min(classes, 100))
        self.boxes = nn.ModuleList(self._branch(c, boxes, BOX_ROWS) for c in channels)
        self.scores = nn.ModuleList(self._branch(c, scores, classes) for c in channels)
        for box, score, stride in zip(self.boxes, self.scores, STRIDES):
            nn.init.constant_(box[-1].bias, 1.0)
            # some 5 bodies in an image of 640 px: without this the first steps only unlearn false alarms
            nn.init.constant_(score[-1].bias, math.log(5 / classes / (640 / stride) ** 2))

    @staticmethod
    def _branch(inputs, middle, outputs):
        return nn.Sequential(Conv(inputs, middle, 3), Conv(middle, middle, 3), nn.Conv2d(middle, outputs, 1))

    def forward(self, maps):
        return [torch.cat([box(x), score(x)], 1) for box, score, x in zip(self.boxes, self.scores, maps)]


class YoloV8(nn.Module):
    """Images Nx3xHxW (RGB, 0..1, sides multiples of 32) to three maps Nx(64 + classes)x(H/s)x(W/s)."""

    def __init__(self, classes, width=0.25, depth=1 / 3, most=1024):
        super().__init__()
        if classes < 1:
            raise ValueError(f"a detector of {classes} classes")
        self.config = {"classes": classes, "width": width, "depth": depth, "most": most}
        c1, c2, c3, c4, c5 = (channels_of(c, width, most) for c in (64, 128, 256, 512, 1024))
        shallow, deep = max(1, round(3 * depth)), max(1, round(6 * depth))
        self.backbone = Backbone(c1, c2, c3, c4, c5, shallow, deep)
        self.neck = Neck(c3, c4, c5, shallow)
        self.head = Head((c3, c4, c5), classes)

    def forward(self, image):
        return self.head(self.neck(*self.backbone(image)))
