"""Sorts the events of an interval into a packet, for every pixel model."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.simulate.backend.select import AUTO, Kernel
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.unsorted_events import UnsortedEvents


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


SortEvents: TypeAlias = Callable[[UnsortedEvents, tuple[int, int], tuple[int, int]], SortedEvents]
"""`sort_events(events, (start_us, stop_us), (height, width))`, see `sorting_reference`."""
SORT_EVENTS = Kernel[SortEvents](__name__, "sort_events")


def make_packet(
    events: UnsortedEvents, interval: FrameInterval, size: SensorSize, backend: str = AUTO
) -> EventStream:
    """The events in the order every packet has: by (t, y, x, p), labels included."""
    if not len(events.t):  # the first packet of every run: its kernel may not be needed at all
        columns = (np.empty(0, dtype) for dtype in (np.uint16, np.uint16, np.int64, np.uint8))
        return EventStream.unchecked(*columns, size=size, label=np.empty(0, np.uint8))
    span_us = (interval.start_us, interval.stop_us)
    x, y, t, p, label = SORT_EVENTS.load(backend)(events, span_us, size.shape)
    return EventStream.unchecked(x, y, t, p, size=size, label=label)
