"""Are frames as far apart as the others?"""

from __future__ import annotations

import numpy as np

from texvent.video import MICROSECONDS
from texvent.video_check.blocks import SeenFrame

IRREGULAR = 0.1
"""An interval is irregular if it differs from the median by more than this share of it, ..."""
ROUNDING_US = 1500
"""... and by more than this: Matroska stores whole milliseconds."""


class FrameIntervals:
    """Takes the time of each frame."""

    def __init__(self) -> None:
        self._times_us: list[int] = []

    def add(self, seen: SeenFrame) -> None:
        """Take one frame."""
        self._times_us.append(seen.frame.t_us)

    @property
    def fps(self) -> float:
        """Frames per second: over the whole clip if it is regular, else by the median interval.

        0 of a single frame.
        """
        apart = np.diff(np.array(self._times_us, np.int64))
        if len(apart) == 0:
            return 0.0
        is_regular = self._irregular().mean() == 0
        return MICROSECONDS / float(apart.mean() if is_regular else np.median(apart))

    def _irregular(self) -> np.ndarray:
        apart = np.diff(np.array(self._times_us, np.int64)).astype(np.float64)
        if len(apart) == 0:
            return np.zeros(1, bool)
        off = np.abs(apart - np.median(apart))
        return np.asarray((off > IRREGULAR * np.median(apart)) & (off > ROUNDING_US))

    def measures(self) -> dict[str, float]:
        """By name.

        Returns:
            `frames`: how many; `fps`: see there; `irregular_share`: share of the intervals that
            differ from the median by more than a tenth and 1.5 ms; `longest_gap`: the longest
            interval over the median.
        """
        apart = np.diff(np.array(self._times_us, np.int64))
        longest = float(apart.max() / np.median(apart)) if len(apart) else 1.0
        return {
            "frames": float(len(self._times_us)),
            "fps": self.fps,
            "irregular_share": float(self._irregular().mean()),
            "longest_gap": longest,
        }
