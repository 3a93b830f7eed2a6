"""Events sorted by pixel and polarity: each pixel's ON and OFF events are one train."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.metrics.windows import flat_index


@dataclass(frozen=True, eq=False)
class Trains:
    """Events ordered by (train, time); a train is one polarity of one pixel."""

    train: NDArray[np.int64]
    """[n] number of each event's train, (p · H + y) · W + x, ascending."""
    t: NDArray[np.int64]
    """[n] time, µs, ascending within a train."""

    @classmethod
    def of(cls, events: EventStream) -> Trains:
        """The trains of a stream."""
        width, height = events.size
        train = flat_index((events.p, 2), (events.y, height), (events.x, width))
        # Stable: a stream is in time order already, and stays so within each train.
        order = np.argsort(train, kind="stable")
        return cls(train[order], events.t[order])

    @cached_property
    def intervals_us(self) -> NDArray[np.int64]:
        """Times between neighbouring events of the same train, µs."""
        together = self.train[1:] == self.train[:-1]
        return np.asarray(np.diff(self.t)[together])

    def times_of(self, train: int) -> NDArray[np.int64]:
        """Times of one train, µs; empty if it has no event."""
        first, last = np.searchsorted(self.train, (train, train + 1))
        return np.asarray(self.t[int(first) : int(last)])
