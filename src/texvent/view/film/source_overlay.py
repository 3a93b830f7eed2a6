"""Intervals of events with the frame that a video shows at each of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from texvent.errors import ConfigError, InputError
from texvent.sensor import SensorSize
from texvent.video import Frame, FrameStream
from texvent.view.canvas import Picture
from texvent.view.film.interval import Interval
from texvent.view.film.marks import Overlay, TruthfulStream, marks_of
from texvent.view.images.event_image import frame_picture


class Companion:
    """What is shown beside and over the events: frames of a video, and its ground truth.

    Raises:
        InputError: the video has another size than the events.
        ConfigError: an overlay is wanted, but nobody knows the truth.
    """

    def __init__(self, frames: FrameStream | None, overlay: Overlay, *, size: SensorSize) -> None:
        if frames is not None and frames.size != size:
            raise InputError(
                f"the video is {frames.size}, the events are {size}; give a video of the same size"
            )
        if overlay != "none" and not isinstance(frames, TruthfulStream):
            raise ConfigError(
                f"overlay is {overlay!r}, but boxes and flow are only known where the embedded "
                "generator renders the scene again: show a file that `texvent generate` of this "
                "version wrote, or leave the overlay out"
            )
        self.frames = frames
        self._overlay: Overlay = overlay

    def add_pictures(self, intervals: Iterable[Interval]) -> Iterator[Interval]:
        """The intervals, each with the last frame that is not after its start.

        Before the first frame it is the first, after the end the last. Frames are read once, as
        the intervals come.
        """
        if self.frames is None:
            yield from intervals
            return
        coming = iter(self.frames)
        shown = next(coming, None)
        following = next(coming, None)
        picture = _picture(shown)
        for interval in intervals:
            while following is not None and following.t_us <= interval.start_us:
                shown, following = following, next(coming, None)
                picture = None
            picture = _picture(shown) if picture is None else picture
            yield replace(interval, picture=picture)

    def frames_during(self, extent: tuple[int, int] | None) -> Iterator[Frame]:
        """The frames that are on from start to stop, µs; a video may be longer than the events.

        The first is the last frame that is not after the start. Without an extent, all frames.
        """
        earlier: Frame | None = None
        for frame in self.frames or ():
            if extent is not None and frame.t_us >= extent[1]:
                break
            if extent is not None and frame.t_us <= extent[0]:
                earlier = frame
                continue
            if earlier is not None:
                yield earlier
                earlier = None
            yield frame
        if earlier is not None:
            yield earlier

    def add_marks(self, interval: Interval) -> Interval:
        """The interval with its boxes and arrows."""
        if self._overlay == "none" or not isinstance(self.frames, TruthfulStream):
            return interval
        return replace(interval, marks=marks_of(self.frames, interval.start_us, self._overlay))


def _picture(frame: Frame | None) -> Picture | None:
    return None if frame is None else frame_picture(frame)
