"""The HTML page of a recording, in one file that needs no network."""

from __future__ import annotations

import contextlib
import html
import shutil
import tempfile
import webbrowser
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from texvent.errors import ConfigError, OutputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame
from texvent.io.atomic import AtomicOutput, atomic_file, check_output
from texvent.sensor import SensorSize
from texvent.view.drawing.palettes import DEFAULT_PALETTE, Palette, get_palette
from texvent.view.drawing.panels import title_of
from texvent.view.page import html_parts
from texvent.view.page.html_parts import fill_template
from texvent.view.sample import SAMPLE_EVENTS, FrameStrip, RateCurve, UniformSample
from texvent.view.stills import busiest_window_png

TEMPORARY = "texvent-view-"
KEPT_S = 86_400
"""Lifetime of a temporary page, s: it may be loaded again."""


class PageWriter(AtomicOutput):
    """Gathers a sample and a rate curve while packets come in, and writes the page at the end.

    Memory holds at most twice the sample and 64 small frames, however long the recording is.

    Raises:
        ConfigError: the palette is unknown.
        OutputError: the file exists already or cannot be written.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        size: SensorSize,
        metadata: Mapping[str, Any] | None = None,
        palette: str | Palette = DEFAULT_PALETTE,
        overwrite: bool = False,
        sample_limit: int = SAMPLE_EVENTS,
    ) -> None:
        """Check the path; the `with` statement opens it.

        Args:
            path: .html file.
            size: sensor size, pixels.
            metadata: facts of the run, shown in the page's table.
            palette: colours, by name.
            overwrite: whether an existing file may be replaced.
            sample_limit: most events shown in the cloud.
        """
        super().__init__()
        check_output(path, overwrite=overwrite)
        self._path = Path(path)
        self._size = size
        self._metadata = dict(metadata or {})
        self._palette = get_palette(palette)
        self._overwrite = overwrite
        self._sample = UniformSample(size, limit=sample_limit)
        self._curve = RateCurve()
        self._strip = FrameStrip()
        self._on_events = 0
        self._stop_us = 0
        self._part: Path | None = None
        self.still: bytes | None = None
        """PNG file shown below the curve; set it before the `with` block ends."""

    def _open(self, stack: ExitStack) -> None:
        self._part = stack.enter_context(atomic_file(self._path, overwrite=self._overwrite))

    def append(self, packet: EventStream) -> None:
        """Add the events of a packet, which starts no earlier than the one before it ended."""
        if len(packet) == 0:
            return
        self._sample.append(packet)
        self._curve.append(packet)
        self._on_events += int(packet.p.sum())
        self._stop_us = int(packet.t[-1]) + 1

    def add_metadata(self, facts: Mapping[str, Any]) -> None:
        """Show more facts of the run, known only now."""
        self._metadata.update(facts)

    def append_frame(self, frame: Frame) -> None:
        """Offer a frame of the source video; the page keeps a few."""
        self._strip.append(frame)

    def _complete(self) -> None:
        if self._part is None:
            raise OutputError(f"{self._path} is not open; use the writer in a with block")
        self._part.write_text(self._page(), encoding="utf-8")

    def _page(self) -> str:
        seen, sample, palette = self._sample.seen, self._sample.events(), self._palette
        title = title_of(self._metadata) or "Events"
        nested = {
            name: value
            for name, value in self._metadata.items()
            if isinstance(value, (Mapping, list, tuple)) and value
        }
        note = f"Shows all {seen:,} events."
        if len(sample) < seen:
            note = (
                f"Shows {len(sample):,} of {seen:,} events, drawn uniformly at random: "
                "the cloud is thinner than the recording."
            )
        parts = {
            "title": html.escape(title),
            "summary": html.escape(self._summary()),
            "video": html_parts.video_html(self._strip),
            "still": html_parts.still_html(self.still),
            "note": html.escape(note),
            "rate": html_parts.rate_curve_html(self._curve),
            "facts": html_parts.facts_html(self._facts()),
            "details": html_parts.details_html(nested),
            "data": html_parts.viewer_json(
                sample,
                self._curve,
                self._strip,
                palette=palette,
                seen=seen,
                stop_us=max(self._curve.start_us + 1, self._stop_us - 1),
            ),
        }
        return fill_template("page.html", parts, palette=palette)

    def _seconds(self) -> float:
        return max(0, self._stop_us - self._curve.start_us) / MICROSECONDS

    def _summary(self) -> str:
        seen = self._sample.seen
        return (
            f"{self._size.width} × {self._size.height} pixels · {self._seconds():.3f} s · "
            f"{seen:,} events"
        )

    def _facts(self) -> dict[str, Any]:
        seen, seconds = self._sample.seen, self._seconds()
        share = f" ({self._on_events / seen:.1%} ON)" if seen else ""
        facts: dict[str, Any] = {
            name: value
            for name, value in self._metadata.items()
            if value is not None and not isinstance(value, (Mapping, list, tuple))
        }
        version = {name: facts.pop(name) for name in ("texvent_version",) if name in facts}
        facts |= {
            "sensor": f"{self._size.width} × {self._size.height} pixels",
            "events": f"{seen:,}{share}",
            "duration": f"{seconds:.6f} s, from {self._curve.start_us:,} µs",
        }
        if seconds > 0:
            facts["mean_rate"] = f"{html_parts.count_text(seen / seconds)} events per second"
        return facts | version


def temporary_page() -> Path:
    """A path for a page that only its user can read; pages of former days are removed."""
    root = Path(tempfile.gettempdir())
    folder = Path(tempfile.mkdtemp(prefix=TEMPORARY, dir=root))
    mine = folder.lstat()
    for one in root.glob(f"{TEMPORARY}*"):
        with contextlib.suppress(OSError):
            status = one.lstat()
            if status.st_uid == mine.st_uid and mine.st_mtime - status.st_mtime > KEPT_S:
                shutil.rmtree(one)
    return folder / "events.html"


def show(
    events: EventStream | EventPackets, path: str | Path | None = None, *, overwrite: bool = False
) -> Path:
    """Make the page of a recording and, unless a path is given, open it in the browser.

    Args:
        events: events to show.
        path: where to save the page; then nothing is opened. Default: a temporary file.
        overwrite: whether an existing file may be replaced.

    Returns:
        Where the page is.

    Raises:
        ConfigError: the name is not that of a page.
        OutputError: the file exists already or cannot be written.
    """
    if path is not None and Path(path).suffix.lower() not in (".html", ".htm"):
        raise ConfigError(f"cannot show events in {path}; the name of a page ends in .html or .htm")
    page = Path(path) if path is not None else temporary_page()
    packets = (events,) if isinstance(events, EventStream) else events
    with PageWriter(
        page, size=events.size, metadata=events.metadata, overwrite=overwrite
    ) as writer:
        for packet in packets:
            writer.append(packet)
        if isinstance(events, EventStream):
            writer.still = busiest_window_png(events, title=title_of(events.metadata))
    if path is None:
        webbrowser.open(page.as_uri())
    return page
