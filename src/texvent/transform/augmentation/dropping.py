"""Augmentations that leave events out, each a share of the sample that is drawn up to a limit.

Source: Gu et al., "EventDrop: data augmentation for event-based learning", IJCAI 2021: by event, by
time and by area. Deviation: the paper draws shares from a few steps and does one of the three per
sample; here shares are uniform, and each is a step of its own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.config import check_range
from texvent.events import EventStream


@dataclass(frozen=True, kw_only=True)
class DropEvents:
    """Drops every event with the same probability, which is drawn once per sample."""

    most: float = 0.5
    """Highest probability; the lowest is 0."""

    def __post_init__(self) -> None:
        check_range("most", self.most, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        probability = chance.random() * self.most
        return events[chance.random(len(events)) >= probability]


@dataclass(frozen=True, kw_only=True)
class DropTime:
    """Drops all events of one span of time."""

    most: float = 0.5
    """Longest span, as a share of the time from the first to the last event."""

    def __post_init__(self) -> None:
        check_range("most", self.most, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        length, place = chance.random(2)
        if not len(events):
            return events
        whole = int(events.t[-1]) + 1 - int(events.t[0])
        span = round(whole * self.most * length)
        start = int(events.t[0]) + math.floor(place * (whole - span + 1))
        return events[(events.t < start) | (events.t >= start + span)]


@dataclass(frozen=True, kw_only=True)
class DropArea:
    """Drops all events of one rectangle, of the same proportions as the sensor."""

    most: float = 0.3
    """Largest side, as a share of the sensor's."""

    def __post_init__(self) -> None:
        check_range("most", self.most, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        share, *places = chance.random(3).tolist()
        sides = [round(side * self.most * share) for side in events.size]
        x, y = (
            math.floor(place * (whole - side + 1))
            for place, whole, side in zip(places, events.size, sides, strict=True)
        )
        inside = (events.x >= x) & (events.x < x + sides[0])
        inside &= (events.y >= y) & (events.y < y + sides[1])
        return events[~inside]
