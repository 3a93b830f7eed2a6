"""`texvent simulate VIDEO`: events, video, image and page from recorded frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.capture.motion_vectors.frames import find_motion_sidecar
from texvent.cli.command import resolve_command
from texvent.cli.option_types import REQUIRED
from texvent.cli.run import print_settings, run_source
from texvent.errors import without_password

DESCRIPTION = """Turn a video into the events that an event camera would have recorded.

  texvent simulate clip.mp4 -o out.h5
  texvent simulate frames/ --fps 120 --simulator v2e --sensor davis346"""


@dataclass(frozen=True, kw_only=True)
class VideoOptions:
    """Source of the frames."""

    input_texts: ClassVar[tuple[str, ...]] = ("source",)
    positional: ClassVar[tuple[str, ...]] = ("source",)
    main_options: ClassVar[tuple[str, ...]] = (
        "out", "sensor", "simulator", "preset", "contrast_threshold", "noise", "interpolate",
        "fps", "motion", "camera", "start", "stop", "seed", "device", "previews", "config",
        "dry_run", "overwrite",
    )  # fmt: skip

    source: str = REQUIRED
    """Video, image folder, camera, stream, or -. A camera is /dev/video0, a stream rtsp://...; - is
    standard input. With --camera: a still image."""
    prompt: str | None = None
    """Description of the video; stored with the events."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    settings, own, output = resolve_command(
        "simulate",
        arguments,
        VideoOptions(),
        description=DESCRIPTION,
        find_motion=lambda own: find_motion_sidecar(own.source),
    )
    if output.print_config:
        return print_settings(settings)
    subject = "standard input" if own.source == "-" else Path(without_password(own.source)).stem
    return run_source(own.source, settings, output, prompt=own.prompt, subject=subject)
