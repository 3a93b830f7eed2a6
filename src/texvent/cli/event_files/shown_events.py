"""Options of commands that draw events beside their video."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.capture.open import open_frames
from texvent.cli.event_files.event_file_options import EventRangeOptions
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.run.regeneration import render_again
from texvent.video import FrameStream

AUTOMATIC = "auto"
NO_VIDEO = "none"


@dataclass(frozen=True, kw_only=True)
class ShownEventsOptions(EventRangeOptions):
    """Which events are drawn, and the video beside them."""

    input_texts: ClassVar[tuple[str, ...]] = ("video",)
    short_flags: ClassVar[Mapping[str, str]] = {
        **EventRangeOptions.short_flags,
        **{"out": "-o", "quiet": "-q"},
    }

    video: str = AUTOMATIC
    """Source video to show: a file, an image folder, none or auto. Auto renders the scene again if
    the embedded generator made the file."""
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
        if self.video == AUTOMATIC:
            rendered = render_again(events.metadata)
            return rendered if rendered is not None and rendered.size == events.size else None
        if not Path(self.video).exists():
            raise InputError(
                f"no such video: {self.video}; give a file, a folder of images, {AUTOMATIC} or "
                f"{NO_VIDEO}"
            )
        return open_frames(self.video, CaptureConfig(), size=events.size)
