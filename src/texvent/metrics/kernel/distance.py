"""Kernel distance: both streams smoothed by a Gaussian in time and space, then subtracted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric
from texvent.metrics.windows import Int64Array, bin_index, flat_index
from texvent.video import MICROSECONDS

REACH = 5.0
"""The kernel is cut off this many standard deviations away, where it is 4e-6."""


@dataclass(frozen=True, kw_only=True)
class KernelDistance(Metric):
    """`Σ(A − B)² / (ΣA² + ΣB²)` of counts in (2 ms, 1 px) bins, smoothed per polarity.

    Smoothing both with a Gaussian of sd s/√2 and summing products is the same as weighting pairs
    of events by a Gaussian of sd s, which is what is computed. NaN if both streams are empty.
    Time grows with the number of events and the square of `sd_px`, not with the sensor.

    Source: docs/metrics.md, after the asynchronous spatio-temporal spike metric of Li et al.
        (IEEE TPAMI 2021), with bins instead of continuous time.
    """

    name = "kernel"
    blind_to = "times inside a 2 ms bin"

    bin_us: int = 2_000
    """Length of a time bin, µs."""
    sd_us: int = 4_000
    """Standard deviation of the kernel in time, µs."""
    sd_px: float = 1.5
    """Standard deviation of the kernel in space, px."""

    def __post_init__(self) -> None:
        check_range("bin_us", self.bin_us, 1, 10**9)
        check_range("sd_us", self.sd_us, self.bin_us / 4, 10**9)
        check_range("sd_px", self.sd_px, 1e-3, 1e3)

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        from texvent.metrics.kernel.sums_cpu import sum_pairs  # brings Numba

        height, width = predicted.size.shape
        reach = min(int(np.ceil(REACH * self.sd_px)), max(height, width) - 1)
        most_bins = int(np.ceil(REACH * self.sd_us / self.bin_us))
        in_time = _gaussian(np.arange(most_bins + 1) * (self.bin_us / self.sd_us))
        in_space = _gaussian(np.arange(-reach, reach + 1) / self.sd_px)
        image = np.zeros((height + 2 * reach, width + 2 * reach, 2))
        sums = np.zeros((2, 2))
        for polarity in (0, 1):
            streams = [one[one.p == polarity] for one in (predicted, reference)]
            groups, places, counts = _cells(streams, Fraction(MICROSECONDS, self.bin_us))
            sums += sum_pairs(groups, places, counts, in_time, in_space, image)
        below = sums[0, 0] + sums[1, 1]
        above = below - sums[0, 1] - sums[1, 0]
        return float(min(max(above / below, 0.0), 1.0)) if below else UNDEFINED


def _gaussian(distance: NDArray[np.floating]) -> NDArray[np.float64]:
    return np.exp(-(distance**2) / 2).astype(np.float64)


def _cells(
    streams: Sequence[EventStream], rate: Fraction
) -> tuple[tuple[Int64Array, Int64Array], tuple[Int64Array, Int64Array], NDArray[np.float64]]:
    """The (bin, row, column) that hold events of either stream; see `sum_pairs`."""
    index = [bin_index(one.t, rate) for one in streams]
    bins = np.union1d(*index)
    height, width = streams[0].size.shape
    keys = [
        flat_index((np.searchsorted(bins, there), len(bins)), (one.y, height), (one.x, width))
        for one, there in zip(streams, index, strict=True)
    ]
    cells, cell = np.unique(np.concatenate(keys), return_inverse=True)
    counts = np.stack(
        [
            np.bincount(part, minlength=len(cells)).astype(np.float64)
            for part in np.split(cell, [len(keys[0])])
        ],
        axis=1,
    )
    rank, place = np.divmod(cells, height * width)
    starts = np.searchsorted(rank, np.arange(len(bins) + 1))
    rows, columns = np.divmod(place, width)
    return (bins, starts), (rows, columns), counts
