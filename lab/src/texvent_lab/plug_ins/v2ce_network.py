"""V2CE's 3-D U-Net: from pairs of frames to voxel grids of events. Needs torch to import.

Modules have the names of the tensors in the published file, `v2ce_3d.pt`.
"""

from __future__ import annotations

import itertools
from functools import partial
from typing import Any

from texvent.extending import require
from texvent.networks import Tensor
from texvent_lab.networks import EXTRA
from texvent_lab.networks.layers import Network

_torch: Any = require("torch", extra=EXTRA)
_nn: Any = require("torch.nn", extra=EXTRA)
_Module: Any = _nn.Module

WIDTHS, BLOCKS = (32, 64, 128, 256, 512), 2
"""Channels at full size, at half of it ...; blocks in the middle."""
POLARITIES, NODES = 2, 10
"""Axes of a voxel grid: ON and OFF, and nodes in time."""


class V2ce(Network):
    """Head, encoders that halve the images, residual blocks, decoders, a last layer above 0.

    Source: Z. Zhang et al., "V2CE: Video to Continuous Events Simulator", ICRA 2024, its program.
    """

    def __init__(self) -> None:
        """Random weights."""
        super().__init__()
        pairs, widest = list(itertools.pairwise(WIDTHS)), WIDTHS[-1]
        halving = partial(_nn.Conv3d, kernel_size=3, stride=(1, 2, 2), padding=1, bias=False)
        plain = partial(_nn.Conv3d, kernel_size=3, padding=1, bias=False)
        encoders = (_Residual(narrow, wide, halving, plain, (1, 2, 2)) for narrow, wide in pairs)
        middle = (_Residual(widest, widest) for _ in range(BLOCKS))
        decoders = (_Residual(wide + narrow, narrow) for narrow, wide in reversed(pairs))
        head = _nn.Conv3d(2, WIDTHS[0], 3, padding=1)
        self.UNet = _nn.ModuleDict(
            {
                "head": _nn.ModuleDict({"conv3d": head}),
                "encoders": _nn.ModuleList(encoders),
                "resblocks": _nn.ModuleList(middle),
                "decoders": _nn.ModuleList(decoders),
                "pred": _nn.ModuleDict({"conv3d": _nn.Conv3d(WIDTHS[0], POLARITIES * NODES, 1)}),
            }
        )

    def forward(self, pairs: Tensor) -> Tensor:
        """Voxel grids [n, 2, 10, H, W] of pairs of frames [n, 2, H, W] in the order of time.

        A grid holds ON and OFF events, at least 0, at ten nodes from frame to frame.
        """
        net, functional = self.UNet, _nn.functional
        x = functional.leaky_relu(net["head"]["conv3d"](pairs.transpose(0, 1)[None]))
        skipped = []
        for encoder in net["encoders"]:
            skipped.append(x)
            x = encoder(x)
        for block in net["resblocks"]:
            x = block(x)
        for decoder in net["decoders"]:
            beside = skipped.pop()
            x = functional.interpolate(x, size=beside.shape[2:], mode="nearest")
            x = decoder(_torch.cat([x, beside], dim=1))
        grids = net["pred"]["conv3d"](x).relu()[0].transpose(0, 1)
        return grids.unflatten(1, (POLARITIES, NODES))


class _SpectralConv(_Module):
    """A convolution whose weight is divided by its largest singular value.

    Deviation: the program starts each estimate of that value from the last one, so that its weights
        drift with the number of sequences; here each starts from the published vector.
    """

    def __init__(self, narrow: int, wide: int) -> None:
        super().__init__()
        self.module = _Module()
        shapes = {"bar": (wide, narrow, 3, 3, 3), "u": (wide,), "v": (narrow * 27,)}
        for name, shape in shapes.items():
            self.module.register_buffer(f"weight_{name}", _torch.randn(shape))

    def forward(self, x: Tensor) -> Tensor:
        weight = self.module.weight_bar
        matrix = weight.flatten(1)
        right = _nn.functional.normalize(matrix.T @ self.module.weight_u, dim=0)
        return _nn.functional.conv3d(x, weight / (matrix @ right).norm(), padding=1)


class _Residual(_Module):
    """Two convolutions, and one of a single pixel around them."""

    def __init__(
        self, narrow: int, wide: int, first: Any = _SpectralConv, second: Any = _SpectralConv,
        stride: Any = 1,
    ) -> None:  # fmt: skip
        super().__init__()
        self.conv1, self.bn1 = first(narrow, wide), _nn.BatchNorm3d(wide)
        self.conv2, self.bn2 = second(wide, wide), _nn.BatchNorm3d(wide)
        around = _nn.Conv3d(narrow, wide, 1, stride)
        self.downsample = _nn.Sequential(around, _nn.BatchNorm3d(wide))

    def forward(self, x: Tensor) -> Tensor:
        inner = self.bn2(self.conv2(self.bn1(self.conv1(x)).relu()))
        return (inner + self.downsample(x)).relu()
