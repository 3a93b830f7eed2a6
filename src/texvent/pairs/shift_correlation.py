"""Correlation of two images at every shift: distinguishes a whip pan from a scene cut."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array

DETAIL_CELLS = 5
"""Detail is the image minus its mean over this many cells: two skies that only share a gradient do
not agree."""
LEAST_OVERLAP = 0.35
"""Share of the image that must overlap for a shift to count."""
LEAST_VARIANCE = 1e-4
"""Variance of log brightness below which agreement means nothing."""


def shift_agreement(first: Float64Array, second: Float64Array) -> float:
    """Agreement of the detail of two images at the best shift.

    Args:
        first: log brightness, [H, W]; a thumbnail, because all shifts are tried.
        second: the same shape.

    Returns:
        Correlation over the overlap, at the shift where it is largest, −1..1. On thumbnails of
        real clips, 300 pairs of unrelated images reached 0.33 at most, and pairs shifted by a
        tenth to half of the width 0.80 at least.
    """
    return float(correlate_shifts(detail(first), detail(second), LEAST_VARIANCE).max())


def correlate_shifts(one: Float64Array, other: Float64Array, least_variance: float) -> Float64Array:
    """The correlation of two images over their overlap, at every shift.

    Args:
        one: [H, W].
        other: the same shape.
        least_variance: smaller variances count as this.

    Returns:
        [2 m + 1, 2 n + 1], −1..1, for shifts by −m..m rows and −n..n columns: in the middle for
        the images as they are, a row further down where `other` shows everything a row further
        down; −1 where too little overlaps.

    Source: masked normalised correlation, Padfield 2012.
    """
    shape = tuple(2 * side for side in one.shape)  # room for every shift without wrapping around
    product = np.fft.irfft2(np.fft.rfft2(other, shape) * np.conj(np.fft.rfft2(one, shape)), shape)
    most = [int((1.0 - LEAST_OVERLAP) * side) for side in one.shape]
    down, across = (np.arange(-m, m + 1) for m in most)
    product = product[np.ix_(down, across)]  # negative shifts are at the end
    # What overlaps is a rectangle at a corner of each image.
    height, width = one.shape
    rows, columns = _overlap(-down, height), _overlap(-across, width)
    other_rows, other_columns = _overlap(down, height), _overlap(across, width)
    count = np.outer(rows[1] - rows[0], columns[1] - columns[0])
    number = np.maximum(count, 1)
    sum_a, sum_b = _sums(one, rows, columns), _sums(other, other_rows, other_columns)
    covariance = product - sum_a * sum_b / number
    spread_a = _sums(one**2, rows, columns) - sum_a**2 / number
    spread_b = _sums(other**2, other_rows, other_columns) - sum_b**2 / number
    floor = number * least_variance
    agreement = covariance / np.sqrt(np.maximum(spread_a, floor) * np.maximum(spread_b, floor))
    return np.where(count >= LEAST_OVERLAP * one.size, agreement, -1.0)


def _overlap(shift: NDArray[np.intp], size: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """First cell, and the one past the last, of what overlaps along a side."""
    return np.maximum(shift, 0), np.minimum(shift, 0) + size


def _sums(
    image: Float64Array,
    rows: tuple[NDArray[np.intp], NDArray[np.intp]],
    columns: tuple[NDArray[np.intp], NDArray[np.intp]],
) -> Float64Array:
    """Sums over rectangles: of each range of rows, and of columns."""
    total = np.pad(image.cumsum(axis=0), ((1, 0), (0, 0)))
    bands = np.pad((total[rows[1]] - total[rows[0]]).cumsum(axis=1), ((0, 0), (1, 0)))
    return np.asarray(bands[:, columns[1]] - bands[:, columns[0]])


def detail(image: Float64Array) -> Float64Array:
    """The image minus its mean over `DETAIL_CELLS` cells."""
    margin, (height, width) = DETAIL_CELLS // 2, image.shape
    padded = np.pad(image, margin, mode="edge")
    rows, total = np.zeros((height, width + 2 * margin)), np.zeros((height, width))
    for k in range(DETAIL_CELLS):
        rows += padded[k : k + height]
    for k in range(DETAIL_CELLS):
        total += rows[:, k : k + width]
    return np.asarray(image - total / DETAIL_CELLS**2)
