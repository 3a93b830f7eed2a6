"""A picture of the liveliest moment, found without keeping the clip."""

from __future__ import annotations

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.video import Frame
from texvent.view.canvas import png_bytes
from texvent.view.film.draw import compose_interval
from texvent.view.film.film import interval_facts
from texvent.view.film.interval import Interval, IntervalCollector
from texvent.view.film.layout import Layout
from texvent.view.palettes import DEFAULT_PALETTE, Palette, get_palette


class StillPicker:
    """Feed it the run; it remembers the interval with the most events and draws it.

    Memory holds one interval besides the one being gathered.
    """

    def __init__(
        self,
        *,
        size: SensorSize,
        palette: str | Palette = DEFAULT_PALETTE,
        side_by_side: bool = True,
        title: str = "",
    ) -> None:
        self._layout = Layout(size, get_palette(palette), side_by_side)
        self._title = title
        self._collector = IntervalCollector(size)
        self._best: Interval | None = None

    def append(self, frame: Frame, packet: EventStream) -> None:
        """Add a dense frame and the events before it."""
        interval = self._collector.append(frame, packet)
        if interval is not None:
            self.consider(interval)

    def consider(self, interval: Interval) -> None:
        """Remember the interval if it is the liveliest so far; the earlier one wins a tie."""
        if self._best is None or interval.event_count > self._best.event_count:
            self._best = interval

    def pick(self) -> Interval | None:
        """The liveliest interval, else the only frame, else None."""
        return self._best or self._collector.lone_frame()

    def draw(self, interval: Interval) -> bytes:
        """The picture of an interval as a PNG file in memory."""
        return png_bytes(
            compose_interval(
                interval, self._layout, title=self._title, facts=interval_facts(interval)
            )
        )

    def png(self) -> bytes | None:
        """The picture of the liveliest interval, or None if there was no frame at all."""
        interval = self.pick()
        return None if interval is None else self.draw(interval)
