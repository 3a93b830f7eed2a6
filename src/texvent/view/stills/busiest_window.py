"""The window with the most events as an image, found in one pass."""

from __future__ import annotations

from fractions import Fraction

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import png_bytes
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.drawing.panels import PanelLayout
from texvent.view.windows.cut import cut_windows, still_window_us
from texvent.view.windows.draw_window import compose_window
from texvent.view.windows.event_window import EventWindow


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


def busiest_window_png(events: EventStream, *, title: str) -> bytes | None:
    """A PNG of the window with the most events, or None without events."""
    extent = events.time_range
    if extent is None:
        return None
    length_us = still_window_us(extent)
    busiest = BusiestWindow(size=events.size, side_by_side=False, title=title)
    for window in cut_windows(
        (events,), size=events.size, step_us=Fraction(length_us), window_us=length_us
    ):
        busiest.consider(window)
    return busiest.png()
