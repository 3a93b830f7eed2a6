"""The loss of a sequence of images: closeness to the true ones, and consistency in time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from texvent.metrics.image_measures import RADIUS_PX
from texvent.metrics.lpips import Lpips, LpipsWeights
from texvent.networks.weight_files import Tensor
from texvent_lab.train.reconstruction.config import ReconstructionLoss
from texvent_lab.train.reconstruction.image_losses import dissimilarity, inconsistency, l1

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
        """Of images that can be compared, px."""
        window = 2 * RADIUS_PX + 1 if self._options.ssim else 1
        return window if self._lpips is None else max(window, self._lpips.least_side)

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
