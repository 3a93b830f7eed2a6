"""Recordings of one sensor that hold frames and events."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from texvent.capture.dsec_frames import EVENTS as DSEC_EVENTS
from texvent.capture.dsec_frames import is_dsec
from texvent.capture.evreal_frames import is_evreal
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.io.files import open_events
from texvent.video import MICROSECONDS, FrameStream

ECD_EVENTS, ECD_FRAMES = "events.txt", "images.txt"

EVREAL_SPANS_S: Mapping[str, tuple[float, float]] = {
    "calibration": (5.0, 20.0),
    "boxes_6dof": (5.0, 20.0),
    "dynamic_6dof": (5.0, 20.0),
    "office_zigzag": (5.0, 12.0),
    "poster_6dof": (5.0, 20.0),
    "shapes_6dof": (5.0, 20.0),
    "slider_depth": (1.0, 2.5),
}
"""Recording of the Event-Camera Dataset → which part of it EVREAL scores, seconds."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FrameRecording:
    """Frames and events of one sensor on one clock; both can be read again, with flat memory.

    Raises:
        InputError: their sizes differ, or the frames are live.
    """

    name: str
    frames: FrameStream
    events: EventPackets

    def __post_init__(self) -> None:
        if self.frames.size != self.events.size:
            raise InputError(
                f"{self.name}: frames of {self.frames.size} and events of {self.events.size}; both "
                "must come from one sensor"
            )
        if self.frames.is_live:
            raise InputError(f"{self.name}: frames of a camera pass once; record them first")

    @property
    def evreal_span_us(self) -> tuple[int, int] | None:
        """First and last µs that EVREAL scores, or None where it scores all of a recording."""
        span = EVREAL_SPANS_S.get(self.name)
        return None if span is None else (_us(span[0]), _us(span[1]))


def open_recording(
    path: Path, *, frames: str | None = None, size: tuple[int, int] | None = None
) -> FrameRecording:
    """A recording from the files it is usually kept in.

    Args:
        path: a folder of the Event-Camera Dataset (events.txt, images.txt), an EVREAL folder with
            images, a DSEC sequence, an AEDAT4 file with frames, or any event file if `frames` is
            given.
        frames: the frames, where they lie elsewhere: a video file or image folder on the clock of
            the events.
        size: sensor size (width, height), for event formats that do not store it; default: that of
            the frames.

    Raises:
        InputError: there is no such recording, or it holds no frames.
        FileFormatError: a file is damaged.
    """
    if not path.exists():
        raise InputError(f"there is no recording {path}")
    if frames is None and path.is_dir() and not (is_evreal(path) or is_dsec(path)):
        missing = [name for name in (ECD_EVENTS, ECD_FRAMES) if not (path / name).is_file()]
        if missing:
            raise InputError(
                f"{path} has no {missing[0]}, and is no EVREAL folder with images.npy and no DSEC "
                "sequence; give a folder of either kind, an AEDAT4 file, or an event file and "
                "--frames"
            )
    video = open_frames(frames or str(path), CaptureConfig())
    events = open_events(_events_of(path), size=size or video.size)
    return FrameRecording(name=path.resolve().stem, frames=video, events=events)


def _events_of(path: Path) -> Path:
    """The event file of a recording: itself, or one of its files."""
    if is_dsec(path):
        return path / DSEC_EVENTS
    has_rows = path.is_dir() and (path / ECD_EVENTS).is_file()
    return path / ECD_EVENTS if has_rows else path


def _us(seconds: float) -> int:
    return round(seconds * MICROSECONDS)
