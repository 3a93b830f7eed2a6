"""Losses of reconstructed sequences."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from texvent.extending import require
from texvent.metrics.image_measures import CONTRAST, LUMINANCE, RADIUS_PX, gaussian_window
from texvent.metrics.lpips import LEAST_SIDE, Lpips, LpipsWeights
from texvent.networks import Tensor
from texvent_lab.train.reconstruction.config import ReconstructionLoss
from texvent_lab.train.schedule import EXTRA

LEAST_SUM = 1e-5
"""Added to what the difference of two images is divided by."""


def l1(images: Tensor, true: Tensor) -> Tensor:
    """Mean absolute difference of each pair of images, [n] from [n, 1, H, W]."""
    return (images - true).abs().mean(dim=(1, 2, 3))


def dissimilarity(images: Tensor, true: Tensor) -> Tensor:
    """1 − SSIM of each pair of images, [n] from [n, 1, H, W]."""
    return 1 - ssim(images, true)


def ssim(a: Tensor, b: Tensor) -> Tensor:
    """See `texvent.metrics.image_measures.structural_similarity`.

    Args:
        a: [n, 1, H, W], 0..1, sides of 11 px or more.
        b: alike.

    Returns:
        Of each pair, [n].
    """
    means = _smooth([a, b, a * a, b * b, a * b])
    mean_a, mean_b, square_a, square_b, product = means
    variance = square_a - mean_a**2 + square_b - mean_b**2
    covariance = product - mean_a * mean_b
    c1, c2 = LUMINANCE**2, CONTRAST**2
    similarity = (2 * mean_a * mean_b + c1) * (2 * covariance + c2)
    return (similarity / ((mean_a**2 + mean_b**2 + c1) * (variance + c2))).mean(dim=(1, 2, 3))


def _smooth(images: list[Tensor]) -> list[Tensor]:
    """Gaussian-weighted mean around every pixel that is far enough from the border."""
    torch = require("torch", extra=EXTRA)
    weights = torch.as_tensor(gaussian_window().astype(np.float32), device=images[0].device)
    joined = torch.cat(images)
    # Variances are small differences of squares: never in the narrow numbers of mixed precision.
    with torch.autocast(joined.device.type, enabled=False):
        for kernel in (weights[None, None, None], weights[None, None, :, None]):
            joined = torch.nn.functional.conv2d(joined, kernel.to(joined.dtype))
    return list(joined.chunk(len(images)))


def inconsistency(
    images: tuple[Tensor, Tensor], true: tuple[Tensor, Tensor], flow: Tensor, *, alpha: float
) -> Tensor:
    """Difference of two images in succession where they show the same.

    The later image is looked up where each pixel of the earlier one has moved. The difference,
    divided by the sum of both, counts less where the true images differ there too, and not at all
    where the flow is not known or leaves the image.

    Args:
        images: the earlier and the later one, [n, 1, H, W].
        true: alike, 0..1.
        flow: displacement (x, y) of what each pixel of the earlier image shows, px, [n, 2, H, W];
            NaN where it is not known.
        alpha: see `ReconstructionLoss.consistency_alpha`.

    Returns:
        Of each pair, the mean over all pixels, [n].

    Source: W.-S. Lai et al., "Learning blind video temporal consistency", ECCV 2018; with this
        difference, the program of T. Stoffregen et al., "Reducing the sim-to-real gap for event
        cameras", ECCV 2020.
    """
    torch = require("torch", extra=EXTRA)
    height, width = flow.shape[-2:]
    y, x = torch.meshgrid(
        torch.arange(height, device=flow.device),
        torch.arange(width, device=flow.device),
        indexing="ij",
    )
    place = torch.stack([x, y]) + flow
    limits = torch.tensor([width - 1, height - 1], device=flow.device)[:, None, None]
    # A comparison with NaN is false.
    is_known = ((place >= 0) & (place <= limits)).all(dim=1, keepdim=True)
    grid = (2 * place / limits.clamp(min=1) - 1).nan_to_num(0).movedim(1, -1)
    both = torch.cat([images[1], true[1]], dim=1)
    later, true_later = torch.nn.functional.grid_sample(
        both, grid.to(both.dtype), padding_mode="border", align_corners=True
    ).split(1, dim=1)
    weight = torch.exp(-alpha * (true_later - true[0]) ** 2) * is_known
    error = (later - images[0]).abs() / (later.abs() + images[0].abs() + LEAST_SUM)
    return (weight * error).mean(dim=(1, 2, 3))


Comparison: TypeAlias = Callable[[Tensor, Tensor], Tensor]
"""Images and true images, [n, 1, H, W], to [n]."""


class SequenceLoss:
    """The sum that `ReconstructionLoss` describes."""

    def __init__(self, options: ReconstructionLoss, weights: LpipsWeights | None) -> None:
        """Choose the parts that have a weight.

        Args:
            options: weights of the parts.
            weights: those of LPIPS; None: it has no part.
        """
        self._options = options
        self._lpips = None if weights is None else Lpips(weights)
        parts: list[tuple[float, Comparison]] = [
            (options.l1, l1),
            (options.ssim, dissimilarity),
        ]
        if self._lpips is not None:
            parts.append((options.lpips, self._lpips))
        self._parts = [(weight, compare) for weight, compare in parts if weight]

    @property
    def least_side(self) -> int:
        """Shortest side of images that can be compared, px."""
        window = 2 * RADIUS_PX + 1 if self._options.ssim else 1
        return window if self._lpips is None else max(window, LEAST_SIDE)

    def to(self, device: Any) -> SequenceLoss:
        """Move the weights of LPIPS."""
        if self._lpips is not None:
            self._lpips.to(device)
        return self

    def __call__(self, images: Tensor, true: Tensor, flow: Tensor | None) -> Tensor:
        """The loss, a scalar.

        Args:
            images: [n, windows, 1, H, W], roughly 0..1.
            true: alike, 0..1.
            flow: over each window, px, [n, windows, 2, H, W]; None: no consistency.
        """
        loss: Tensor = 0
        for weight, compare in self._parts:
            loss = loss + weight * compare(images.flatten(0, 1), true.flatten(0, 1)).mean()
        if flow is None:
            return loss
        options = self._options
        later, before = (
            slice(options.consistency_from, None),
            slice(options.consistency_from - 1, -1),
        )
        pairs = [
            (one[:, before].flatten(0, 1), one[:, later].flatten(0, 1)) for one in (images, true)
        ]
        change = inconsistency(
            pairs[0], pairs[1], flow[:, later].flatten(0, 1), alpha=options.consistency_alpha
        )
        return loss + options.consistency * change.sum() / true[:, :, 0, 0, 0].numel()
