"""Events of one frame interval before they are sorted: what a pixel model returns."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE, SIGNAL


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
