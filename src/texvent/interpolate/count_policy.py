"""Number of intermediate frames of a pair: Eq. 4 within the limits that the user set."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from texvent.config import InterpolateConfig
from texvent.interpolate.count import count_for_flicker, count_intermediate, longest_vector_px
from texvent.interpolate.protocol import Interpolator
from texvent.video import FlickeringStream, Frame, FrameStream

if TYPE_CHECKING:
    from texvent.interpolate.flow import PairFlow


MOTION_LIMIT = 2
"""Where the user says nothing, motion raises Eq. 4's count to at most this multiple of it, so that
no clip takes more than twice as long."""
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
        """
        self._config = config
        self._balance, self._threshold = balance, contrast_threshold
        self._is_limited = config.frames_per_pixel is None
        self._per_pixel = 1.0 if config.frames_per_pixel is None else config.frames_per_pixel
        if self._is_limited:
            counts_motion = counts_motion and config.interpolate not in NEEDS_NO_FLOW
        else:
            counts_motion = self._per_pixel > 0
        counts_motion = counts_motion and config.count == "brightness"
        self._pair_flow = _pair_flow(interpolator) if counts_motion else None
        self._flicker_hz = _flicker_hz(stream, config)

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
        if config.count == "fixed":
            return config.fixed_count
        cap = config.max_intermediate
        count = count_intermediate(
            first,
            second,
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
    is_seen = config.interpolate in ("exact", "motion") and config.count == "brightness"
    return stream.flicker_hz if is_seen and isinstance(stream, FlickeringStream) else None


def _pair_flow(interpolator: Interpolator) -> PairFlow:
    """The flow that the interpolator computes anyway, or a new one."""
    from texvent.interpolate.flow import PairFlow  # only counting motion needs numba

    shared: PairFlow | None = getattr(interpolator, "pair_flow", None)
    return shared or PairFlow()
