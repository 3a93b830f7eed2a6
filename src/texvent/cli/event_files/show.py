"""`texvent render` and `texvent view`: an event file as a video, image or page; in the browser."""

from __future__ import annotations

import webbrowser
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.capture.open import open_frames
from texvent.cli.event_files.event_file_options import EventRangeOptions
from texvent.cli.notices import say, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import CaptureConfig, check_range
from texvent.errors import ConfigError, InputError
from texvent.event_packets import EventPackets
from texvent.frames import FrameStream
from texvent.run.regeneration import render_again
from texvent.runtime.console_progress import ConsoleProgress
from texvent.view.drawing.palettes import DEFAULT_PALETTE
from texvent.view.page.writer import temporary_page
from texvent.view.render import RenderConfig, render_events

AUTOMATIC = "auto"
WITH_FILES = "files"
NO_VIDEO = "none"


@dataclass(frozen=True, kw_only=True)
class ShownEventsOptions(EventRangeOptions):
    """Events to draw, and the video beside them."""

    input_texts: ClassVar[tuple[str, ...]] = ("video",)
    short_flags: ClassVar[Mapping[str, str]] = {
        **EventRangeOptions.short_flags,
        **{"out": "-o", "quiet": "-q"},
    }

    video: str = AUTOMATIC
    """Source video to show: a file, an image folder, none, auto or files. Auto renders the scene
    again if the embedded generator made the file; files also one with pictures or models that the
    event file names: for your own files."""
    overwrite: bool = False
    """Replace the file if it exists already."""
    quiet: bool = False
    """Do not print the name of the file written."""

    def frames(self, events: EventPackets) -> FrameStream | None:
        """The frames to show beside the events, fitted to their sensor; None for none.

        Raises:
            InputError: there is no such video, or it cannot be read.
        """
        if self.video == NO_VIDEO:
            return None
        if self.video in (AUTOMATIC, WITH_FILES):
            rendered = render_again(events.metadata, with_files=self.video == WITH_FILES)
            return rendered if rendered is not None and rendered.size == events.size else None
        if not Path(self.video).exists():
            raise InputError(
                f"no such video: {self.video}; give a file, a folder of images, {AUTOMATIC}, "
                f"{WITH_FILES} or {NO_VIDEO}"
            )
        return open_frames(self.video, CaptureConfig(), size=events.size)


RENDER = """Render an event file as a video (.mp4, .gif), an image (.png), or an interactive
page (.html).

  texvent render out.h5 -o slow.mp4 --speed 0.1        ten times slower
  texvent render out.h5 -o out.mp4 --overlay both      boxes and optical flow
  texvent render clip.raw -o out.mp4 --video clip.mp4  the video on the left"""


@dataclass(frozen=True, kw_only=True)
class RenderOptions(ShownEventsOptions):
    """Events to render, and the file to write."""

    main_options: ClassVar[tuple[str, ...]] = (
        "out", "video", "time", "speed", "render_fps", "window", "overlay", "show",
        "palette", "overwrite",
    )  # fmt: skip

    out: Path = REQUIRED
    """File to write: .mp4, .gif, .png or .html."""


def run_render(arguments: Sequence[str]) -> int:
    """Run `texvent render`; returns its exit code."""
    options, config = parse_configs(
        arguments,
        {"input": RenderOptions(), "image": RenderConfig()},
        prog="texvent render",
        description=RENDER,
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


VIEW = """Open an event file in the browser: a point cloud over x, y and time, playback, a
region to select, the event rate and the source video.

  texvent view out.h5                        a temporary page, opened at once
  texvent view out.h5 -o page.html           a page to keep or send, not opened
  texvent view clip.aedat4 --video clip.mp4  with the video"""


@dataclass(frozen=True, kw_only=True)
class ViewOptions(ShownEventsOptions):
    """Events to view, and options of the page."""

    out: Path | None = None
    """Page to save (.html). Without it, a temporary page is made and opened in the browser; it
    stays for a day."""
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


def run_view(arguments: Sequence[str]) -> int:
    """Run `texvent view`; returns its exit code."""
    (options,) = parse_configs(
        arguments, {"input": ViewOptions()}, prog="texvent view", description=VIEW
    )
    events = options.open()
    page = options.out or temporary_page()
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
        say("no browser could be opened; open that page yourself")
    return 0
