"""Augmentations of time and polarity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from texvent.config import check_range
from texvent.events import EventStream
from texvent.transform.reversal import flip_polarity, reverse_time


@dataclass(frozen=True, kw_only=True)
class JitterTime:
    """Moves every event on its own, by a normal time rounded to whole µs, and sorts them again.

    No event moves before the first or after the last time of the sample. Events of one µs stay in
    the order they had.
    """

    sd_us: float = 100.0
    """Standard deviation, µs."""

    def __post_init__(self) -> None:
        check_range("sd_us", self.sd_us, 0.0, 1e9)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        if not len(events):
            return events
        moves = np.rint(chance.normal(0.0, self.sd_us, len(events))).astype(np.int64)
        t = np.clip(events.t + moves, events.t[0], events.t[-1])
        order = np.argsort(t, kind="stable")
        columns = {**events.columns(), "t": t}
        moved = {name: column[order] for name, column in columns.items()}
        return EventStream(**moved, size=events.size, metadata=events.metadata)


@dataclass(frozen=True, kw_only=True)
class FlipPolarity:
    """Exchanges ON and OFF of all events."""

    probability: float = 0.5
    """Of doing so."""

    def __post_init__(self) -> None:
        check_range("probability", self.probability, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        return flip_polarity(events) if chance.random() < self.probability else events


@dataclass(frozen=True, kw_only=True)
class ReverseTime:
    """Plays the sample backwards, ON and OFF exchanged; see `reversal.reverse_time`."""

    probability: float = 0.5
    """Of doing so."""

    def __post_init__(self) -> None:
        check_range("probability", self.probability, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        return reverse_time(events) if chance.random() < self.probability else events
