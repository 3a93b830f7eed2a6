"""One sub-interval: what every pixel model knows when it decides which events happened in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.sensor import SensorSize

Float64Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SubInterval:
    """The time between two neighbouring frames, `[start_us, stop_us)`."""

    start_us: int
    """Time of the earlier frame, µs (included)."""
    stop_us: int
    """Time of the later frame, µs (excluded)."""
    key: np.uint64
    """Key of the random draws of this sub-interval; see `draws.frame_key`."""
    previous: Float64Array
    """Brightness at the start, L(α + I^{j−1}), [H, W], log units."""
    brightness: Float64Array
    """Brightness at the end, L(α + I^j), [H, W], log units."""
    reference: Float64Array
    """Reference brightness the pixels compare with, L(α + κ ⋄ I^{j−1}), [H, W], log units."""

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        height, width = self.brightness.shape
        return SensorSize(width, height)

    def at(self, fraction: Float64Array) -> NDArray[np.int64]:
        """Times, µs, at fractions 0..1 of the sub-interval, rounded down; never `stop_us` itself.

        Example:
            >>> nothing = np.zeros((1, 1))
            >>> interval = SubInterval(0, 10_000, np.uint64(0), nothing, nothing, nothing)
            >>> interval.at(np.array([0.0, 0.75, 1.0])).tolist()
            [0, 7500, 9999]
        """
        offset = np.floor(fraction * (self.stop_us - self.start_us)).astype(np.int64)
        return np.asarray(np.minimum(self.start_us + offset, self.stop_us - 1))
