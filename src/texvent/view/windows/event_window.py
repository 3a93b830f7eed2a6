"""Events of a stretch of time, with the frame to show beside them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS, Frame
from texvent.view.drawing.annotations import Annotations
from texvent.view.drawing.canvas import Image
from texvent.view.drawing.event_image import frame_image


@dataclass(frozen=True, eq=False)
class EventWindow:
    """The events of `[start_us, stop_us)` and the frame that the video shows during it."""

    start_us: int
    stop_us: int
    counts: NDArray[np.int32]
    """OFF and ON events per pixel, [2, H, W]."""
    image: Image | None = None
    """The frame at `start_us`, [H, W, 3] RGB, or None if there are only events."""
    fading: NDArray[np.float32] | None = None
    """Strength 0..1 of the last OFF and ON event per pixel at the end, [2, H, W], where events
    fade instead of being counted."""
    annotations: Annotations | None = None
    """Boxes and arrows drawn over the panels."""

    @property
    def event_count(self) -> int:
        """How many events there are."""
        return int(self.counts.sum())

    @property
    def caption(self) -> str:
        """Time and number of events.

        Example:
            >>> EventWindow(1_500_000, 1_540_000, np.ones((2, 1, 3), dtype=np.int32)).caption
            '1.500 s  6 events in 40.0 ms'
        """
        length_ms = (self.stop_us - self.start_us) / 1000
        return (
            f"{self.start_us / MICROSECONDS:.3f} s  "
            f"{self.event_count:,} events in {length_ms:.1f} ms"
        )


class WindowCollector:
    """Gathers the packets of a dense stream into one window per source frame.

    Memory holds one source frame and the events since.
    """

    def __init__(self, size: SensorSize) -> None:
        self._size = size
        self._image: Image | None = None
        self._start_us: int | None = None
        self._packets: list[EventStream] = []

    def append(self, frame: Frame, packet: EventStream) -> EventWindow | None:
        """Add the events before `frame`.

        Args:
            frame: a source or intermediate frame.
            packet: events in `[time of the frame before, frame.t_us)`.

        Returns:
            The window that ends at `frame`, if it is a source frame and not the first.
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
            ended = EventWindow(self._start_us, frame.t_us, counts, self._image)
        self._start_us, self._image = frame.t_us, frame_image(frame)
        self._packets = []
        return ended

    def single_frame(self) -> EventWindow | None:
        """The last source frame, without events: for an input of one frame."""
        if self._start_us is None:
            return None
        counts = np.zeros((2, *self._size.shape), dtype=np.int32)
        return EventWindow(self._start_us, self._start_us + 1, counts, self._image)
