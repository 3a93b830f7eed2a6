"""Poisson noise whose rate differs from pixel to pixel, drawn by the gaps between events."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.simulation.kernels.compiled_elementary import natural_log
from texvent.simulation.packets import FrameInterval, UnsortedEvents, check_event_number
from texvent.simulation.random.compiled_draws import draw_uniform
from texvent.simulation.random.draws import Purpose

FIRST_DRAW, KEPT_DRAW, POLARITY_DRAW = (
    int(purpose.draw())
    for purpose in (Purpose.NOISE_TIME, Purpose.NOISE_COUNT, Purpose.NOISE_POLARITY)
)


class Arrivals(NamedTuple):
    """Arrivals in one interval, by pixel, then in time."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x."""
    fraction: NDArray[np.float64]
    """[n] when, as a share of the interval, 0 to below 1."""
    kept: NDArray[np.float64]
    """[n] uniform in [0, 1), to decide whether it happens at the present rate."""
    polarity: NDArray[np.float64]
    """[n] uniform in [0, 1), to decide its polarity."""


MOST_FRACTION = 1.0 - 2.0**-53
"""Largest fraction of an interval: the last float64 below 1."""
NEAR = 2
"""Pixels around a guess that are searched first."""
SPREAD = 6.0
"""There is room for the mean number of arrivals and so many standard deviations."""
GAPS = 16
"""Gaps drawn at a time."""


def draw_arrivals(
    cumulative_hz: NDArray[np.float64], duration_s: float, key: np.uint64, stream: int
) -> Arrivals:
    """Arrivals of a Poisson process of one rate per pixel.

    The rates of a row are laid end to end on one line. Exponential gaps, `−ln(1 − u) / duration`,
    give points on it: the stretch that a point falls on is its pixel, the place on the stretch is
    its time. So the draws are per arrival, not per pixel.

    Args:
        cumulative_hz: rate of each pixel plus those of its row before it, 1/s, [H, W].
        duration_s: length of the interval, s, above 0.
        key: of `draws.frame_key`.
        stream: 0..65535, a different one for each process of an interval.

    Returns:
        Poisson in number, uniform in time; independent between pixels and rows.
    """
    mean = float(cumulative_hz[:, -1].sum()) * duration_s
    room, source = int(mean + SPREAD * np.sqrt(mean)) + 16, (key, int(stream))
    while True:
        columns = Arrivals(np.empty(room, np.int64), *(np.empty(room) for _ in range(3)))
        found = _draw_arrivals(cumulative_hz, float(duration_s), source, columns)
        if found <= room:
            pixel, fraction, kept, polarity = columns
            return Arrivals(pixel[:found], fraction[:found], kept[:found], polarity[:found])
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
    pixel, fraction, kept, polarity = columns
    key, stream = source
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
            pixel[found] = y * width + x
            kept[found] = draw_uniform(key, y, stream, KEPT_DRAW + number)
            polarity[found] = draw_uniform(key, y, stream, POLARITY_DRAW + number)
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
    """First index ≥ `first` whose entry exceeds `value`; the last entry always does."""
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


Float64Array: TypeAlias = NDArray[np.float64]
RateFraction: TypeAlias = Callable[[NDArray[np.int64]], Float64Array]
"""Given flat pixel indices [n], the present rate of each as a fraction of its highest; [n]."""


class PoissonNoise:
    """Noise events of all pixels of a sensor, each with a highest rate of its own."""

    def __init__(self, rate_hz: NDArray[np.floating[Any]], *, stream: int = 0) -> None:
        """Add up the rates along each row, once for all intervals.

        Args:
            rate_hz: events per second of each pixel, both polarities together, [H, W].
            stream: 0..65535, a different one for each process of the same sensor.
        """
        self.cumulative_hz: Float64Array = np.cumsum(rate_hz, axis=1, dtype=np.float64)
        """Rate of each pixel plus those of its row before it, 1/s, [H, W]."""
        self.stream = stream
        """As given."""
        self.total_hz = float(self.cumulative_hz[:, -1].sum())
        """Events of all pixels, per second."""

    @property
    def is_silent(self) -> bool:
        """Whether no pixel ever makes noise."""
        return self.total_hz == 0

    def draw(
        self,
        interval: FrameInterval,
        *,
        rate_fraction: RateFraction | None = None,
        on_fraction: float | Float64Array = 0.5,
    ) -> UnsortedEvents:
        """Noise events of one interval, by exponential gaps between them.

        The rate of events does not depend on the frame rate, and the cost grows with the events,
        not with the pixels.

        Args:
            interval: where in time; its key decides the draws.
            rate_fraction: the present rates; by default the highest.
            on_fraction: probability of ON, one number or [H, W].

        Returns:
            Events labelled as noise, by pixel and then by time: Poisson in number, uniform in time.
        """
        if self.is_silent:
            return UnsortedEvents.none()
        check_event_number(self.total_hz * interval.duration_s)
        pixel, fraction, kept, polarity = draw_arrivals(
            self.cumulative_hz, interval.duration_s, interval.key, self.stream
        )
        if rate_fraction is not None:
            # Thinning: keeping events of a Poisson process at random gives one of a lower rate.
            stays = kept < rate_fraction(pixel)
            pixel, fraction, polarity = pixel[stays], fraction[stays], polarity[stays]
        if isinstance(on_fraction, np.ndarray):
            on_fraction = on_fraction.reshape(-1)[pixel]
        is_on = polarity < on_fraction
        offset = np.floor(fraction * interval.duration_us).astype(np.int64)
        return UnsortedEvents.noise(pixel, interval.start_us + offset, is_on.astype(np.uint8))
