"""Events gathered between source frames: what one film frame shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.video import Frame
from texvent.view.canvas import Picture
from texvent.view.film.marks import Marks
from texvent.view.images.event_image import frame_picture


@dataclass(frozen=True, eq=False)
class Interval:
    """The time `[start_us, stop_us)`, the frame that a video shows during it, and its events."""

    start_us: int
    stop_us: int
    counts: NDArray[np.int32]
    """OFF and ON events per pixel, [2, H, W]."""
    picture: Picture | None = None
    """The frame at `start_us`, [H, W, 3] RGB, or None if there are only events."""
    fading: NDArray[np.float32] | None = None
    """Strength 0..1 of the last OFF and ON event per pixel at the end, [2, H, W], where events
    fade instead of being counted."""
    marks: Marks | None = None
    """Boxes and arrows drawn over the panels."""

    @property
    def event_count(self) -> int:
        """How many events there are."""
        return int(self.counts.sum())


class IntervalCollector:
    """Feed it dense frames with their packets; it gives one interval per source frame.

    Memory holds one source frame and the events since.
    """

    def __init__(self, size: SensorSize) -> None:
        self._size = size
        self._picture: Picture | None = None
        self._start_us: int | None = None
        self._packets: list[EventStream] = []

    def append(self, frame: Frame, packet: EventStream) -> Interval | None:
        """Add the events before `frame`.

        Args:
            frame: a source or intermediate frame.
            packet: events in `[time of the frame before, frame.t_us)`.

        Returns:
            The interval that ends at `frame`, if it is a source frame and not the first.
        """
        if len(packet):
            self._packets.append(packet)
        if not frame.is_source:
            return None
        ended = None
        if self._start_us is not None:
            counts = count_events(
                EventStream.concat([EventStream.empty(self._size), *self._packets])
            )
            ended = Interval(self._start_us, frame.t_us, counts, self._picture)
        self._start_us, self._picture = frame.t_us, frame_picture(frame)
        self._packets = []
        return ended

    def lone_frame(self) -> Interval | None:
        """The last source frame by itself, without events: for an input of one frame."""
        if self._start_us is None:
            return None
        counts = np.zeros((2, *self._size.shape), dtype=np.int32)
        return Interval(self._start_us, self._start_us + 1, counts, self._picture)
