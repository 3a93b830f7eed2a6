"""Poisson arrivals by gaps, compiled by Numba: row after row, the reference's bits."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulate.backend.elementary_cpu import natural_log
from texvent.simulate.random.draws_cpu import allow_wrap_around, draw_uniform
from texvent.simulate.random.poisson_arrivals import FIRST_DRAW, Arrivals
from texvent.simulate.random.poisson_arrivals_reference import MOST_FRACTION

NEAR = 2
"""How many pixels around a guess are looked at first."""
SPREAD = 6.0
"""There is room for the mean number of arrivals and so many standard deviations."""
GAPS = 16
"""How many gaps are drawn at a time."""


def draw_arrivals(
    cumulative_hz: NDArray[np.float64], duration_s: float, key: np.uint64, stream: int
) -> Arrivals:
    """Arrivals of a Poisson process; see `poisson_arrivals_reference.draw_arrivals`."""
    mean = float(cumulative_hz[:, -1].sum()) * duration_s
    room, source = int(mean + SPREAD * np.sqrt(mean)) + 16, (key, int(stream))
    while True:
        columns = Arrivals(np.empty(room, np.int64), np.empty(room), np.empty(room, np.int64))
        with allow_wrap_around():
            found = _draw_arrivals(cumulative_hz, float(duration_s), source, columns)
        if found <= room:
            pixel, fraction, order = columns
            return Arrivals(pixel[:found], fraction[:found], order[:found])
        room *= 2


@jit(error_model="numpy")
def _draw_arrivals(
    cumulative_hz: NDArray[np.float64],
    duration_s: float,
    source: tuple[np.uint64, int],
    columns: Arrivals,
) -> int:
    """Fill in the columns; how many arrivals there are, or more than there is room for."""
    # Arrays are taken out of tuples once: counting references for each arrival is slow.
    pixel, fraction, order = columns
    height, width = cumulative_hz.shape
    per_s, found = 1.0 / duration_s, 0
    gap = np.empty(GAPS)
    for y in range(height):
        place, number, x = 0.0, 0, 0
        total = cumulative_hz[y, width - 1]
        per_hz = width / total if total > 0 else 0.0
        while True:
            if number % GAPS == 0:
                _draw_gaps(source, y, number, per_s, gap)
            place += gap[number % GAPS]
            if place >= total:
                break
            if found == pixel.size:
                return found + 1
            x = _first_above(cumulative_hz, y, place, x, int(place * per_hz))
            start = cumulative_hz[y, x - 1] if x > 0 else 0.0
            pixel[found], order[found] = y * width + x, number
            fraction[found] = min((place - start) / (cumulative_hz[y, x] - start), MOST_FRACTION)
            found += 1
            number += 1
    return found


@jit(error_model="numpy")
def _draw_gaps(
    source: tuple[np.uint64, int], y: int, number: int, per_s: float, gap: NDArray[np.float64]
) -> None:
    """Fill in a row's gaps from one number on, in vector registers; some will not be needed."""
    key, stream = source
    for j in range(gap.size):
        chance = draw_uniform(key, y, stream, FIRST_DRAW + number + j)
        gap[j] = -natural_log(1.0 - chance) * per_s


@jit
def _first_above(
    cumulative_hz: NDArray[np.float64], y: int, value: float, first: int, guess: int
) -> int:
    """The first index in a row, from `first` on, whose entry is above a value: the last's is."""
    last = cumulative_hz.shape[1] - 1
    # Where all pixels have about the same rate, the guess is off by a few at most.
    low, high = min(guess - NEAR, last), min(guess + NEAR, last)
    if low >= first and cumulative_hz[y, low] <= value:
        first = low + 1
    if high >= first and cumulative_hz[y, high] > value:
        last = high
    while first < last:
        middle = (first + last) // 2
        if cumulative_hz[y, middle] > value:
            last = middle
        else:
            first = middle + 1
    return first
