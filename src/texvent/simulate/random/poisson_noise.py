"""Noise events of a Poisson process whose rate differs from pixel to pixel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import AUTO
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.limits import check_event_number
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import Purpose, draw_uniforms
from texvent.simulate.random.poisson_arrivals import DRAW_ARRIVALS

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
        self._cumulative_hz: Float64Array = np.cumsum(rate_hz, axis=1, dtype=np.float64)
        self._stream = stream

    @property
    def is_silent(self) -> bool:
        """Whether no pixel ever makes noise."""
        return not self._cumulative_hz[:, -1].any()

    def draw(
        self,
        interval: FrameInterval,
        *,
        rate_fraction: RateFraction | None = None,
        on_fraction: float | Float64Array = 0.5,
        backend: str = AUTO,
    ) -> UnsortedEvents:
        """Noise events of one interval, by exponential gaps between them.

        The rate of events does not depend on the frame rate, and the cost grows with the events,
        not with the pixels.

        Args:
            interval: where in time; its key decides the draws.
            rate_fraction: the present rates; by default the highest.
            on_fraction: probability of ON, one number or [H, W].
            backend: which kernels draw; all draw the same.

        Returns:
            Events labelled as noise, by pixel and then by time: Poisson in number, uniform in time.
        """
        if self.is_silent:
            return UnsortedEvents.none()
        check_event_number(float(self._cumulative_hz[:, -1].sum()) * interval.duration_s)
        pixel, fraction, order = DRAW_ARRIVALS.load(backend)(
            self._cumulative_hz, interval.duration_s, interval.key, self._stream
        )
        row = pixel // self._cumulative_hz.shape[1]
        if rate_fraction is not None:
            # Thinning: keeping events of a Poisson process at random gives one of a lower rate.
            chance = self._draw(interval, row, order, Purpose.NOISE_COUNT)
            kept = chance < rate_fraction(pixel)
            pixel, fraction, order, row = pixel[kept], fraction[kept], order[kept], row[kept]
        if isinstance(on_fraction, np.ndarray):
            on_fraction = on_fraction.reshape(-1)[pixel]
        is_on = self._draw(interval, row, order, Purpose.NOISE_POLARITY) < on_fraction
        offset = np.floor(fraction * interval.duration_us).astype(np.int64)
        return UnsortedEvents.noise(pixel, interval.start_us + offset, is_on.astype(np.uint8))

    def _draw(
        self,
        interval: FrameInterval,
        row: NDArray[np.int64],
        order: NDArray[np.int64],
        purpose: Purpose,
    ) -> Float64Array:
        return draw_uniforms(interval.key, row, self._stream, purpose.draw(order))
