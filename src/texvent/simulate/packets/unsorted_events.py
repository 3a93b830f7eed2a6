"""What a pixel model hands over for one frame interval, and how it becomes a packet."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE, SIGNAL, EventStream
from texvent.sensor import SensorSize
from texvent.simulate.backend.select import AUTO
from texvent.simulate.packets.order import Columns, Unordered, load_order_events


class Interval(NamedTuple):
    """The time between two neighbouring frames, `[start_us, stop_us)`."""

    start_us: int
    """Time of the earlier frame, µs (included)."""
    stop_us: int
    """Time of the later frame, µs (excluded)."""
    key: np.uint64
    """Key of the random draws of this interval; see `draws.frame_key`."""

    @property
    def duration_us(self) -> int:
        """Length, µs."""
        return self.stop_us - self.start_us

    @property
    def duration_s(self) -> float:
        """Length, seconds."""
        return self.duration_us * 1e-6


class Firings(NamedTuple):
    """Events of one interval, a row per event, in any order."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x."""
    t: NDArray[np.int64]
    """[n] times, µs, all in the interval."""
    p: NDArray[np.uint8]
    """[n] 1 = ON, 0 = OFF."""
    label: NDArray[np.uint8]
    """[n] `events.SIGNAL` or `events.NOISE`."""

    @classmethod
    def none(cls) -> Firings:
        """No event."""
        nothing = np.empty(0, np.int64)
        return cls.signal(nothing, nothing, nothing.astype(np.uint8))

    @classmethod
    def signal(
        cls, pixel: NDArray[np.int64], t: NDArray[np.int64], p: NDArray[np.uint8]
    ) -> Firings:
        """Events that a brightness change fired."""
        return cls(pixel, t, p, np.full(len(pixel), SIGNAL, np.uint8))

    @classmethod
    def noise(cls, pixel: NDArray[np.int64], t: NDArray[np.int64], p: NDArray[np.uint8]) -> Firings:
        """Events that noise fired."""
        return cls(pixel, t, p, np.full(len(pixel), NOISE, np.uint8))

    @classmethod
    def of(cls, columns: Columns, width: int) -> Firings:
        """Events of a packet; `width` of the sensor, pixels."""
        x, y, t, p, label = columns
        return cls(y.astype(np.int64) * width + x, t, p, label)

    def joined(self, other: Firings) -> Firings:
        """These events and `other`, unsorted."""
        return Firings(
            np.concatenate([self.pixel, other.pixel]),
            np.concatenate([self.t, other.t]),
            np.concatenate([self.p, other.p]),
            np.concatenate([self.label, other.label]),
        )

    def where(self, is_kept: NDArray[np.bool_]) -> Firings:
        """Those of the events for which a mask [n] is true."""
        pixel, t, p, label = self
        return Firings(pixel[is_kept], t[is_kept], p[is_kept], label[is_kept])

    def packet(self, interval: Interval, size: SensorSize, backend: str = AUTO) -> EventStream:
        """The events in the order every packet has: by (t, y, x, p), labels included."""
        span_us = (interval.start_us, interval.stop_us)
        order_events = load_order_events(backend)
        x, y, t, p, label = order_events(Unordered(*self), span_us, size.shape)
        return EventStream.unchecked(x, y, t, p, size=size, label=label)
