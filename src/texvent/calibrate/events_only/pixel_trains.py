"""Events pixel by pixel: which follow one another at a pixel, and after how long."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

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
