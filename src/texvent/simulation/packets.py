"""Events between two frames: the interval, and columns in any order or in that of a packet."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.events import NOISE, SIGNAL
from texvent.runtime.memory import usable_bytes


class FrameInterval(NamedTuple):
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


class UnsortedEvents(NamedTuple):
    """Events of one interval, a row per event, in any order; never changed."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x."""
    t: NDArray[np.int64]
    """[n] times, µs, all in the interval."""
    p: NDArray[np.uint8]
    """[n] 1 = ON, 0 = OFF."""
    label: NDArray[np.uint8]
    """[n] `events.SIGNAL` or `events.NOISE`."""

    @classmethod
    def none(cls) -> UnsortedEvents:
        """No event."""
        nothing = np.empty(0, np.int64)
        return cls.signal(nothing, nothing, nothing.astype(np.uint8))

    @classmethod
    def signal(
        cls, pixel: NDArray[np.int64], t: NDArray[np.int64], p: NDArray[np.uint8]
    ) -> UnsortedEvents:
        """Events that a brightness change fired."""
        return cls(pixel, t, p, np.full(len(pixel), SIGNAL, np.uint8))

    @classmethod
    def noise(
        cls, pixel: NDArray[np.int64], t: NDArray[np.int64], p: NDArray[np.uint8]
    ) -> UnsortedEvents:
        """Events that noise fired."""
        return cls(pixel, t, p, np.full(len(pixel), NOISE, np.uint8))

    @classmethod
    def concat(cls, parts: Iterable[UnsortedEvents]) -> UnsortedEvents:
        """The events of all parts, at least one."""
        return cls(*(np.concatenate(column) for column in zip(*parts, strict=True)))

    def take(self, rows: NDArray[np.int64] | NDArray[np.bool_]) -> UnsortedEvents:
        """Some of the events, by number or by mask."""
        pixel, t, p, label = self
        return UnsortedEvents(pixel[rows], t[rows], p[rows], label[rows])


BYTES_PER_EVENT = 100
"""Memory of an event while its packet is made: columns as drawn, keys, sorted columns."""


def check_event_number(number: float) -> None:
    """Refuse a packet that memory cannot hold, before there is any of it.

    Args:
        number: events between two frames, counted or expected.

    Raises:
        InputError: it is above what `usable_bytes` holds.
    """
    most = usable_bytes() // BYTES_PER_EVENT
    if not number <= most:
        raise InputError(
            f"about {number:.2g} events come between two frames, and memory holds {most:.2g}; give "
            "frames closer together in time, lower the rates of noise and leak, or raise the "
            "contrast threshold"
        )


class SortedEvents(NamedTuple):
    """The columns of an `EventStream`, sorted by (t, y, x, p, label)."""

    x: NDArray[np.uint16]
    y: NDArray[np.uint16]
    t: NDArray[np.int64]
    p: NDArray[np.uint8]
    label: NDArray[np.uint8]

    def unsorted(self, width: int) -> UnsortedEvents:
        """The same events by flat pixel index; `width` of the sensor, pixels."""
        return UnsortedEvents(self.y.astype(np.int64) * width + self.x, self.t, self.p, self.label)
