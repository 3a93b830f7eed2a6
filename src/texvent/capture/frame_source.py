"""Sources of frames, with facts known when they are opened, and changes of their frames."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from texvent.frames import Frame, FrameStream, NotebookFrames, Video, describe_stream
from texvent.sensor import SensorSize


class FrameSource(NotebookFrames, ABC):
    """A `FrameStream` whose facts are known when it is opened; subclasses iterate.

    Args:
        size: width and height of the frames, pixels.
        fps: frames per second; None where each frame has its own time.
        frame_count: number of frames as far as the source states it, or None.
        metadata: where the frames come from; JSON-serialisable.
        is_live: True if the frames can be read only once.
    """

    def __init__(
        self,
        size: SensorSize,
        fps: Fraction | None,
        frame_count: int | None,
        metadata: Mapping[str, Any],
        *,
        is_live: bool = False,
    ) -> None:
        self.size, self.fps, self.frame_count = size, fps, frame_count
        self._metadata, self.is_live = dict(metadata), is_live

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Origin of the frames."""
        return self._metadata

    @property
    def times_us(self) -> Sequence[int] | None:
        """Times of all frames where they are known without reading them, µs."""
        return None

    def __repr__(self) -> str:
        return describe_stream(self)

    @abstractmethod
    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order."""


class ChangedFrames(FrameSource):
    """The frames of another stream, each at its time; facts are the source's unless replaced."""

    def __init__(self, source: FrameStream) -> None:
        self.source = source
        count, is_live = source.frame_count, source.is_live
        super().__init__(source.size, source.fps, count, source.metadata, is_live=is_live)

    @property
    def metadata(self) -> Mapping[str, Any]:
        """The source's."""
        return self.source.metadata

    @property
    def times_us(self) -> Sequence[int] | None:
        """The source's, µs."""
        return known_times_us(self.source)


def known_times_us(stream: FrameStream) -> Sequence[int] | None:
    """Times of all frames of a stream that knows them without reading its frames, µs."""
    return stream.times_us if isinstance(stream, FrameSource | Video) else None
