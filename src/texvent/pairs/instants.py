"""Where an intermediate frame stands between its two source frames."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.video import Frame


def position(first: Frame, second: Frame, t_us: int) -> float:
    """τ in (0, 1): the share of the interval that has passed at `t_us`."""
    return (t_us - first.t_us) / (second.t_us - first.t_us)


def float_luma(frame: Frame) -> NDArray[np.float32]:
    """Luma of a frame as float32, [H, W], 0..255 scale; 8-bit levels convert exactly."""
    return np.ascontiguousarray(frame.luma, dtype=np.float32)


def check_between(first: Frame, second: Frame, times_us: Sequence[int]) -> None:
    """Refuse a pair that cannot be interpolated at these times.

    Raises:
        InputError: the frames differ in size, or a time is not strictly between theirs.
    """
    if first.size != second.size:
        raise InputError(f"the frames are {first.size} and {second.size}; both must have one size")
    outside = [t_us for t_us in times_us if not first.t_us < t_us < second.t_us]
    if outside:
        raise InputError(
            f"intermediate time {outside[0]} µs is not strictly between the frames at "
            f"{first.t_us} µs and {second.t_us} µs"
        )
