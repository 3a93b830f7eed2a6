"""Brightness and structure of a video's images: dark, saturated, noise, and what changes at all."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.transfer import Transfer
from texvent.video_check.blocks import SeenFrame, neighbour_correlation, percentile_of_counts

BINS_PER_LEVEL = 16
BINS = 256 * BINS_PER_LEVEL


class ImageLevels:
    """Takes levels of blocks over the whole clip, in counts and extremes: memory stays flat."""

    def __init__(self) -> None:
        self._counts: NDArray[np.int64] = np.zeros(BINS, np.int64)
        self._lowest: NDArray[np.float32] | None = None
        self._highest: NDArray[np.float32] | None = None
        self._correlations: list[float] = []
        self._may_clip = True

    def add(self, seen: SeenFrame) -> None:
        """Take one frame."""
        bins = np.clip(seen.means * BINS_PER_LEVEL, 0, BINS - 1).astype(np.int64)
        self._counts += np.bincount(bins.ravel(), minlength=BINS)
        if self._lowest is None or self._highest is None:
            self._lowest = self._highest = seen.means
        self._lowest = np.minimum(self._lowest, seen.means)
        self._highest = np.maximum(self._highest, seen.means)
        self._may_clip &= seen.frame.transfer is Transfer.GAMMA
        if seen.is_sampled:
            self._correlations.append(neighbour_correlation(seen.luma))

    def measures(self) -> dict[str, float]:
        """By name.

        Returns:
            `motion`: 99th percentile over blocks of their range over time, levels. `dark_end` and
            `bright_end`: 5th and 95th percentile of all blocks of all frames, in levels, to 1/16.
            Linear light has no `dark_end`: nothing clips it.
            `correlation`: of neighbouring pixels, median over frames.
        """
        if self._lowest is None or self._highest is None:
            return {"motion": 0.0, "dark_end": 0.0, "bright_end": 0.0, "correlation": 1.0}
        dark_end = percentile_of_counts(self._counts, 5) / BINS_PER_LEVEL
        return {
            "motion": float(np.percentile(self._highest - self._lowest, 99)),
            **({"dark_end": dark_end} if self._may_clip else {}),
            "bright_end": percentile_of_counts(self._counts, 95) / BINS_PER_LEVEL,
            "correlation": float(np.median(self._correlations)),
        }
