"""Voxel L1: signed counts in a few time bins per frame."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.windows import bin_index, flat_index


@dataclass(frozen=True, kw_only=True)
class VoxelDifference(Metric):
    """`Σ|a − b| / (Σ|a| + Σ|b|)` of signed counts in `bins` equal bins per frame and pixel.

    NaN if every voxel of both is 0.
    """

    name = "voxel"
    blind_to = "ON and OFF that cancel in a bin; times inside a bin"

    fps: Fraction = Fraction(24)
    """Frames per second; a frame begins at multiples of 1/fps."""
    bins: int = 5
    """Bins per frame."""

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        index = np.concatenate([self._voxel_index(predicted), self._voxel_index(reference)])
        # Only occupied voxels are kept: recordings are sparse and may be long.
        _, voxel = np.unique(index, return_inverse=True)
        a = _sum_polarity(voxel[: len(predicted)], predicted, voxel.size)
        b = _sum_polarity(voxel[len(predicted) :], reference, voxel.size)
        total = np.abs(a).sum() + np.abs(b).sum()
        return float(np.abs(a - b).sum() / total) if total else UNDEFINED

    def _voxel_index(self, events: EventStream) -> NDArray[np.int64]:
        width, height = events.size
        time_bin = bin_index(events.t, self.fps * self.bins)
        return flat_index((time_bin, 1), (events.y, height), (events.x, width))


def _sum_polarity(voxel: NDArray[np.int64], events: EventStream, count: int) -> NDArray[np.float64]:
    weights = events.polarity.astype(np.float64)
    return np.bincount(voxel, weights=weights, minlength=count).astype(np.float64)
