"""The time between two neighbouring frames, and times inside it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class FrameInterval(NamedTuple):
    """The time between two neighbouring frames, `[start_us, stop_us)`."""

    start_us: int
    """Time of the earlier frame, µs (included)."""
    stop_us: int
    """Time of the later frame, µs (excluded)."""
    key: np.uint64
    """Key of the random draws of this interval; see `draws.frame_key`."""

    @property
    def duration_us(self) -> int:
        """Length, µs."""
        return self.stop_us - self.start_us

    @property
    def duration_s(self) -> float:
        """Length, seconds."""
        return self.duration_us * 1e-6


def place_in(interval: FrameInterval, fraction: NDArray[np.float64]) -> NDArray[np.int64]:
    """Times at fractions 0..1 of an interval, rounded down; never its end.

    Args:
        interval: the interval.
        fraction: [n].

    Returns:
        [n] µs, in `[start_us, stop_us)`.

    Example:
        >>> interval = FrameInterval(0, 10_000, np.uint64(0))
        >>> place_in(interval, np.array([0.0, 0.75, 1.0])).tolist()
        [0, 7500, 9999]
    """
    offset = np.floor(fraction * interval.duration_us).astype(np.int64)
    return np.asarray(np.minimum(interval.start_us + offset, interval.stop_us - 1))
