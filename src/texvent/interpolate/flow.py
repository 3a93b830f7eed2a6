"""Motion-compensated interpolation by DIS optical flow: the default, without weights."""

from __future__ import annotations

import weakref
from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from texvent.config import InterpolateConfig
from texvent.frames import Frame, FrameStream
from texvent.interpolate.dis_flow.estimator import DisFlow, FlowArray
from texvent.pairs.instants import matching_levels
from texvent.pairs.motion_interpolation import MotionInterpolation

FAST_PERCENTILE = 99.9
"""The motion of a pair is that of its fastest thousandth. The maximum would often be an outlier at
an occlusion."""


class FlowInterpolator:
    """Moves both frames along the optical flow to the instant, and mixes them.

    The flow is computed once per pair, in both directions. Where the two directions disagree, the
    point is occluded in one frame, and the other frame counts more; where both fail, the frames are
    blended in place.

    Deviation: the paper uses RIFE, which needs published weights.
    """

    bytes_per_pixel: ClassVar[int] = 160

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config, stream  # the arguments of every interpolator; not used here
        self.pair_flow = PairFlow()
        """The flow of the last pair; `CountPolicy` uses it to count frames."""

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> MotionInterpolation:
        """Frames with every point moved along its path from `first` to `second`.

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs.

        Returns:
            One frame per time, [H, W] float32 luma, 0..255 scale; the flow is computed at once,
            each frame when it is asked for.
        """
        # Now, not at the first frame: this may run in the prefetch thread.
        flows = self.pair_flow.both_ways(first, second)
        return MotionInterpolation.between(first, second, times_us, flows)


class PairFlow:
    """Optical flow of the current pair, computed once for its frames and for their count.

    The frames themselves are not kept alive.
    """

    def __init__(self) -> None:
        self._dis = DisFlow()
        self._pair: tuple[weakref.ref[Frame], weakref.ref[Frame]] | None = None
        self._flows: tuple[FlowArray, FlowArray] | None = None

    def both_ways(self, first: Frame, second: Frame) -> tuple[FlowArray, FlowArray]:
        """Flow from first to second, and from second to first.

        Returns:
            Two flows, float32 as (x, y), px; see `DisFlow.both_ways`.
        """
        if self._flows is None or not self._is_of(first, second):
            levels = (matching_levels(one.float_luma, one.transfer) for one in (first, second))
            self._flows = self._dis.both_ways(*levels)
            self._pair = weakref.ref(first), weakref.ref(second)
        return self._flows

    def motion_px(self, first: Frame, second: Frame) -> float:
        """Displacement of the fastest part of a pair.

        Returns:
            Length of the `FAST_PERCENTILE` of the flow from first to second, px.
        """
        forward = self.both_ways(first, second)[0][::2, ::2]  # neighbours move alike
        length = np.hypot(forward[..., 0], forward[..., 1])
        return float(np.percentile(length, FAST_PERCENTILE))

    def _is_of(self, first: Frame, second: Frame) -> bool:
        return self._pair is not None and self._pair[0]() is first and self._pair[1]() is second
