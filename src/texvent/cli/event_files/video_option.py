"""`--video`: the source video shown beside the events of a file."""

from __future__ import annotations

from pathlib import Path

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.run.regeneration import render_again
from texvent.video import FrameStream

AUTOMATIC = "auto"
NO_VIDEO = "none"


def frames_for_overlay(video: str, events: EventPackets) -> FrameStream | None:
    """The source frames to show beside the events.

    Args:
        video: a video file or image folder; "none"; or "auto": the scene rendered again if the
            embedded generator made the file, else nothing.
        events: the recording; frames are fitted to its sensor.

    Raises:
        InputError: there is no such video, or it cannot be read.
    """
    if video == NO_VIDEO:
        return None
    if video == AUTOMATIC:
        rendered = render_again(events.metadata)
        return rendered if rendered is not None and rendered.size == events.size else None
    if not Path(video).exists():
        raise InputError(
            f"no such video: {video}; give a file, a folder of images, {AUTOMATIC} or {NO_VIDEO}"
        )
    return open_frames(video, CaptureConfig(), size=events.size)
