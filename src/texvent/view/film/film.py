"""A film of the run: the video on the left, the events since on the right."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS, Frame
from texvent.view.film.draw import compose_interval
from texvent.view.film.encode import FilmEncoder
from texvent.view.film.interval import Interval, IntervalCollector
from texvent.view.film.layout import PLEASANT_WIDTH, Layout
from texvent.view.images.event_image import count_ceiling
from texvent.view.palettes import DEFAULT_PALETTE, Palette, get_palette

GIF_WIDTH = 640.0
"""A gif compresses badly, so it is kept small."""
CEILING_MEMORY = 0.9
"""How slowly the scale recovers after a busy moment, per film frame: no flicker."""


class FilmWriter:
    """Writes an mp4 or gif while frames and packets come in; memory stays flat.

    Each source frame is shown during its own interval, beside all events of that interval, so
    the film runs exactly as the video does. Times are kept to the µs (gif: 1/100 s).

    Raises:
        ConfigError: the extension is not .mp4 or .gif, or the palette is unknown.
        OutputError: the file exists already or cannot be written.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        size: SensorSize,
        fps: Fraction | None,
        palette: str | Palette = DEFAULT_PALETTE,
        side_by_side: bool = True,
        overwrite: bool = False,
        title: str = "",
    ) -> None:
        """Check the path; the `with` statement opens it.

        Args:
            path: .mp4 or .gif file.
            size: sensor size, pixels.
            fps: nominal rate of the source frames, or None where it is not known.
            palette: colours, by name.
            side_by_side: whether the frames are shown, or only the events.
            overwrite: whether an existing file may be replaced.
            title: text of the caption, such as the prompt.
        """
        width = GIF_WIDTH if Path(path).suffix.lower() == ".gif" else PLEASANT_WIDTH
        self._layout = Layout(size, get_palette(palette), side_by_side, width)
        self._encoder = FilmEncoder(
            path,
            width=self._layout.width,
            height=self._layout.height,
            fps=fps or Fraction(30),
            overwrite=overwrite,
        )
        self._title = title
        self._collector = IntervalCollector(size)
        self._stack = ExitStack()
        self._first_us: int | None = None
        self._stop_us: int | None = None
        self._ceiling = 1.0

    def __enter__(self) -> Self:
        self._stack.enter_context(self._encoder)
        return self

    def append(self, frame: Frame, packet: EventStream) -> None:
        """Add a dense frame and the events before it, `[time of the frame before, frame.t_us)`."""
        interval = self._collector.append(frame, packet)
        if interval is not None:
            self.show(interval)

    def show(self, interval: Interval, *, film_start_us: int | None = None) -> None:
        """Add one film frame.

        Args:
            interval: what it shows.
            film_start_us: when it appears, µs from the start of the film; default: as long
                after the first interval as in the recording.
        """
        if self._first_us is None:
            self._first_us = interval.start_us
        start_us = interval.start_us - self._first_us if film_start_us is None else film_start_us
        self._ceiling = max(count_ceiling(interval.counts), CEILING_MEMORY * self._ceiling)
        picture = compose_interval(
            interval,
            self._layout,
            title=self._title,
            facts=interval_facts(interval),
            ceiling=self._ceiling,
        )
        self._encoder.write(picture, start_us)
        # With its own timing, the caller's nominal rate decides how long the last one stays.
        self._stop_us = interval.stop_us - self._first_us if film_start_us is None else None

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is not None:
            self._stack.__exit__(kind, error, trace)
            return
        with self._stack:
            lone = self._collector.lone_frame()
            if self._first_us is None and lone is not None:
                self.show(lone)
            if self._stop_us is not None:
                self._encoder.end(self._stop_us)


def interval_facts(interval: Interval) -> str:
    """Time and number of events, for the caption.

    Example:
        >>> import numpy as np
        >>> interval_facts(Interval(1_500_000, 1_540_000, np.ones((2, 1, 3), dtype=np.int32)))
        '1.500 s  6 events in 40.0 ms'
    """
    length_ms = (interval.stop_us - interval.start_us) / 1000
    return (
        f"{interval.start_us / MICROSECONDS:.3f} s  "
        f"{interval.event_count:,} events in {length_ms:.1f} ms"
    )


def title_of(metadata: Mapping[str, Any]) -> str:
    """What a recording shows: its prompt, else the name of its source, else nothing."""
    for key in ("prompt", "title", "source", "input"):
        value = metadata.get(key)
        if isinstance(value, Mapping):
            # A run stores what it knows of a video; its file or folder is called "source" again.
            value = Path(str(value.get("source") or "")).name
        if isinstance(value, str) and value.strip():
            return " ".join(value.split())
    return ""
