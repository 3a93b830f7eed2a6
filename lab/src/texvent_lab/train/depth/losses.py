"""What E2Depth is trained on: differences of log depth, whatever their mean, and their edges.

Source: J. Hidalgo-Carrió, D. Gehrig, D. Scaramuzza, "Learning monocular dense depth from events",
3DV 2020, equations (2) and (3), and its program.
"""

from __future__ import annotations

from texvent.extending import require
from texvent.networks.weight_files import Tensor
from texvent_lab.train.schedule import EXTRA

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
