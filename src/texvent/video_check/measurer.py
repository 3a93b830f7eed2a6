"""All measures that one pass takes, a frame at a time."""

from __future__ import annotations

from collections.abc import Iterable

from texvent.video import Frame
from texvent.video_check.banding import Banding
from texvent.video_check.blocks import SeenFrame
from texvent.video_check.borders import Borders
from texvent.video_check.compression import Compression
from texvent.video_check.flicker import Flicker, FlickerSpectrum
from texvent.video_check.frame_times import FrameIntervals
from texvent.video_check.image_levels import ImageLevels
from texvent.video_check.repeats import Repeats
from texvent.video_check.shots import Shots


class VideoMeasurer:
    """Takes the measures of a clip while its frames pass by.

    Keeps two frames, the block means of 64, and a few numbers per frame.
    """

    def __init__(self) -> None:
        self._count = 0
        self._times, self._flicker, self._shots = FrameIntervals(), Flicker(), Shots()
        self._parts = (
            ImageLevels(), Repeats(), Compression(), Banding(), Borders(), self._shots, self._times,
        )  # fmt: skip

    def add(self, frame: Frame) -> None:
        """Take one frame."""
        seen = SeenFrame.of(frame, self._count)
        self._count += 1
        self._flicker.add(seen)
        for part in self._parts:
            part.add(seen)

    @property
    def cut_times_us(self) -> list[int]:
        """Times of the first frames of new shots, µs."""
        return self._shots.cut_times_us

    def flicker_spectrum(self) -> FlickerSpectrum | None:
        """See `Flicker.spectrum`."""
        return self._flicker.spectrum()

    def measures(self) -> dict[str, float]:
        """The numbers behind the checks, by name; every part's `measures` defines its own."""
        values = self._flicker.measures(self._times.fps)
        for part in self._parts:
            values |= part.measures()
        return values


def measure_video(frames: Iterable[Frame]) -> dict[str, float]:
    """The numbers behind the checks; see `VideoMeasurer.measures`."""
    measurer = VideoMeasurer()
    for frame in frames:
        measurer.add(frame)
    return measurer.measures()
