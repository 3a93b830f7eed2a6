"""When a frame is shown: times by a frame rate, or listed one by one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from texvent.errors import ConfigError, InputError
from texvent.video import frame_time_us


@dataclass(frozen=True)
class FrameTimes:
    """Times the user gave, by frame index; exactly one of `fps` and `listed_us` is set."""

    fps: Fraction | None = None
    """Frames per second."""
    listed_us: Sequence[int] | None = None
    """One time per frame, µs, strictly increasing."""
    origin: str = "fps"
    """What to call the times in messages, such as `images.txt`."""

    def __call__(self, index: int) -> int:
        """Time of frame `index`, µs.

        Raises:
            InputError: there are more frames than times.
        """
        if self.listed_us is None:
            return frame_time_us(index, self._rate())
        if index >= len(self.listed_us):
            raise InputError(
                f"{self.origin} has {len(self.listed_us)} times, but there are more frames; "
                "give one time per frame"
            )
        return int(self.listed_us[index])

    def check_count(self, frames: int) -> None:
        """Refuse a list of another length than there are frames.

        Raises:
            InputError: with both numbers.
        """
        if self.listed_us is not None and len(self.listed_us) != frames:
            raise InputError(
                f"{self.origin} has {len(self.listed_us)} times for {frames} frames; "
                "give one time per frame"
            )

    def _rate(self) -> Fraction:
        if self.fps is None:
            raise ConfigError("frame times need fps or a list of times; give one of them")
        return self.fps


def listed_times(t_us: Any, origin: str = "t_us") -> FrameTimes:
    """Frame times from a list of integer µs.

    Args:
        t_us: [N] integers, µs.
        origin: what to call them in messages.

    Raises:
        InputError: they are not integers, not one-dimensional, or do not strictly increase.
    """
    times = np.asarray(t_us)
    if times.ndim != 1 or times.dtype.kind not in "iu":
        raise InputError(
            f"{origin} must be one-dimensional whole microseconds; got {times.dtype} of shape "
            f"{list(times.shape)}. For seconds: np.round(seconds * 1e6).astype(np.int64)"
        )
    check_increasing([int(time) for time in times], origin)
    return FrameTimes(listed_us=[int(time) for time in times], origin=origin)


def check_increasing(times_us: Sequence[int], origin: str, hint: str = "") -> None:
    """Refuse times that do not strictly increase.

    Raises:
        InputError: with the first offending pair.
    """
    for index in range(1, len(times_us)):
        if times_us[index] <= times_us[index - 1]:
            raise InputError(
                f"{origin}: time {index} ({times_us[index]} µs) is not after time {index - 1} "
                f"({times_us[index - 1]} µs); frame times must strictly increase{hint}"
            )
