"""`texvent live`: a camera, or a video at its own rate, beside its events in the browser."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.capture.open import open_frames
from texvent.cli.options import parse_configs
from texvent.cli.simulation.web import AddressOptions, serve
from texvent.config import CaptureConfig
from texvent.errors import OutputError
from texvent.web.live import LiveEvents
from texvent.web.live_page import LiveServer

DESCRIPTION = """Show a camera beside its events in the browser; change simulator and threshold, and
record. It ends with the page, or with Ctrl-C. Only those who have the address can reach the page.

  texvent live
  texvent live clip.mp4 --simulator esim --sensor davis346"""
OF_THE_CAMERA = ("simulator", "contrast_threshold", "sensor", "interpolate", "config")


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
    config: Path | None = None
    """TOML or YAML file with more options; flags override it."""
    folder: Path = Path()
    """Folder of the recordings; the page writes nowhere else."""

    def __post_init__(self) -> None:
        if not self.folder.is_dir():
            raise OutputError(
                f"the folder {self.folder} does not exist; create it with: mkdir -p '{self.folder}'"
            )


def run(arguments: Sequence[str]) -> int:
    """Serve until the page is closed, Ctrl-C or SIGTERM; returns the exit code."""
    groups = {"camera": LiveOptions(), "page": AddressOptions()}
    options, page = parse_configs(arguments, groups, prog="texvent live", description=DESCRIPTION)
    frames = open_frames(options.source, CaptureConfig())
    live = LiveEvents(frames, {name: getattr(options, name) for name in OF_THE_CAMERA})
    name = str(frames.metadata.get("source", options.source))  # without a password
    return serve(LiveServer(live, name, options.folder, port=page.port), page)
