"""What most measures of a video are taken on: luma, and its means over square blocks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.instants import matching_luma
from texvent.video import Frame

GRID = 64
"""Blocks along the longer side."""
SAMPLED_EVERY = 4
"""Measures of single images are taken on every so manieth frame; those of time on all."""
FLAT_VARIANCE = 0.02
"""Variance in levels² below which an image is flat."""


@dataclass(frozen=True, eq=False)
class SeenFrame:
    """A frame with what every measure needs of it."""

    frame: Frame
    index: int
    """0 for the first frame."""
    luma: NDArray[np.float32]
    """[H, W], 0..255 scale; gamma-coded, also of frames that are linear light."""
    means: NDArray[np.float32]
    """Means of its blocks; see `block_means`."""

    @classmethod
    def of(cls, frame: Frame, index: int) -> SeenFrame:
        """The frame with its luma and block means."""
        luma = np.asarray(matching_luma(frame), dtype=np.float32)
        return cls(frame, index, luma, block_means(luma))

    @property
    def is_sampled(self) -> bool:
        """Whether measures of single images are taken of it."""
        return self.index % SAMPLED_EVERY == 0


def block_means(luma: NDArray[np.float32]) -> NDArray[np.float32]:
    """Means of square blocks, at most about `GRID` along a side; incomplete blocks are left out."""
    side = max(1, max(luma.shape) // GRID)
    side = min(side, *luma.shape)
    rows, columns = (length // side for length in luma.shape)
    # Rows first: whole rows add up faster than the cells of a row.
    strips = luma[: rows * side, : columns * side].reshape(rows, side, columns * side).sum(axis=1)
    cells: NDArray[np.float32] = strips.reshape(rows, columns, side).sum(axis=2)
    return np.asarray(cells / np.float32(side**2), dtype=np.float32)


def neighbour_correlation(luma: NDArray[np.float32]) -> float:
    """Correlation of pixels with their right and lower neighbours; 1 for a flat image."""
    centred = luma - luma.mean()
    variance = float((centred * centred).mean())
    if variance < FLAT_VARIANCE:
        return 1.0
    right = float((centred[:, 1:] * centred[:, :-1]).mean()) if luma.shape[1] > 1 else variance
    below = float((centred[1:] * centred[:-1]).mean()) if luma.shape[0] > 1 else variance
    return (right + below) / (2 * variance)


def percentile_of_counts(counts: NDArray[Any], percent: float) -> float:
    """Bin in which a percentile of binned values lies: the first that holds that share.

    Args:
        counts: how many values each bin holds, [n]; not all 0.
        percent: 0..100.

    Example:
        >>> percentile_of_counts(np.array([1, 0, 3]), 50)
        2.0
    """
    return float(np.searchsorted(np.cumsum(counts), counts.sum() * percent / 100))
