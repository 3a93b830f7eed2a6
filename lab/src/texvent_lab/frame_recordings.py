"""Recordings of frames and events of one sensor, opened by path or by the name of a data set."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from texvent.capture.open import open_frames
from texvent.capture.recorded_frames import DSEC_EVENTS, is_dsec, is_evreal
from texvent.config import CaptureConfig
from texvent.data.catalogue import DATA_SETS
from texvent.data.pull import find_pulled
from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.frames import MICROSECONDS, FrameStream
from texvent.io.files import open_events

WITH_FRAMES = ("slider_depth", "davis346")
"""Data sets that hold frames and events."""

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


def open_recording(path: Path) -> FrameRecording:
    """A recording from the files it is usually kept in.

    Args:
        path: a folder of the Event-Camera Dataset (events.txt, images.txt), an EVREAL folder with
            images, a DSEC sequence, or an AEDAT4 file with frames.

    Raises:
        InputError: there is no such recording, or it holds no frames.
        FileFormatError: a file is damaged.
    """
    if not path.exists():
        raise InputError(f"there is no recording {path}")
    if path.is_dir() and not (is_evreal(path) or is_dsec(path)):
        missing = [name for name in (ECD_EVENTS, ECD_FRAMES) if not (path / name).is_file()]
        if missing:
            raise InputError(
                f"{path} has no {missing[0]}, and is no EVREAL folder with images.npy and no DSEC "
                "sequence; give a folder of either kind or an AEDAT4 file"
            )
    video = open_frames(str(path), CaptureConfig())
    events = open_events(_events_of(path), size=video.size)
    return FrameRecording(name=path.resolve().stem, frames=video, events=events)


def _events_of(path: Path) -> Path:
    """The event file of a recording: itself, or one of its files."""
    if is_dsec(path):
        return path / DSEC_EVENTS
    has_rows = path.is_dir() and (path / ECD_EVENTS).is_file()
    return path / ECD_EVENTS if has_rows else path


def _us(seconds: float) -> int:
    return round(seconds * MICROSECONDS)


def recording_name(source: str) -> str:
    """Name of a recording: that of its data set, or of its file or folder."""
    return source if source in DATA_SETS else Path(source).expanduser().resolve().stem


def resolve_source(source: str, folder: Path) -> str:
    """A source that a file in `folder` names: a path counts from there, a data set keeps its name.

    Example:
        >>> resolve_source("one.aedat4", Path("here")), resolve_source("slider_depth", Path())
        ('here/one.aedat4', 'slider_depth')
    """
    return source if source in DATA_SETS else str(folder / source)


def locate_source(source: str) -> tuple[Path, int]:
    """Path of a recording, and the frozen offset of its frames, µs.

    Raises:
        InputError: it is not there, or not pulled.
    """
    if source not in DATA_SETS:
        path = Path(source).expanduser()
        if not path.exists():
            raise InputError(
                f"there is no recording {source}; give the path of one, or the name of a data set: "
                f"{', '.join(WITH_FRAMES)}"
            )
        return path, 0
    pulled = find_pulled(source)
    if pulled is None:
        raise InputError(f"{source} is not pulled yet: texvent data pull {source}")
    return pulled, DATA_SETS[source].frame_offset_us
