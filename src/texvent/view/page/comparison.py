"""Two recordings side by side in one HTML file: the same window, their rates, their scores."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.represent.event_frame import event_frame
from texvent.video import MICROSECONDS
from texvent.view.drawing.canvas import png_bytes
from texvent.view.drawing.event_image import count_ceiling, draw_events
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.page.html_parts import rate_figure
from texvent.view.page.sample import RATE_BINS
from texvent.view.page.template import fill_template

WINDOW_US = 40_000


@dataclass(frozen=True, kw_only=True)
class MetricRow:
    """One line of the table."""

    name: str
    value: str
    unit: str
    good: str
    blind_to: str
    windows: str = ""
    """Mean of windows and its interval; empty where there is none."""


def write_comparison(
    path: str | Path,
    recordings: Sequence[tuple[str, EventStream]],
    rows: Iterable[MetricRow],
    *,
    palette: str | Palette = DEFAULT_PALETTE,
    overwrite: bool = False,
) -> Path:
    """Write the page; it opens offline and holds no script.

    Args:
        path: .html file.
        recordings: names and events, the one to judge first, the reference last.
        rows: the scores.
        palette: colours, by name.
        overwrite: whether an existing file may be replaced.

    Returns:
        The path.

    Raises:
        InputError: the sensors differ in size.
        OutputError: the file exists already or cannot be written.
    """
    sizes = {events.size for _, events in recordings}
    if len(sizes) != 1:
        raise InputError(
            f"the sensors are {' and '.join(map(str, sorted(sizes, key=str)))}; a comparison needs "
            "one size: resize one file with texvent convert"
        )
    streams = [events for _, events in recordings]
    ranges = [one.time_range for one in streams]
    known = [one for one in ranges if one is not None] or [(0, 1)]
    extent = (min(start for start, _ in known), max(stop for _, stop in known))
    start_us = busiest_start(next((one for one in reversed(streams) if len(one)), streams[-1]))
    palette = get_palette(palette)
    page = fill_template(
        "comparison.html",
        {
            "title": html.escape(" and ".join(name for name, _ in recordings)),
            "summary": f"{streams[0].size.width} × {streams[0].size.height} pixels",
            "recordings": _columns(recordings, extent, start_us, palette),
            "note": (
                f"Both images show {start_us / MICROSECONDS:.3f} to "
                f"{(start_us + WINDOW_US) / MICROSECONDS:.3f} s, the "
                f"{WINDOW_US // 1000} ms with the most events of the reference. Images and curves "
                "have one scale."
            ),
            "metrics": "\n".join(map(_row, rows)),
        },
        palette=palette,
    )
    with atomic_file(Path(path), overwrite=overwrite) as part:
        part.write_text(page, encoding="utf-8")
    return Path(path)


def busiest_start(events: EventStream) -> int:
    """Where the window of `WINDOW_US` with the most events begins, µs; 0 without events."""
    if len(events) == 0:
        return 0
    counts = np.searchsorted(events.t, events.t + WINDOW_US) - np.arange(len(events))
    return int(events.t[int(counts.argmax())])


def _columns(
    recordings: Sequence[tuple[str, EventStream]],
    extent: tuple[int, int],
    start_us: int,
    palette: Palette,
) -> str:
    bin_us = max(1, extent[1] - extent[0]) / RATE_BINS
    rates = [_rates(events, extent[0], bin_us) for _, events in recordings]
    peak = max(int(one.max()) for one in rates)
    shown = [_window(events, start_us) for _, events in recordings]
    frames = [np.asarray(event_frame(one, "count")) for one in shown]
    ceiling = max(map(count_ceiling, frames))
    columns = []
    for (name, events), rate, window, frame in zip(recordings, rates, shown, frames, strict=True):
        light, dark = (
            base64.b64encode(png_bytes(draw_events(frame, one, ceiling=ceiling))).decode("ascii")
            for one in (palette, palette.dark)
        )
        curve = rate_figure(rate, start_us=extent[0], bin_us=bin_us, peak=peak)
        columns.append(
            f"<section><h2>{html.escape(name)}</h2>"
            f'<p class="summary">{len(events):,} events, {len(window):,} in the image</p>'
            '<div class="panel"><picture>'
            '<source media="(prefers-color-scheme: dark)" '
            f'srcset="data:image/png;base64,{dark}">'
            f'<img alt="Events of the window" src="data:image/png;base64,{light}">'
            f"</picture></div>{curve}</section>"
        )
    return "\n".join(columns)


def _window(events: EventStream, start_us: int) -> EventStream:
    """The events of the window; a recording may well have none there."""
    first, last = np.searchsorted(events.t, [start_us, start_us + WINDOW_US])
    return events[int(first) : int(last)]


def _rates(events: EventStream, start_us: int, bin_us: float) -> NDArray[np.int64]:
    """OFF and ON events per bin, [2, RATE_BINS]."""
    bins = np.minimum(((events.t - start_us) / bin_us).astype(np.int64), RATE_BINS - 1)
    flat = np.bincount(events.p.astype(np.int64) * RATE_BINS + bins, minlength=2 * RATE_BINS)
    return flat.reshape(2, RATE_BINS)


def _row(row: MetricRow) -> str:
    cells = (row.value, row.windows, row.unit, row.good, row.blind_to)
    return (
        f'<tr><th scope="row">{html.escape(row.name)}</th>'
        + "".join(f"<td>{html.escape(cell)}</td>" for cell in cells)
        + "</tr>"
    )
