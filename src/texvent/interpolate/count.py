"""Number of intermediate frames that a pair needs (Eq. 4)."""

from __future__ import annotations

import math

import numpy as np

from texvent.brightness import balanced_log
from texvent.errors import ConfigError, InputError
from texvent.video import MICROSECONDS, Frame, Motion, PixelArray

DEFAULT_CAP = 64
"""Most intermediate frames per pair, unless the caller says otherwise."""
FLOAT32_ERROR = 1e-6
"""Largest error of a difference of logarithms taken from a float32 ratio: four roundings of 6e-8
each."""
BAND_ROWS = 16
"""Rows that are compared at a time: their data stays in the cache."""
STEPS_PER_BEAT = 12
"""Frames that show one period of flickering light. From one to the next, the embedded generator's
beat then changes brightness by at most 0.18 (white; α = 30): below the paper preset's δ."""


def count_intermediate(
    first: Frame | PixelArray,
    second: Frame | PixelArray,
    *,
    balance: float,
    contrast_threshold: float,
    cap: int = DEFAULT_CAP,
) -> int:
    """Number of intermediate frames that the brightness change between two frames needs.

    It is 0 exactly when no pixel can fire from a fresh reference, and under a steady logarithmic
    change every sub-step stays below the threshold, so a pixel fires at most once per sub-step.

    Args:
        first: the earlier frame, or its pixels as in `Frame.pixels`.
        second: the later frame, same size.
        balance: α, on the 0..255 scale.
        contrast_threshold: δ, log units.
        cap: upper limit of the count.

    Returns:
        K, 0..cap.

    Raises:
        InputError: the frames differ in size.
        ConfigError: δ is not above 0, the cap is negative, or α + I is 0 somewhere.

    Equation: (4), section 3.2.1.
    Deviation: the paper takes the remainder by δ, which is below δ and would never interpolate,
        and leaves α out, so black has no logarithm; here the quotient is rounded down and α is
        inside the logarithm. The cap is ours. There is no tolerance: a change of 0.6 at δ = 0.2
        counts 2, because 0.6 / 0.2 is below 3 in binary.

    Example:
        >>> black, white = np.zeros((2, 2), np.uint8), np.full((2, 2), 255, np.uint8)
        >>> count_intermediate(black, white, balance=30.0, contrast_threshold=0.2)
        11
    """
    _check_options(contrast_threshold, cap)
    earlier, later = _luma(first), _luma(second)
    if earlier.shape != later.shape:
        raise InputError(
            f"the frames are {list(earlier.shape)} and {list(later.shape)} (height, width); "
            "both must have one size"
        )
    if balance >= 1.0:
        low, high = _bound_largest_change(earlier, later, balance)
        count = math.floor(low / contrast_threshold)
        if count == math.floor(high / contrast_threshold):
            return min(count, cap)
    change = np.abs(balanced_log(earlier, balance) - balanced_log(later, balance))
    return min(math.floor(float(change.max()) / contrast_threshold), cap)


def count_for_flicker(
    first_us: int, second_us: int, flicker_hz: float | None, *, cap: int = DEFAULT_CAP
) -> int:
    """Number of intermediate frames that show light which beats faster than the frame rate.

    Args:
        first_us: time of the earlier frame, µs.
        second_us: time of the later frame, µs.
        flicker_hz: periods per second; None is steady light.
        cap: upper limit of the count.

    Returns:
        K, 0..cap, for `STEPS_PER_BEAT` frames in each period.

    Deviation: not in the paper. Eq. 4 compares two frames, between which a beat does not show:
        at 24 frames per second, light that beats at 48 Hz looks steady to it.

    Example:
        >>> count_for_flicker(0, 41_667, 50.0), count_for_flicker(0, 41_667, None)
        (25, 0)
    """
    if flicker_hz is None:
        return 0
    beats = flicker_hz * (second_us - first_us) / MICROSECONDS
    return min(math.ceil(STEPS_PER_BEAT * beats) - 1, cap)


def longest_vector_px(first: Motion | None, second: Motion | None) -> float:
    """Displacement of the fastest part of a pair whose motion is known.

    Args:
        first: motion of the earlier frame; its vectors to the later one count.
        second: motion of the later frame; its vectors to the earlier one count.

    Returns:
        Length of the longest vector, px; 0 where none is known.
    """
    forward = None if first is None else first.forward
    backward = None if second is None else second.backward
    lengths = [
        np.hypot(field[..., 0], field[..., 1]) for field in (forward, backward) if field is not None
    ]
    longest = (float(np.max(one, initial=0.0, where=np.isfinite(one))) for one in lengths)
    return max(longest, default=0.0)


def _bound_largest_change(
    earlier: PixelArray, later: PixelArray, balance: float
) -> tuple[float, float]:
    """Bounds of the largest |ΔL|: in float32, with two logarithms instead of two per pixel."""
    shift, lowest, highest = np.float32(balance), math.inf, 0.0
    for top in range(0, len(later), BAND_ROWS):
        ratio = np.add(later[top : top + BAND_ROWS], shift, dtype=np.float32)
        ratio /= np.add(earlier[top : top + BAND_ROWS], shift, dtype=np.float32)
        lowest, highest = min(lowest, float(ratio.min())), max(highest, float(ratio.max()))
    largest = max(math.log(highest), -math.log(lowest))
    return largest - FLOAT32_ERROR, largest + FLOAT32_ERROR


def _luma(frame: Frame | PixelArray) -> PixelArray:
    return frame.luma if isinstance(frame, Frame) else Frame(frame, t_us=0).luma


def _check_options(contrast_threshold: float, cap: int) -> None:
    if not 0 < contrast_threshold < math.inf:
        raise ConfigError(f"contrast_threshold is {contrast_threshold:g}; it must be above 0")
    if cap < 0:
        raise ConfigError(f"cap is {cap}; it must be at least 0")
