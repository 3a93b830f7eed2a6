"""`texvent app` and `texvent live`: pages in the browser of the user who started them."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
import webbrowser
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.config import CaptureConfig, check_range
from texvent.errors import ConfigError, InputError, OutputError
from texvent.runtime.files.hidden_parts import temporary_folder
from texvent.web.job_page import JobServer
from texvent.web.server import PageServer

APP = """Open the web page: choose an example, type a prompt or give a scene file or a
video, look at the events, download them. Only those who have the address can reach the page.

  texvent app
  texvent app --folder ~/Videos"""
LIVE = """Show a camera beside its events in the browser; change simulator and threshold, and
record. It ends with the page, or with Ctrl-C. Only those who have the address can reach the page.

  texvent live
  texvent live clip.mp4 --simulator esim --sensor davis346"""
WAIT_S = 0.5
LEAD = """<!doctype html><meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={}">"""
OF_THE_CAMERA = ("simulator", "contrast_threshold", "sensor", "interpolate", "device", "config")


@dataclass(frozen=True, kw_only=True)
class AddressOptions:
    """Address at which the page is served."""

    short_flags: ClassVar[Mapping[str, str]] = {"quiet": "-q"}

    port: int = 0
    """TCP port; 0: any free one."""
    browser: bool = True
    """Open the page in the browser."""
    quiet: bool = False
    """Do not print the address."""

    def __post_init__(self) -> None:
        check_range("port", self.port, 0, 65_535)
        if self.quiet and not self.browser:
            raise ConfigError(
                "--quiet and --no-browser show the address nowhere; leave one of them out"
            )


@dataclass(frozen=True, kw_only=True)
class FolderOptions:
    """Files that the page may name."""

    folder: Path = Path()
    """Folder of videos and scene files; the page reads no other, but for files that it is sent."""

    def __post_init__(self) -> None:
        if not self.folder.is_dir():
            raise InputError(f"{self.folder} is no folder; give the one that holds your videos")


@dataclass(frozen=True, kw_only=True)
class LiveOptions:
    """Source of the frames, and event camera."""

    input_texts: ClassVar[tuple[str, ...]] = ("source", "sensor")
    positional: ClassVar[tuple[str, ...]] = ("source",)
    outputs: ClassVar[tuple[str, ...]] = ("folder",)

    source: str = "/dev/video0"
    """Camera, stream, video or image folder. A camera is /dev/video0, a stream rtsp://...; a video
    is played at its own rate, again and again."""
    simulator: str | None = None
    """Pixel model to begin with, such as physical, esim or v2e; without it, texvent."""
    contrast_threshold: float | None = None
    """Contrast threshold to begin with; without it, the simulator's own."""
    sensor: str | None = None
    """Sensor: name or WIDTHxHEIGHT. Without it, the size of the frames."""
    interpolate: str | None = None
    """Interpolator between frames: flow, blend, rife or none (fastest)."""
    device: str | None = None
    """Device of the pixel model and of rife: auto, cpu, cuda or cuda:N; without it, auto."""
    config: Path | None = None
    """TOML or YAML file with more options; flags override it."""
    folder: Path = Path()
    """Folder of the recordings; the page writes nowhere else."""

    def __post_init__(self) -> None:
        if not self.folder.is_dir():
            raise OutputError(
                f"the folder {self.folder} does not exist; create it with: mkdir -p '{self.folder}'"
            )


def run_app(arguments: Sequence[str]) -> int:
    """Serve until Ctrl-C or SIGTERM; returns the exit code."""
    groups = {"files": FolderOptions(), "page": AddressOptions()}
    files, options = parse_configs(arguments, groups, prog="texvent app", description=APP)
    return serve(JobServer(files.folder, port=options.port), options)


def run_live(arguments: Sequence[str]) -> int:
    """Serve until the page is closed, Ctrl-C or SIGTERM; returns the exit code."""
    # Imported here: what simulates a camera is not needed for the other page.
    from texvent.capture.open import open_frames
    from texvent.web.live import LiveEvents
    from texvent.web.live_page import LiveServer

    groups = {"camera": LiveOptions(), "page": AddressOptions()}
    options, page = parse_configs(arguments, groups, prog="texvent live", description=LIVE)
    frames = open_frames(options.source, CaptureConfig())
    live = LiveEvents(frames, {name: getattr(options, name) for name in OF_THE_CAMERA})
    name = str(frames.metadata.get("source", options.source))  # without a password
    return serve(LiveServer(live, name, options.folder, port=page.port), page)


def serve(server: PageServer, options: AddressOptions) -> int:
    """Show a page until Ctrl-C, SIGTERM, or the page needs it no more; returns the exit code."""
    stop = threading.Event()
    before = signal.signal(signal.SIGTERM, lambda number, frame: stop.set())
    try:
        with server, contextlib.ExitStack() as stack:
            if not options.quiet:
                write_out(f"{server.entry}\npress Ctrl-C to stop\n")
                sys.stdout.flush()
            if options.browser:
                # By a file: the words that start a browser are shown to every user.
                page = stack.enter_context(temporary_folder()) / "open.html"
                page.write_text(LEAD.format(server.entry), encoding="utf-8")
                webbrowser.open(page.as_uri())
            try:
                # In turns: on Windows Ctrl-C does not end a wait.
                while not (server.is_over() or stop.wait(WAIT_S)):
                    pass
            except KeyboardInterrupt:
                stop.set()
    finally:
        signal.signal(signal.SIGTERM, before)
    return 0
