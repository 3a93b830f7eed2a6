"""Depth from events: E2Depth, its loss, its scores."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from texvent.config import check_range
from texvent.dataset.samples import Target
from texvent.extending import require
from texvent.networks.weight_files import Tensor
from texvent_lab.networks import Padding
from texvent_lab.networks.layers import make_seeded
from texvent_lab.reconstruct.recurrent_unet import E2vid, UNetVariant
from texvent_lab.train.dense_errors import FARTHEST_M, DepthError
from texvent_lab.train.schedule import EXTRA, TrainingConfig
from texvent_lab.train.sequences import SequenceData
from texvent_lab.train.task import Score, Task
from texvent_lab.train.truth import GRIDS, TruthTask


@dataclass(frozen=True, kw_only=True)
class DepthNetwork:
    """The network: E2Depth."""

    width: int = 32
    """Channels of the first layer; the published network has 32."""

    def __post_init__(self) -> None:
        check_range("width", self.width, 1, 1024)


@dataclass(frozen=True, kw_only=True)
class DepthLoss:
    """What is made small; the defaults are the published ones."""

    shift_weight: float = 1.0
    """Share of a constant factor of depth that is forgiven: 1 learns depth up to a factor, 0
    learns metres like any other error."""
    gradient_weight: float = 0.25
    """Of the differences between edges."""
    sky: bool = True
    """Whether the sky and what is beyond 80 m are learned as 80 m; else nothing is learned there,
    just as nothing is scored there."""

    def __post_init__(self) -> None:
        check_range("shift_weight", self.shift_weight, 0.0, 1.0)
        check_range("gradient_weight", self.gradient_weight, 0.0, 1e6)


@dataclass(frozen=True, kw_only=True)
class DepthConfig(TrainingConfig):
    """A network that gives depth from events."""

    flip_x: bool = True
    """Mirror half of the training samples."""
    data: SequenceData = field(default_factory=SequenceData)
    network: DepthNetwork = field(default_factory=DepthNetwork)
    loss: DepthLoss = field(default_factory=DepthLoss)

    def make_task(self) -> Task:
        """See `TrainingConfig`."""
        return DepthTask(self)


ARCHITECTURE = "E2VIDRecurrent"
"""What the program of E2Depth calls it."""
BINS = 5
KERNEL = 5


class E2Depth(E2vid):
    """E2VID's network, from normalised voxel grids to log depth (see `encode_depth`).

    Source: J. Hidalgo-Carrió, D. Gehrig, D. Scaramuzza, "Learning monocular dense depth from
        events", 3DV 2020, section 3.2, and its program.
    """

    def forward(self, grids: Tensor) -> Tensor:
        """Log depth at the end of each window, [n, windows, 1, H, W] of [n, windows, 5, H, W]."""
        padding = Padding.centred(grids.shape[-2:], self.multiple)
        return padding.off(super().forward(padding.around(grids)))


def make_e2depth(width: int, seed: int) -> E2Depth:
    """A network with random weights whose first layer has `width` channels; as published: 32."""
    return make_seeded(lambda: E2Depth(UNetVariant(width=width, bins=BINS, side=KERNEL)), seed)


def settings_of(width: int) -> dict[str, Any]:
    """What the program of E2Depth builds the network from."""
    return {
        "num_bins": BINS,
        "skip_type": "sum",
        "recurrent_block_type": "convlstm",
        "num_encoders": UNetVariant.encoders,
        "base_num_channels": width,
        "num_residual_blocks": UNetVariant.blocks,
        "use_upsample_conv": True,
        "norm": "none",
    }


LOG_RANGE = 3.70378
"""Natural logarithm of farthest over nearest depth; the nearest is 1.97 m."""


def encode_depth(depth_m: Tensor) -> Tensor:
    """1 at the farthest depth and beyond, 0 at the nearest and before; NaN stays NaN.

    Args:
        depth_m: metres, 0 or more, any shape; inf for the sky.

    Source: J. Hidalgo-Carrió, D. Gehrig, D. Scaramuzza, "Learning monocular dense depth from
        events", 3DV 2020, equation (1), and its program.
    """
    share = (depth_m / FARTHEST_M).clamp(max=1.0)
    return (1 + share.log() / LOG_RANGE).clamp(0.0, 1.0)


def decode_depth(code: Any) -> Any:
    """Metres of a network's output, a tensor or an array; undoes `encode_depth` in its range."""
    exponent = LOG_RANGE * (code - 1)
    return FARTHEST_M * 2.718281828459045**exponent


SCALES = (1, 2, 4, 8)
"""Sides of the squares over which differences are averaged before edges are sought, px."""
SOBEL_SUM = 8
"""Sum of the magnitudes of a Sobel kernel."""


def scale_invariant_loss(predicted: Tensor, target: Tensor, *, shift_weight: float) -> Tensor:
    """`mean(e²) − shift_weight · mean(e)²` of the differences e.

    Args:
        predicted: log depth, any shape.
        target: the same; NaN where it is not known.
        shift_weight: 1: a constant difference costs nothing, so that depth is learned up to a
            factor; 0: the mean squared error.

    Returns:
        A scalar; 0 where nothing is known.
    """
    error = _error(predicted, target)
    count = target.isfinite().sum().clamp(min=1)
    return (error**2).sum() / count - shift_weight * (error.sum() / count) ** 2


def gradient_loss(predicted: Tensor, target: Tensor) -> Tensor:
    """Mean magnitude of the differences' Sobel gradient, at four scales.

    Args:
        predicted: log depth, [n, 1, H, W]; both sides at least 8 px.
        target: the same; NaN where it is not known: there is no difference.

    Returns:
        A scalar: the sum over both directions, the mean over pixels, images and scales.

    Deviation: the program sums over the images of a batch, so that the weight of this loss depends
        on their number.
    """
    functional = require("torch", extra=EXTRA).nn.functional
    error = _error(predicted, target)
    row = error.new_tensor([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]]) / SOBEL_SUM
    kernels = row.new_empty(2, 1, 3, 3)
    kernels[0, 0], kernels[1, 0] = row, row.T
    total = error.new_zeros(())
    for side in SCALES:
        coarse = functional.pad(functional.avg_pool2d(error, side), (1, 1, 1, 1), mode="replicate")
        total = total + 2 * functional.conv2d(coarse, kernels).abs().mean()
    return total / len(SCALES)


def _error(predicted: Tensor, target: Tensor) -> Tensor:
    """Differences; 0 where the target is not known, so that no gradient is NaN."""
    known = target.isfinite()
    return (predicted - target.where(known, predicted.detach())).where(known, predicted * 0)


class DepthTask(TruthTask):
    """Loss of E2Depth, scored by the mean relative error of depth below 80 m."""

    score = Score("abs_rel", is_higher_better=False)
    target: ClassVar[Target] = "depth"
    errors = DepthError
    where_from = (
        "network.width must be that of the file; uzh-rpg/rpg_e2depth on GitHub links to the "
        "published one, E2DEPTH_si_grad_loss_mixed.pth.tar, which has 32"
    )

    def __init__(self, config: DepthConfig) -> None:
        """See `TruthTask`."""
        self._weights, self._width = config.loss, config.network.width
        super().__init__(config, config.data, bins=BINS, flips_x=config.flip_x)

    def make_network(self) -> Any:
        """See `Task`."""
        return make_e2depth(self._width, self._config.seed)

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """Mean over windows, each with all its images together, as in the program of E2Depth."""
        weights, depth = self._weights, batch[self.target].to(device)
        if not weights.sky:
            depth = depth.where(depth < FARTHEST_M, math.nan)
        target = encode_depth(depth)
        found = network(batch[GRIDS].to(device))
        total = found.new_zeros(())
        for one, true in zip(found.unbind(1), target.unbind(1), strict=True):
            total = total + scale_invariant_loss(one, true, shift_weight=weights.shift_weight)
            total = total + weights.gradient_weight * gradient_loss(one, true)
        return total / found.shape[1]

    def predict(self, network: Any, grids: Any) -> Any:
        """See `TruthTask`."""
        return decode_depth(network(grids[None]).float())[0]

    def published(self, network: Any) -> Mapping[str, Any]:
        """See `Task`; the program of E2Depth reads it too."""
        model = settings_of(self._width)
        return {
            "arch": ARCHITECTURE,
            "config": {"arch": ARCHITECTURE, "model": model},
            **super().published(network),
        }
