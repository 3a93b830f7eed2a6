"""Arrivals by gaps, compiled by Numba: row after row, the reference's bits."""

from __future__ import annotations

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.arrivals import FIRST_DRAW, Arrivals
from texvent.simulate.kernels.arrivals_reference import MOST_FRACTION
from texvent.simulate.kernels.cpu_draws import draw_uniform
from texvent.simulate.kernels.elementary_cpu import natural_log

Columns = tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]

NEAR = 2
"""How many pixels around a guess are looked at first."""


def draw_arrivals(
    cumulative_hz: NDArray[np.float64], duration_s: float, key: np.uint64, stream: int
) -> Arrivals:
    """Arrivals of a Poisson process; see `arrivals_reference.draw_arrivals`."""
    mean = float(cumulative_hz[:, -1].sum()) * duration_s
    room = int(mean + 6.0 * np.sqrt(mean)) + 16
    # With NUMBA_DISABLE_JIT=1 the hash runs in NumPy, which would warn of its wrap-around.
    with np.errstate(over="ignore"):
        return Arrivals(*_draw_arrivals(cumulative_hz, float(duration_s), key, int(stream), room))


def warm_up() -> None:
    """Compile, or load what was compiled before."""
    draw_arrivals(np.zeros((1, 1)), 1.0, np.uint64(0), 0)


@numba.njit(cache=True, nogil=True, error_model="numpy")
def _draw_arrivals(
    cumulative_hz: NDArray[np.float64], duration_s: float, key: np.uint64, stream: int, room: int
) -> Columns:
    height, width = cumulative_hz.shape
    columns = np.empty(room, np.int64), np.empty(room), np.empty(room, np.int64)
    per_s = 1.0 / duration_s
    found = 0
    for y in range(height):
        place, order, x = 0.0, 0, 0
        total = cumulative_hz[y, width - 1]
        per_hz = width / total if total > 0 else 0.0
        while True:
            chance = draw_uniform(key, y, stream, FIRST_DRAW + order)
            place += -natural_log(1.0 - chance) * per_s
            if place >= total:
                break
            x = _first_above(cumulative_hz[y], place, x, int(place * per_hz))
            start = cumulative_hz[y, x - 1] if x > 0 else 0.0
            fraction = (place - start) / (cumulative_hz[y, x] - start)
            if found == columns[0].size:
                columns = _grown(columns)
            columns[0][found] = y * width + x
            columns[1][found] = min(fraction, MOST_FRACTION)
            columns[2][found] = order
            found += 1
            order += 1
    return columns[0][:found], columns[1][:found], columns[2][:found]


@numba.njit(cache=True, nogil=True)
def _first_above(ascending: NDArray[np.float64], value: float, first: int, guess: int) -> int:
    """The first index, from `first` on, whose entry is above a value; the last one's is."""
    last = ascending.size - 1
    # Where all pixels have about the same rate, the guess is off by a few at most.
    low, high = min(guess - NEAR, last), min(guess + NEAR, last)
    if low >= first and ascending[low] <= value:
        first = low + 1
    if high >= first and ascending[high] > value:
        last = high
    while first < last:
        middle = (first + last) // 2
        if ascending[middle] > value:
            last = middle
        else:
            first = middle + 1
    return first


@numba.njit(cache=True, nogil=True)
def _grown(columns: Columns) -> Columns:
    """The same columns with room for as many arrivals again."""
    size = columns[0].size
    pixel, fraction, order = (
        np.empty(2 * size, np.int64),
        np.empty(2 * size),
        np.empty(2 * size, np.int64),
    )
    pixel[:size], fraction[:size], order[:size] = columns
    return pixel, fraction, order
