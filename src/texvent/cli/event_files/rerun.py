"""`texvent rerun EVENTS`: open a recording in the rerun viewer."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent._require import require
from texvent.cli.event_files.event_file_options import EventRangeOptions
from texvent.cli.event_files.video_option import AUTOMATIC, frames_for_overlay
from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.errors import ConfigError
from texvent.view.drawing.palettes import DEFAULT_PALETTE
from texvent.view.render import RenderConfig, render_events

DESCRIPTION = """Open an event file in the rerun viewer (pip install 'texvent[rerun]'): events over
the video on a timeline, a point cloud, the rate.

  texvent rerun out.h5                     a temporary recording, opened at once
  texvent rerun clip.raw --video clip.mp4  with the video
  texvent rerun out.h5 -o out.rrd          a recording to keep, not opened"""


@dataclass(frozen=True, kw_only=True)
class RerunOptions(EventRangeOptions):
    """Which events, and how they are shown."""

    input_texts: ClassVar[tuple[str, ...]] = ("video",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    out: Path | None = None
    """Recording to save (.rrd). Without it, a temporary one is made and opened."""
    video: str = AUTOMATIC
    """Source video to show: a file, an image folder, none or auto. Auto renders the scene again if
    the embedded generator made the file."""
    palette: str = DEFAULT_PALETTE
    """Colours of ON and OFF events."""
    overwrite: bool = False
    """Replace the recording if it exists already."""
    quiet: bool = False
    """Do not print the name of the recording."""

    def __post_init__(self) -> None:
        if self.out is not None and self.out.suffix.lower() != ".rrd":
            raise ConfigError(f"a rerun recording must end in .rrd; got {self.out}")


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code, or that of the viewer."""
    (options,) = parse_configs(
        arguments, {"input": RerunOptions()}, prog="texvent rerun", description=DESCRIPTION
    )
    require("rerun", extra="rerun")
    with tempfile.TemporaryDirectory(prefix="texvent-") as folder:
        out = options.out or Path(folder) / f"{options.path.stem}.rrd"
        events = options.open()
        render_events(
            events,
            out,
            config=RenderConfig(palette=options.palette),
            frames=frames_for_overlay(options.video, events),
            overwrite=options.overwrite,
        )
        if not options.quiet:
            write_out(f"{out}\n")
        if options.out is not None:
            return 0
        return subprocess.run([sys.executable, "-m", "rerun", str(out)], check=False).returncode
