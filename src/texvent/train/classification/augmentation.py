"""Changed copies of recordings: scaled, cut, reversed, mirrored and shifted."""

from __future__ import annotations

import numpy as np

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.train.classification.config import Augmentation


def augment(
    events: EventStream, augmentation: Augmentation, chance: np.random.Generator
) -> EventStream:
    """A copy that is reversed, mirrored and shifted as chance decides.

    Source: the program of J. Kim et al., "N-ImageNet", ICCV 2021 (its shift is 20 px).
    """
    flips_time, flips_x = chance.random(2) < 0.5
    dx, dy = chance.integers(-augmentation.shift, augmentation.shift + 1, 2)
    x, y, t, p, size = events.x, events.y, events.t, events.p, events.size
    if augmentation.flip_time and flips_time and len(t):
        x, y, t, p = x[::-1], y[::-1], t[-1] - t[::-1], 1 - p[::-1]
    x, y = x.astype(np.int32), y.astype(np.int32)
    if augmentation.flip_x and flips_x:
        x = size.width - 1 - x
    x, y = x + dx, y + dy
    inside = (x >= 0) & (x < size.width) & (y >= 0) & (y < size.height)
    return EventStream(x[inside], y[inside], t[inside], p[inside], size)


def scale_events(events: EventStream, size: SensorSize) -> EventStream:
    """A copy with coordinates scaled to another size and rounded down, as N-ImageNet's program."""
    x = events.x.astype(np.int64) * size.width // events.size.width
    y = events.y.astype(np.int64) * size.height // events.size.height
    return EventStream.from_columns(x, y, events.t, events.p, size=size)


def take_run(events: EventStream, count: int | None, chance: np.random.Generator) -> EventStream:
    """A random run of so many events, or all if there are no more."""
    if count is None or len(events) <= count:
        return events
    first = int(chance.integers(len(events) - count + 1))
    return events[first : first + count]
