"""Times of intermediate frames, and luma in which two frames are compared."""

from __future__ import annotations

import numpy as np

from texvent.frames import Frame, PixelArray
from texvent.transfer import WHITE, Transfer, encode_srgb


def position(first: Frame, second: Frame, t_us: int) -> float:
    """τ in (0, 1): the share of the interval that has passed at `t_us`."""
    return (t_us - first.t_us) / (second.t_us - first.t_us)


def matching_luma(frame: Frame) -> PixelArray:
    """Luma as flow and scene changes are found in: `matching_levels` of it."""
    return matching_levels(frame.luma, frame.transfer)


def matching_levels(levels: PixelArray, transfer: Transfer) -> PixelArray:
    """Levels in which detail counts alike in shade and in glare, for comparing images.

    Args:
        levels: [...] 0..255 scale.
        transfer: what they are.

    Returns:
        Gamma-coded levels; above white they go on as `255 · (1 + ln(level / 255))`. Those of
        ordinary video are returned as they are.

    Example:
        >>> light = np.array([2.55, 255.0, 2550.0])
        >>> matching_levels(light, Transfer.LINEAR).round().tolist()
        [25.0, 255.0, 508.0]
    """
    if transfer is Transfer.LINEAR:
        levels = encode_srgb(levels / np.float32(WHITE))
    if levels.dtype.kind != "f" or levels.max() <= WHITE:
        return levels
    compressed = WHITE * (1 + np.log(np.maximum(levels, WHITE) / WHITE, dtype=np.float64))
    return np.where(levels > WHITE, compressed, levels).astype(np.float32)


def intermediate_times_us(first_us: int, second_us: int, count: int) -> list[int]:
    """Times of `count` equally spaced intermediate frames, strictly between two frames.

    Args:
        first_us: time of the earlier frame, µs.
        second_us: time of the later frame, µs, above `first_us`.
        count: how many are wanted. Where the interval has fewer whole microseconds inside, there
            is one time per microsecond instead.

    Returns:
        `first + round((second - first)·k / (K + 1))` for k = 1..K, strictly increasing, µs.
        Halves round up.

    Equation: (4), "K_i equally spaced intermediate frames", section 3.2.1.

    Example:
        >>> intermediate_times_us(0, 100, 2)
        [33, 67]
        >>> intermediate_times_us(0, 3, 64)
        [1, 2]
    """
    interval = second_us - first_us
    parts = min(count, interval - 1) + 1
    # Whole numbers only: a float would lose microseconds in long recordings.
    return [first_us + (2 * interval * k + parts) // (2 * parts) for k in range(1, parts)]
