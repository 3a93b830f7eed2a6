"""Still images: the busiest window, instants of a scene."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from texvent.events import EventStream
from texvent.frames import Frame
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import png_bytes, tile
from texvent.view.drawing.event_image import frame_image
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.drawing.panels import PanelLayout
from texvent.view.windows import EventWindow, compose_window, still_window_us


class BusiestWindow:
    """Keeps the window with the most events and draws it."""

    def __init__(
        self,
        *,
        size: SensorSize,
        palette: str | Palette = DEFAULT_PALETTE,
        side_by_side: bool = True,
        title: str = "",
    ) -> None:
        self._layout = PanelLayout(size, get_palette(palette), side_by_side)
        self._title = title
        self._best: EventWindow | None = None

    def consider(self, window: EventWindow) -> None:
        """Remember the window if it is the busiest so far; the earlier one wins a tie."""
        if self._best is None or window.event_count > self._best.event_count:
            self._best = window

    def draw(self, window: EventWindow) -> bytes:
        """The image of a window as a PNG file in memory."""
        return png_bytes(
            compose_window(window, self._layout, title=self._title, facts=window.caption)
        )

    def png(self) -> bytes | None:
        """The image of the busiest window, or None without a window."""
        return None if self._best is None else self.draw(self._best)


def find_busiest(packets: Iterable[EventStream], window_us: int) -> EventWindow | None:
    """The window `[s, s + window_us)` with the most events; the earlier one wins a tie.

    Windows begin at the first event and follow each other; those without events take no time, so
    that a long pause, or a clock in another unit, costs nothing. Memory holds the events of two
    windows and one packet.

    Args:
        packets: events in time order.
        window_us: length of the windows, µs.
    """
    first_us: int | None = None
    best: tuple[EventStream, ...] = ()
    latest: tuple[EventStream, ...] = ()  # the window that the next packet may go on with
    latest_index = -1
    for packet in packets:
        if not len(packet):
            continue
        first_us = int(packet.t[0]) if first_us is None else first_us
        indices = (packet.t - first_us) // window_us
        ends = np.flatnonzero(np.diff(indices)) + 1
        starts, stops = np.append(0, ends), np.append(ends, len(packet))
        if indices[0] == latest_index:
            latest = (*latest, packet[: stops[0]])
            starts, stops = starts[1:], stops[1:]
        if len(starts):
            best = max(best, latest, key=_count)
            busiest = int(np.argmax(stops - starts))
            best = max(best, (packet[starts[busiest] : stops[busiest]],), key=_count)
            latest, latest_index = (packet[starts[-1] : stops[-1]],), int(indices[-1])
    best = max(best, latest, key=_count)
    if first_us is None:
        return None
    start_us = int(best[0].t[0])
    start_us -= (start_us - first_us) % window_us
    events = EventStream.concat(best)
    return EventWindow(start_us, start_us + window_us, count_events(events), events=events)


def _count(parts: tuple[EventStream, ...]) -> int:
    return sum(map(len, parts))


CHUNK = 2**18
"""Events that are searched at once, so that no column is copied whole."""


def busiest_window_png(events: EventStream, *, title: str) -> bytes | None:
    """A PNG of the window with the most events, or None without events."""
    extent = events.time_range
    if extent is None:
        return None
    chunks = (events[first : first + CHUNK] for first in range(0, len(events), CHUNK))
    window = find_busiest(chunks, still_window_us(extent))
    still = BusiestWindow(size=events.size, side_by_side=False, title=title)
    return None if window is None else still.draw(window)


GAP = 4


def draw_stills(frames: Sequence[Frame]) -> bytes:
    """Some frames in a row, at least one, as a PNG file in memory."""
    images = [frame_image(frame) for frame in frames]
    return png_bytes(tile(images, len(images), (255, 255, 255), gap=GAP))
