"""E-RAFT: optical flow from two consecutive slices, refined twelve times."""

from __future__ import annotations

import math
from typing import Any

from texvent.extending import require
from texvent.networks.weight_files import Tensor
from texvent_lab.networks import Padding
from texvent_lab.networks.layers import Network, make_seeded
from texvent_lab.train.schedule import EXTRA

_torch: Any = require("torch", extra=EXTRA)
_nn: Any = require("torch.nn", extra=EXTRA)
_Module: Any = _nn.Module


class CorrelationPyramid:
    """Scalar products of the features of two images, at several sizes of the second one.

    Source: Z. Teed, J. Deng, "RAFT: recurrent all-pairs field transforms for optical flow", ECCV
        2020, section 3.2.
    """

    def __init__(self, first: Tensor, second: Tensor, *, levels: int) -> None:
        """Correlate every pixel with every other.

        Args:
            first: features, [n, channels, h, w].
            second: of the other image, of the same shape; h and w at least 2^(levels − 1).
            levels: sizes of the second image, each half of the one before.
        """
        n, channels, height, width = first.shape
        product = first.flatten(2).transpose(1, 2) @ second.flatten(2)
        volume = product.reshape(n * height * width, 1, height, width) / math.sqrt(channels)
        self._levels = [volume]
        for _ in range(levels - 1):
            self._levels.append(_nn.functional.avg_pool2d(self._levels[-1], 2))

    def look_up(self, places: Tensor, radius: int) -> Tensor:
        """Correlations around a place in the second image for each pixel of the first.

        Args:
            places: (x, y), px, [n, 2, h, w].
            radius: neighbours up to this distance along both axes, px of each size.

        Returns:
            [n, levels · (2 · radius + 1)², h, w]; sizes from the largest, then columns from the
            left, then rows from above. Bilinear between pixels, 0 outside.
        """
        n, _, height, width = places.shape
        steps = _torch.arange(-radius, radius + 1, dtype=places.dtype, device=places.device)
        # x varies along the first axis: the published weights expect columns before rows.
        around = _torch.stack(_torch.meshgrid(steps, steps, indexing="ij"), -1)
        centres = places.permute(0, 2, 3, 1).reshape(-1, 1, 1, 2)
        parts = []
        for level, volume in enumerate(self._levels):
            sides = places.new_tensor(volume.shape[:-3:-1])
            # From pixels, whose centres are whole numbers, to −1..1 between the borders.
            grid = (2 * (centres / 2**level + around) + 1) / sides - 1
            found = _torch.nn.functional.grid_sample(volume, grid, align_corners=False)
            parts.append(found.reshape(n, height, width, -1))
        return _torch.cat(parts, -1).permute(0, 3, 1, 2)


WIDTHS = (64, 96, 128)
"""Channels of an encoder at half, a quarter and an eighth of the size."""
FEATURE_CHANNELS, HIDDEN, CONTEXT_CHANNELS = 256, 128, 128
LEVELS, RADIUS = 4, 4
"""Sizes at which correlations are looked up, and how far around, px of each size."""
LOOKED_UP = LEVELS * (2 * RADIUS + 1) ** 2
MOTION = 128
"""Channels of the motion features, the flow itself among them."""
ENLARGEMENT = 8
CONVEX = 9 * ENLARGEMENT**2
"""Weights of the neighbours of each of 8×8 fine pixels."""
ITERATIONS = 12
MULTIPLE = 32
LEAST_SIDE = ENLARGEMENT << (LEVELS - 1)
"""Below, px, the smallest size of the correlations would have no pixel."""


class _Block(_Module):
    """Two convolutions and a shortcut; normalised by the batch, or each image by itself."""

    def __init__(self, narrow: int, wide: int, stride: int, norm: Any) -> None:
        super().__init__()
        self.conv1 = _nn.Conv2d(narrow, wide, 3, stride, 1)
        self.conv2 = _nn.Conv2d(wide, wide, 3, 1, 1)
        self.norm1, self.norm2 = norm(wide), norm(wide)
        self.downsample = _nn.Identity()
        if stride > 1:
            # The program stores the normalisation of the shortcut under two names.
            self.norm3 = norm(wide)
            self.downsample = _nn.Sequential(_nn.Conv2d(narrow, wide, 1, stride), self.norm3)

    def forward(self, x: Tensor) -> Tensor:
        y = self.norm1(self.conv1(x)).relu()
        y = self.norm2(self.conv2(y)).relu()
        return (self.downsample(x) + y).relu()


class _Encoder(_Module):
    """Features at an eighth of the size."""

    def __init__(self, bins: int, channels: int, norm: Any) -> None:
        super().__init__()
        self.conv1 = _nn.Conv2d(bins, WIDTHS[0], 7, 2, 3)
        self.norm1 = norm(WIDTHS[0])
        narrow = WIDTHS[0]
        for layer, wide in enumerate(WIDTHS, 1):
            first = _Block(narrow, wide, 2 if layer > 1 else 1, norm)
            setattr(self, f"layer{layer}", _nn.Sequential(first, _Block(wide, wide, 1, norm)))
            narrow = wide
        self.conv2 = _nn.Conv2d(narrow, channels, 1)

    def forward(self, x: Tensor) -> Tensor:
        x = self.norm1(self.conv1(x)).relu()
        return self.conv2(self.layer3(self.layer2(self.layer1(x))))


class _MotionEncoder(_Module):
    """Motion features of correlations and flow, the flow itself among them."""

    def __init__(self) -> None:
        super().__init__()
        self.convc1 = _nn.Conv2d(LOOKED_UP, 256, 1)
        self.convc2 = _nn.Conv2d(256, 192, 3, padding=1)
        self.convf1 = _nn.Conv2d(2, 128, 7, padding=3)
        self.convf2 = _nn.Conv2d(128, 64, 3, padding=1)
        self.conv = _nn.Conv2d(64 + 192, MOTION - 2, 3, padding=1)

    def forward(self, flow: Tensor, looked_up: Tensor) -> Tensor:
        seen = self.convc2(self.convc1(looked_up).relu()).relu()
        moved = self.convf2(self.convf1(flow).relu()).relu()
        return _torch.cat([self.conv(_torch.cat([seen, moved], 1)).relu(), flow], 1)


class _SeparableGru(_Module):
    """A gated recurrent unit along rows, then one along columns."""

    def __init__(self) -> None:
        super().__init__()
        before = HIDDEN + CONTEXT_CHANNELS + MOTION
        for number, sides in ((1, (1, 5)), (2, (5, 1))):
            padding = (sides[0] // 2, sides[1] // 2)
            for gate in "zrq":
                convolution = _nn.Conv2d(before, HIDDEN, sides, padding=padding)
                setattr(self, f"conv{gate}{number}", convolution)

    def forward(self, hidden: Tensor, x: Tensor) -> Tensor:
        for z, r, q in (
            (self.convz1, self.convr1, self.convq1),
            (self.convz2, self.convr2, self.convq2),
        ):
            both = _torch.cat([hidden, x], 1)
            update, reset = z(both).sigmoid(), r(both).sigmoid()
            candidate = q(_torch.cat([reset * hidden, x], 1)).tanh()
            hidden = (1 - update) * hidden + update * candidate
        return hidden


class _FlowHead(_Module):
    def __init__(self) -> None:
        super().__init__()
        self.conv1 = _nn.Conv2d(HIDDEN, 256, 3, padding=1)
        self.conv2 = _nn.Conv2d(256, 2, 3, padding=1)

    def forward(self, x: Tensor) -> Tensor:
        return self.conv2(self.conv1(x).relu())


class ERaft(Network):
    """E-RAFT, to be read from its published file; it is not trained here.

    Source: M. Gehrig, M. Millhäusler, D. Gehrig, D. Scaramuzza, "E-RAFT: dense optical flow from
        event cameras", 3DV 2021, section 3, and its program.
    Deviation: inputs below 64 px are padded to 64 px; the program fails. No warm start.
    """

    def __init__(self, bins: int) -> None:
        """Random weights; voxel grids of the published networks have 15 bins, or 5 for MVSEC."""
        super().__init__()
        self.fnet = _Encoder(bins, FEATURE_CHANNELS, _nn.InstanceNorm2d)
        self.cnet = _Encoder(bins, HIDDEN + CONTEXT_CHANNELS, _nn.BatchNorm2d)
        mask = _nn.Sequential(
            _nn.Conv2d(HIDDEN, 256, 3, padding=1), _nn.ReLU(), _nn.Conv2d(256, CONVEX, 1)
        )
        self.update_block = _nn.ModuleDict(
            {
                "encoder": _MotionEncoder(),
                "gru": _SeparableGru(),
                "flow_head": _FlowHead(),
                "mask": mask,
            }
        )

    def forward(self, before: Tensor, voxel: Tensor) -> Tensor:
        """Displacement over the later slice, (x, y) in px, [n, 2, H, W].

        Args:
            before: voxel grids of the earlier slice, [n, bins, H, W].
            voxel: of the later one.
        """
        padding, update = _padding(*voxel.shape[-2:]), self.update_block
        before, voxel = padding.around(before), padding.around(voxel)
        features = self.fnet(_torch.cat([before, voxel]))
        pyramid = CorrelationPyramid(*features.chunk(2), levels=LEVELS)
        hidden, context = self.cnet(voxel).split(HIDDEN, 1)
        hidden, context = hidden.tanh(), context.relu()
        rows, columns = (_torch.arange(n, dtype=voxel.dtype) for n in hidden.shape[-2:])
        grid = _torch.stack(_torch.meshgrid(columns, rows, indexing="xy"))[None].to(voxel.device)
        flow = _torch.zeros_like(grid.expand(len(voxel), -1, -1, -1))
        for _ in range(ITERATIONS):
            motion = update["encoder"](flow, pyramid.look_up(grid + flow, RADIUS))
            hidden = update["gru"](hidden, _torch.cat([context, motion], 1))
            flow = flow + update["flow_head"](hidden)
        return padding.off(_enlarge(flow, 0.25 * update["mask"](hidden)))


def make_e_raft(bins: int, seed: int = 0) -> ERaft:
    """A network with random weights; see `ERaft`."""
    return make_seeded(lambda: ERaft(bins), seed)


def _padding(height: int, width: int) -> Padding:
    """Zeros left and above, up to a multiple of 32 px."""
    missing = [max(-(-side // MULTIPLE) * MULTIPLE, LEAST_SIDE) - side for side in (width, height)]
    return Padding(left=missing[0], right=0, top=missing[1], bottom=0)


def _enlarge(flow: Tensor, weights: Tensor) -> Tensor:
    """Flow at eight times the size: each pixel a mixture of the nine coarse ones around it.

    Args:
        flow: px of the coarse size, [n, 2, h, w].
        weights: of the mixtures, before their softmax, [n, 9 · 8 · 8, h, w].

    Returns:
        px, [n, 2, 8 · h, 8 · w].
    """
    n, _, height, width = flow.shape
    side = ENLARGEMENT
    shares = weights.reshape(n, 1, 9, side, side, height, width).softmax(dim=2)
    around = _nn.functional.unfold(side * flow, 3, padding=1)
    around = around.reshape(n, 2, 9, 1, 1, height, width)
    fine = (shares * around).sum(dim=2).permute(0, 1, 4, 2, 5, 3)
    return fine.reshape(n, 2, side * height, side * width)
