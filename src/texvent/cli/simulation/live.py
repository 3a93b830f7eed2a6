"""`texvent live`: a camera, or a video at its own rate, beside its events in the browser."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.capture.live import without_password
from texvent.capture.open import open_frames
from texvent.cli.command import resolve_command
from texvent.cli.simulation.web import PageOptions, serve
from texvent.io.files import codec_for
from texvent.io.atomic import check_output
from texvent.web.live import LiveEvents
from texvent.web.live_page import LiveServer

DESCRIPTION = """Open a page with a camera beside its events: change simulator and threshold, record.
It ends with the page, or with Ctrl-C. Only this machine can reach it.

  texvent live
  texvent live clip.mp4 --simulator esim --sensor davis346"""


@dataclass(frozen=True, kw_only=True)
class LiveSource:
    """Source of the frames."""

    input_texts: ClassVar[tuple[str, ...]] = ("source",)
    positional: ClassVar[tuple[str, ...]] = ("source",)
    main_options: ClassVar[tuple[str, ...]] = (
        "out", "sensor", "simulator", "contrast_threshold", "interpolate", "overwrite",
        "config", "port", "browser", "quiet",
    )  # fmt: skip

    source: str = "/dev/video0"
    """Camera, stream or video: /dev/video0, rtsp://..., a file or an image folder. A file is played
    at its own rate, again and again."""


@dataclass(frozen=True, kw_only=True)
class LiveOptions(PageOptions):
    """Where the page is served, and a recording that begins at once."""

    short_flags: ClassVar[Mapping[str, str]] = {**PageOptions.short_flags, "out": "-o"}

    out: Path | None = None
    """Event file to record at once; its extension decides the format. The page records too."""
    overwrite: bool = False
    """Replace files that exist already."""
    config: Path | None = None
    """TOML or YAML file with options; flags override it."""


def run(arguments: Sequence[str]) -> int:
    """Serve until the page is closed, Ctrl-C or SIGTERM; returns the exit code."""
    settings, own, options = resolve_command(
        "simulate",
        arguments,
        LiveSource(),
        description=DESCRIPTION,
        prog="texvent live",
        output=LiveOptions(),
    )
    if options.out is not None:  # before a camera is opened
        codec_for(options.out)
        check_output(options.out, overwrite=options.overwrite)
    video = open_frames(own.source, settings.source, size=settings.size, seed=settings.run.seed)
    live = LiveEvents(video, settings, overwrite=options.overwrite)
    server = LiveServer(live, without_password(own.source), port=options.port)
    try:
        if options.out is not None:
            live.record(options.out)
        live.start()
    except BaseException:
        server.close()
        raise
    return serve(server, options)
