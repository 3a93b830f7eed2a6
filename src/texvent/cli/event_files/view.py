"""`texvent view EVENTS`: turn, play and measure a recording in the browser."""

from __future__ import annotations

import sys
import tempfile
import webbrowser
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from texvent.cli.event_files.shown_events import ShownEventsOptions
from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent.view.drawing.palettes import DEFAULT_PALETTE
from texvent.view.render import RenderConfig, render_events

DESCRIPTION = """Open an event file in the browser: a point cloud over x, y and time, playback, a
region to select, the event rate and the source video.

  texvent view out.h5                        a temporary page, opened at once
  texvent view out.h5 -o page.html           a page to keep or send, not opened
  texvent view clip.aedat4 --video clip.mp4  with the video"""


@dataclass(frozen=True, kw_only=True)
class ViewOptions(ShownEventsOptions):
    """Which events, and how the page is made."""

    out: Path | None = None
    """Page to save (.html). Without it, a temporary page is made and opened in the browser."""
    points: int = 1_000_000
    """Most events in the cloud: of a longer recording, that many are drawn uniformly at random,
    and the page says so. A million make a page of 12 MB."""
    palette: str = DEFAULT_PALETTE
    """Colours of ON and OFF events."""

    def __post_init__(self) -> None:
        check_range("points", self.points, 1, 20_000_000)
        if self.out is not None and self.out.suffix.lower() != ".html":
            raise ConfigError(
                f"a page must end in .html; got {self.out}. For videos and images: texvent render"
            )


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments, {"input": ViewOptions()}, prog="texvent view", description=DESCRIPTION
    )
    events = options.open()
    page = options.out or Path(tempfile.mkdtemp(prefix="texvent-")) / "events.html"
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        render_events(
            events,
            page,
            config=RenderConfig(palette=options.palette, points=options.points),
            frames=options.frames(events),
            overwrite=options.overwrite,
            progress=progress,
        )
    if not options.quiet:
        write_out(f"{page}\n")
    if options.out is None and not webbrowser.open(page.resolve().as_uri()):
        sys.stderr.write("no browser could be opened; open that page yourself\n")
    return 0
