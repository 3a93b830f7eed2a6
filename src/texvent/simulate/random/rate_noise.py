"""Noise events of a Poisson process whose rate differs from pixel to pixel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import AUTO
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.arrivals import load_draw_arrivals
from texvent.simulate.random.draws import Purpose, draw_uniforms

Float64Array: TypeAlias = NDArray[np.float64]
Share: TypeAlias = Callable[[NDArray[np.int64]], Float64Array]
"""Given flat pixel indices [n], by how much each pixel's rate is lowered just now, 0..1, [n]."""


class NoiseRates:
    """How often every pixel of a sensor makes noise, at most."""

    def __init__(self, rate_hz: NDArray[np.floating[Any]], *, stream: int = 0) -> None:
        """Add up the rates along each row, once for all intervals.

        Args:
            rate_hz: events per second of each pixel, both polarities together, [H, W].
            stream: 0..65535: another one for each further process of the same sensor.
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
        share: Share | None = None,
        on_fraction: float | Float64Array = 0.5,
        backend: str = AUTO,
    ) -> UnsortedEvents:
        """Noise events of one interval, by exponential gaps between them.

        Their number per second does not depend on how time is cut into frames. The cost is that of
        the events, not of the pixels.

        Args:
            interval: where in time; its key decides the draws.
            share: what part of its rate each pixel has in this interval; all of it by default.
            on_fraction: probability of ON, one number or [H, W].
            backend: which kernels draw; all draw the same.

        Returns:
            Events labelled as noise, by pixel and then by time: Poisson in number, uniform in time.
        """
        if self.is_silent:
            return UnsortedEvents.none()
        pixel, fraction, order = load_draw_arrivals(backend)(
            self._cumulative_hz, interval.duration_s, interval.key, self._stream
        )
        row = pixel // self._cumulative_hz.shape[1]
        if share is not None:
            # Thinning: a Poisson process of which a part is kept at random is one again.
            chance = self._draw(interval, row, order, Purpose.NOISE_COUNT)
            kept = chance < share(pixel)
            pixel, fraction, order, row = pixel[kept], fraction[kept], order[kept], row[kept]
        if not isinstance(on_fraction, float):
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
