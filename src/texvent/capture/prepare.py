"""Steps of every source: cut to start and stop, scale, fit to the sensor, check."""

from __future__ import annotations

import itertools
import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from texvent.capture.frame_source import ChangedFrames, known_times_us
from texvent.capture.intensity_scale import scale_to_levels
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.frames import (
    MICROSECONDS,
    Frame,
    FrameStream,
    StreamChecker,
    frame_time_us,
)
from texvent.sensor import SensorSize

FEWEST_FRAMES = 2
"""Events are changes between frames, so one frame has none."""


class PreparedFrames(ChangedFrames):
    """A source's frames between start and stop, at the wanted size, checked one by one.

    `start` and `stop` count from the first frame; the frames keep their times, so events share a
    clock with the source whatever part of it is used.

    Args:
        source: the frames as they come.
        config: start, stop, fit and white level.
        size: wanted size, or None to keep the source's.

    Raises:
        InputError: while iterating: fewer than two frames, a NaN, negative or infinite intensity,
            sizes that differ, or a time that does not increase.
    """

    def __init__(
        self,
        source: FrameStream,
        config: CaptureConfig,
        *,
        size: SensorSize | None = None,
    ) -> None:
        super().__init__(source)
        self._config = config
        self.frame_count = _count_frames(source, config)
        self.size = size or source.size
        self._is_fitted = size is not None

    @property
    def metadata(self) -> Mapping[str, Any]:
        """The source's, and the size it had if frames were fitted to another."""
        if self.size == self.source.size:
            return self.source.metadata
        return {**self.source.metadata, "size_before_fit": str(self.source.size)}

    @property
    def times_us(self) -> Sequence[int] | None:
        """Times of the source's frames from start to stop, where it knows them, µs."""
        times_us = known_times_us(self.source)
        if not times_us:
            return None
        start_us, stop_us = _ends_us(self._config)
        before = itertools.takewhile(lambda t_us: t_us - times_us[0] < stop_us, times_us)
        return [t_us for t_us in before if start_us <= t_us - times_us[0]]

    @property
    def fit(self) -> str:
        """Fit of frames to the wanted size."""
        return self._config.fit

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order; see the class for what can go wrong."""
        start_us, stop_us = _ends_us(self._config)
        checker = StreamChecker()
        first_us: int | None = None
        offset_us = count = 0
        for frame in self.source:
            first_us = frame.t_us if first_us is None else first_us
            offset_us = frame.t_us - first_us
            if offset_us >= stop_us:
                break
            if offset_us < start_us:
                continue
            yield self._prepared(frame, checker)
            count += 1
        if count < FEWEST_FRAMES:
            raise InputError(_too_few(count, self._config, offset_us))

    def _prepared(self, frame: Frame, checker: StreamChecker) -> Frame:
        pixels, motion = frame.pixels, frame.motion
        if frame.size != self.source.size:
            raise InputError(
                f"the frame at {frame.t_us} µs is {frame.size}, those before it are "
                f"{self.source.size}; cut the video there, or bring all frames to one size"
            )
        if self._config.white_level is not None:
            pixels = scale_to_levels(pixels, self._config.white_level)
        if self._is_fitted:
            from texvent.capture.fit_to_sensor import fit_motion, fit_pixels  # brings OpenCV

            pixels = fit_pixels(pixels, self.size, self._config.fit)
            motion = motion and fit_motion(motion, self.size, self._config.fit)
        if pixels is not frame.pixels or motion is not frame.motion:
            frame = replace(frame, pixels=pixels, motion=motion)
        return checker.check(frame)


def _count_frames(source: FrameStream, config: CaptureConfig) -> int | None:
    """Number of frames between start and stop, estimated where the source only estimates."""
    count, fps = source.frame_count, source.fps
    if not config.start and config.stop is None:
        return count
    if count is None or fps is None:
        return None
    first, stop = (
        bisect_left(range(count), end_us, key=lambda index: frame_time_us(index, fps))
        for end_us in _ends_us(config)
    )
    return max(0, stop - first)


def _ends_us(config: CaptureConfig) -> tuple[int, float]:
    """Start, which belongs to the part, and stop, which does not, µs from the first frame."""
    stop = math.inf if config.stop is None else round(config.stop * MICROSECONDS)
    return round(config.start * MICROSECONDS), stop


def _too_few(count: int, config: CaptureConfig, last_us: int) -> str:
    found = "no frame" if count == 0 else "only one frame"
    if not config.start and config.stop is None:
        return f"there is {found}; events need the change between at least two"
    stop = "the end" if config.stop is None else f"{config.stop:g} s"
    return (
        f"there is {found} between {config.start:g} s and {stop} (frames were read up to "
        f"{last_us / MICROSECONDS:g} s); events need at least two, so widen `start` and `stop`"
    )
