"""The facts that a source of frames states about itself."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from texvent.sensor import SensorSize
from texvent.video import Frame, FrameStream, NotebookFrames, Video, describe_stream


@dataclass(frozen=True)
class SourceFacts:
    """Known when the source is opened."""

    size: SensorSize
    """Width and height of the frames, pixels."""
    fps: Fraction | None
    """Frames per second; None where each frame has its own time."""
    frame_count: int | None
    """Number of frames; None where it is not known."""
    metadata: Mapping[str, Any]
    """Where the frames come from; JSON-serialisable."""
    is_live: bool = False
    """True if the frames can be read only once."""


class FrameSource(NotebookFrames, ABC):
    """A `FrameStream` that states `SourceFacts`; subclasses set them and iterate."""

    _facts: SourceFacts
    _source: FrameStream
    """Of some: the stream whose frames they change one by one."""

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        return self._facts.size

    @property
    def fps(self) -> Fraction | None:
        """Nominal frame rate, or None where each frame has its own time."""
        return self._facts.fps

    @property
    def frame_count(self) -> int | None:
        """Number of frames as far as the source states it, or None."""
        return self._facts.frame_count

    @property
    def is_live(self) -> bool:
        """True if the frames can be read only once."""
        return self._facts.is_live

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Where the frames come from."""
        return self._facts.metadata

    @property
    def times_us(self) -> Sequence[int] | None:
        """Times of all frames where they are known without reading them, µs."""
        return known_times_us(getattr(self, "_source", None))

    def __repr__(self) -> str:
        return describe_stream(self)

    @abstractmethod
    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order."""


def known_times_us(stream: FrameStream | None) -> Sequence[int] | None:
    """Times of all frames of a stream that knows them without reading its frames, µs."""
    return stream.times_us if isinstance(stream, FrameSource | Video) else None
