"""`texvent render EVENTS -o out.mp4|gif|png|html`: make an event file visible."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.event_files.shown_events import ShownEventsOptions
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent.view.render import RenderConfig, render_events

DESCRIPTION = """Render an event file as a video (.mp4, .gif), an image (.png), or an interactive
page (.html).

  texvent render out.h5 -o slow.mp4 --speed 0.1        ten times slower
  texvent render out.h5 -o sheet.png --panels 9        contact sheet of nine
  texvent render out.h5 -o out.mp4 --overlay both      boxes and optical flow
  texvent render clip.raw -o out.mp4 --video clip.mp4  the video on the left"""


@dataclass(frozen=True, kw_only=True)
class RenderOptions(ShownEventsOptions):
    """Which events, and where the result goes."""

    main_options: ClassVar[tuple[str, ...]] = (
        "out", "video", "time", "speed", "render_fps", "window", "panels", "overlay",
        "palette", "overwrite",
    )  # fmt: skip

    out: Path = REQUIRED
    """File to write: .mp4, .gif, .png or .html."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    options, config = parse_configs(
        arguments,
        {"input": RenderOptions(), "image": RenderConfig()},
        prog="texvent render",
        description=DESCRIPTION,
    )
    events = options.open()
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        written = render_events(
            events,
            options.out,
            config=config,
            frames=options.frames(events),
            overwrite=options.overwrite,
            progress=progress,
        )
    if not options.quiet:
        write_out(f"{written}\n")
    return 0
