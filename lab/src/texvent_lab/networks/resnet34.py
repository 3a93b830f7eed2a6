"""N-ImageNet's classifier: a ResNet-34 whose first kernel is 14 px wide.

Names of tensors are torchvision's.

Source: K. He et al., "Deep residual learning for image recognition", CVPR 2016; the first
convolution (kernel 14, stride 2, padding 3) is that of J. Kim et al., "N-ImageNet: towards robust,
fine-grained object recognition with event cameras", ICCV 2021, and its program.
docs/design.md says why no library's.
"""

from __future__ import annotations

from typing import Any

from texvent.extending import require
from texvent.networks import Tensor
from texvent_lab.networks import EXTRA
from texvent_lab.networks.layers import Network

_nn: Any = require("torch.nn", extra=EXTRA)
_Module: Any = _nn.Module

WIDTH, BLOCKS = 64, (3, 4, 6, 3)
"""Channels of the first stage, and residual blocks per stage, of ResNet-34."""
FIRST_KERNEL, FIRST_PADDING = 14, 3


class BasicBlock(_Module):
    """Two convolutions and a shortcut."""

    def __init__(self, narrow: int, wide: int, stride: int) -> None:
        super().__init__()
        self.conv1 = _nn.Conv2d(narrow, wide, 3, stride, 1, bias=False)
        self.bn1 = _nn.BatchNorm2d(wide)
        self.conv2 = _nn.Conv2d(wide, wide, 3, 1, 1, bias=False)
        self.bn2 = _nn.BatchNorm2d(wide)
        self.downsample = _nn.Identity()
        if narrow != wide:
            shortcut = _nn.Conv2d(narrow, wide, 1, stride, bias=False)
            self.downsample = _nn.Sequential(shortcut, _nn.BatchNorm2d(wide))

    def forward(self, x: Tensor) -> Tensor:
        """The block's output."""
        inner = self.bn2(self.conv2(self.bn1(self.conv1(x)).relu()))
        return (inner + self.downsample(x)).relu()


class ResNet(Network):
    """One score per class, higher is likelier, [n, classes], of images [n, channels, H, W]."""

    def __init__(
        self,
        channels: int,
        classes: int,
        *,
        width: int = WIDTH,
        blocks: tuple[int, ...] = BLOCKS,
    ) -> None:
        """Random weights.

        Kernels begin as K. He et al., "Delving deep into rectifiers", ICCV 2015, for outputs; the
        first and the last layer as torch's own, because N-ImageNet's program replaces them.

        Args:
            channels: of the input.
            classes: number of classes.
            width: channels of the first stage; each later one has twice as many.
            blocks: residual blocks per stage.
        """
        super().__init__()
        self.conv1 = _nn.Conv2d(channels, width, FIRST_KERNEL, 2, FIRST_PADDING, bias=False)
        self.bn1 = _nn.BatchNorm2d(width)
        self.stages = [f"layer{number + 1}" for number in range(len(blocks))]
        narrow = width
        for number, (name, count) in enumerate(zip(self.stages, blocks, strict=True)):
            wide = width << number
            first = BasicBlock(narrow, wide, 2 if number else 1)
            rest = (BasicBlock(wide, wide, 1) for _ in range(count - 1))
            setattr(self, name, _nn.Sequential(first, *rest))
            for kernel in getattr(self, name).parameters():
                if kernel.dim() == 4:
                    _nn.init.kaiming_normal_(kernel, mode="fan_out")
            narrow = wide
        self.fc = _nn.Linear(narrow, classes)

    def forward(self, images: Tensor) -> Tensor:
        """See the class."""
        x = self.bn1(self.conv1(images)).relu()
        x = _nn.functional.max_pool2d(x, 3, stride=2, padding=1)
        for name in self.stages:
            x = getattr(self, name)(x)
        return self.fc(x.mean(dim=(2, 3)))
