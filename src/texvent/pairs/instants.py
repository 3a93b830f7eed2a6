"""When intermediate frames are, and where they stand between their two source frames."""

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


def intermediate_times_us(first_us: int, second_us: int, count: int) -> list[int]:
    """Times of `count` equally spaced intermediate frames, strictly between two frames.

    Args:
        first_us: time of the earlier frame, µs.
        second_us: time of the later frame, µs.
        count: how many are wanted. Where the interval has fewer whole microseconds inside, there
            is one time per microsecond instead.

    Returns:
        `first + round((second - first)·k / (K + 1))` for k = 1..K, strictly increasing, µs.
        Halves round up.

    Raises:
        InputError: `second_us` is not after `first_us`, or the count is negative.

    Equation: (4), "K_i equally spaced intermediate frames", section 3.2.1.

    Example:
        >>> intermediate_times_us(0, 100, 2)
        [33, 67]
        >>> intermediate_times_us(0, 3, 64)
        [1, 2]
    """
    if second_us <= first_us:
        raise InputError(
            f"the later frame is at {second_us} µs, the earlier at {first_us} µs; "
            "frame times must strictly increase"
        )
    if count < 0:
        raise InputError(f"count is {count}; it must be at least 0")
    interval = second_us - first_us
    parts = min(count, interval - 1) + 1
    # Whole numbers only: a float would lose microseconds in long recordings.
    return [first_us + (2 * interval * k + parts) // (2 * parts) for k in range(1, parts)]
