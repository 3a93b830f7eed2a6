"""Number of intermediate frames of a pair: Eq. 4 within the limits that the user set."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from texvent.brightness import balanced_log
from texvent.config import InterpolateConfig
from texvent.frames import (
    MICROSECONDS,
    FlickeringStream,
    Frame,
    FrameStream,
    MotionVectors,
    PixelArray,
)
from texvent.interpolate.protocol import Interpolator
from texvent.pairs.on_device import PairMeasures, measure_pair
from texvent.runtime.devices import Device, explain_device_memory

if TYPE_CHECKING:
    from texvent.interpolate.flow import PairFlow

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
MOTION_LIMIT = 2
"""Limit unless the user sets one: motion raises Eq. 4's count to at most this multiple of it, so
that no clip takes more than twice as long."""
NEEDS_NO_FLOW = frozenset({"none", "blend", "motion"})
"""Interpolators whose frames show no motion, or motion that is known."""


class CountPolicy:
    """Eq. 4 or a fixed count, raised by motion and by flickering light.

    Motion that is known (`Frame.motion`) always counts where it is followed or rendered.
    """

    def __init__(
        self,
        config: InterpolateConfig,
        stream: FrameStream,
        interpolator: Interpolator,
        *,
        balance: float,
        contrast_threshold: float,
        counts_motion: bool = False,
        device: Device | None = None,
    ) -> None:
        """A policy for one stream.

        Args:
            config: the options.
            stream: the source frames; it may know the frequency of flickering light.
            interpolator: its optical flow is used, where it has one, to measure motion.
            balance: the simulator's α.
            contrast_threshold: the simulator's δ.
            counts_motion: whether motion counts, up to `MOTION_LIMIT`, where the options do not
                say it.
            device: torch.device of the frames; None: they are on the host.
        """
        self._device = device
        self._measures: PairMeasures | None = None
        self._config = config
        self._balance, self._threshold = balance, contrast_threshold
        self._is_limited = config.frames_per_pixel is None
        self._per_pixel = 1.0 if config.frames_per_pixel is None else config.frames_per_pixel
        if self._is_limited:
            counts_motion = counts_motion and config.interpolate not in NEEDS_NO_FLOW
        else:
            counts_motion = self._per_pixel > 0
        counts_motion = counts_motion and config.fixed_count is None
        self._pair_flow = _pair_flow(interpolator) if counts_motion else None
        self._flicker_hz = _flicker_hz(stream, config)

    def look_at(self, first: Frame, second: Frame) -> None:
        """Measure a pair on the device, once for its count and for scene changes."""
        if self._device is None or self._config.interpolate == "none":
            return
        with explain_device_memory(self._device, second.size):
            self._measures = measure_pair(first, second, self._balance, self._device)

    def count(self, first: Frame, second: Frame) -> int:
        """Number of intermediate frames between two source frames.

        Args:
            first: the earlier source frame.
            second: the later source frame.

        Raises:
            InputError: the frames differ in size.
            ConfigError: α + I is 0 somewhere.

        Equation: (4), section 3.2.1, unless the options set another count.
        """
        config = self._config
        if config.interpolate == "none":
            return 0
        if config.fixed_count is not None:
            return config.fixed_count
        cap = config.max_intermediate
        agreed = None if self._measures is None else _agreed(*self._measures, self._threshold)
        if agreed is not None:
            count = min(agreed, cap)
        else:
            count = count_intermediate(
                first.luma,
                second.luma,
                balance=self._balance,
                contrast_threshold=self._threshold,
                cap=cap,
            )
        limit = min(cap, MOTION_LIMIT * count) if self._is_limited else cap
        count = max(count, count_for_flicker(first.t_us, second.t_us, self._flicker_hz, cap=cap))
        if count == cap:
            return count
        if config.interpolate in ("motion", "exact"):
            # What these frames show is exact, so what they skip is all that is lost.
            moves_px = longest_vector_px(first.motion, second.motion)
            count = max(count, math.ceil(max(self._per_pixel, 1.0) * moves_px))
        if self._pair_flow is not None and count < limit:
            moves_px = self._pair_flow.motion_px(first, second)
            count = max(count, min(math.ceil(self._per_pixel * moves_px), limit))
        return min(count, cap)


def _flicker_hz(stream: FrameStream, config: InterpolateConfig) -> float | None:
    """The beat that intermediate frames must show; only rendered frames can."""
    is_seen = config.interpolate in ("exact", "motion") and config.fixed_count is None
    return stream.flicker_hz if is_seen and isinstance(stream, FlickeringStream) else None


def _pair_flow(interpolator: Interpolator) -> PairFlow:
    """The flow that the interpolator computes anyway, or a new one."""
    from texvent.interpolate.flow import PairFlow  # only counting motion needs numba

    shared: PairFlow | None = getattr(interpolator, "pair_flow", None)
    return shared or PairFlow()


def count_intermediate(
    earlier: PixelArray,
    later: PixelArray,
    *,
    balance: float,
    contrast_threshold: float,
    cap: int = DEFAULT_CAP,
) -> int:
    """Number of intermediate frames that the brightness change between two frames needs.

    It is 0 exactly when no pixel can fire from a fresh reference, and under a steady logarithmic
    change every sub-step stays below the threshold, so a pixel fires at most once per sub-step.

    Args:
        earlier: luma of the earlier frame, [H, W], 0..255 scale.
        later: luma of the later frame, [H, W].
        balance: α, on the 0..255 scale.
        contrast_threshold: δ, log units.
        cap: upper limit of the count.

    Returns:
        K, 0..cap.

    Raises:
        ConfigError: α + I is 0 somewhere.

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
    if balance >= 1.0:
        count = _agreed(*_bound_largest_change(earlier, later, balance), contrast_threshold)
        if count is not None:
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


def longest_vector_px(first: MotionVectors | None, second: MotionVectors | None) -> float:
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


def _agreed(low: float, high: float, threshold: float) -> int | None:
    """Thresholds in a change between two bounds; None if the bounds do not agree."""
    if not (low > -math.inf and high < math.inf):
        return None
    count = math.floor(low / threshold)
    # A change of 0 has a bound below it.
    return max(count, 0) if count == math.floor(high / threshold) or high < threshold else None


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
