"""Events by pixel: their order, intervals and dead time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.calibrate.estimates import Estimate
from texvent.events import EventStream
from texvent.sensor import SensorSize

Int64Array: TypeAlias = NDArray[np.int64]
BoolArray: TypeAlias = NDArray[np.bool_]
Float64Array: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class PixelTrains:
    """Events ordered by pixel, then by time, ON and OFF together."""

    size: SensorSize
    pixel: Int64Array
    """[n] y · W + x, ascending."""
    t: Int64Array
    """[n] µs, ascending within a pixel."""
    is_on: BoolArray
    """[n]."""

    @classmethod
    def of(cls, events: EventStream) -> PixelTrains:
        """The trains of a stream."""
        pixel = events.y.astype(np.int64) * events.size.width + events.x
        order = np.argsort(pixel, kind="stable")
        return cls(events.size, pixel[order], events.t[order], events.p[order] == 1)

    def at(self, chosen: BoolArray) -> PixelTrains:
        """The trains of some pixels, chosen by [H · W]."""
        kept = chosen[self.pixel]
        return PixelTrains(self.size, self.pixel[kept], self.t[kept], self.is_on[kept])

    def waits_us(self) -> Float64Array:
        """Time since the event before at the same pixel, µs; NaN for a pixel's first, [n]."""
        waits = np.full(len(self.t), np.nan)
        waits[1:] = np.where(np.diff(self.pixel) == 0, np.diff(self.t), np.nan)
        return waits

    def counts(self) -> Int64Array:
        """OFF and ON events of every pixel, [2, H · W]."""
        number = self.size.width * self.size.height
        on = np.bincount(self.pixel[self.is_on], minlength=number)
        return np.stack([np.bincount(self.pixel, minlength=number) - on, on])


SHORTEST = 50
"""Intervals at the lower end that are looked at."""
PRECISION = 0.2
"""Part of the dead time that the gap above it may be uncertain by."""


def find_dead_time(waits_us: Float64Array) -> Estimate | str:
    """The dead time of pixels that fire at random.

    Random events fill the intervals from the dead time on evenly. With the 50 shortest intervals
    over a range, the next one below the shortest would be 1/49 of the range away.

    Args:
        waits_us: inter-event intervals of pixels, both polarities together, µs; NaN is left out.

    Returns:
        The constant `refractory_period_us`, or why there is none.

    Example:
        >>> str(find_dead_time(300.0 + np.arange(1, 61)))
        'refractory_period_us 300 µs (95 %: 298 to 301)'
    """
    waits = waits_us[np.isfinite(waits_us)]
    if waits.size < SHORTEST:
        return f"{waits.size} intervals; {SHORTEST} are needed"
    shortest = np.sort(np.partition(waits, SHORTEST - 1)[:SHORTEST])
    gap = float(shortest[-1] - shortest[0]) / (SHORTEST - 1)
    low, high = float(shortest[0]) - 3 * gap, float(shortest[0])
    if 3 * gap > PRECISION * high:
        return f"intervals near it are too rare; it is at most {high:.0f} µs"
    return Estimate("refractory_period_us", high - gap, low, high, "µs")
