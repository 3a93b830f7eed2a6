"""Sums over pairs of occupied cells, weighted by a Gaussian of their distance; compiled.

Work and memory follow the events, not the sensor: per bin the cells around it in time are added to
one image, which is read around the cells of that bin and cleared again.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit

Float64Array = NDArray[np.float64]
Int64Array = NDArray[np.int64]


@jit
def sum_pairs(
    groups: tuple[Int64Array, Int64Array],
    places: tuple[Int64Array, Int64Array],
    counts: Float64Array,
    in_time: Float64Array,
    in_space: Float64Array,
    image: Float64Array,
) -> Float64Array:
    """`Σ_ij m_i n_j K_ij` for (m, n) of (a, a), (a, b), (b, a), (b, b), [2, 2].

    Args:
        groups: the bins that hold cells, ascending [g]; where each begins in the cells, [g + 1].
        places: row and column of each cell, [n].
        counts: events of both streams in each cell, [n, 2].
        in_time: weight of a distance of 0, 1, ... bins.
        in_space: weight of a distance of -reach .. reach cells along one axis, [2 · reach + 1].
        image: zeros, [H + 2 · reach, W + 2 · reach, 2]; zeros again afterwards.
    """
    bins, starts = groups
    rows, columns = places
    span, width = len(in_time) - 1, len(in_space)
    reach = width // 2
    sums = np.zeros((2, 2))
    low = high = 0
    for here in range(len(bins)):
        while bins[here] - bins[low] > span:
            low += 1
        while high < len(bins) and bins[high] - bins[here] <= span:
            high += 1
        for there in range(low, high):
            weight = in_time[abs(bins[there] - bins[here])]
            for cell in range(starts[there], starts[there + 1]):
                row, column = rows[cell] + reach, columns[cell] + reach
                image[row, column, 0] += weight * counts[cell, 0]
                image[row, column, 1] += weight * counts[cell, 1]
        for cell in range(starts[here], starts[here + 1]):
            first, second = _read_around(rows[cell], columns[cell], in_space, image)
            for stream in range(2):
                sums[stream, 0] += counts[cell, stream] * first
                sums[stream, 1] += counts[cell, stream] * second
        for cell in range(starts[low], starts[high]):
            image[rows[cell] + reach, columns[cell] + reach, :] = 0.0
    return sums


@jit(inner=True)
def _read_around(
    row: int, column: int, in_space: Float64Array, image: Float64Array
) -> tuple[float, float]:
    """The image around a cell, weighted by distance, of both streams."""
    first = second = 0.0
    for down, weight_down in enumerate(in_space):
        along_a = along_b = 0.0
        for across, weight in enumerate(in_space):
            along_a += weight * image[row + down, column + across, 0]
            along_b += weight * image[row + down, column + across, 1]
        first += weight_down * along_a
        second += weight_down * along_b
    return first, second
