"""The flow of the current pair, computed once for the frames and for their count."""

from __future__ import annotations

import weakref

import numpy as np

from texvent.interpolate.dis_flow.estimator import DisFlow, FlowArray
from texvent.pairs.instants import matching_luma
from texvent.video import Frame

FAST_PERCENTILE = 99.9
"""The motion of a pair is that of its fastest thousandth. The maximum would often be an outlier at
an occlusion."""


class PairFlow:
    """Optical flow between two frames, kept until the next pair.

    The frames themselves are not kept alive.
    """

    def __init__(self) -> None:
        self._dis = DisFlow()
        self._pair: tuple[weakref.ref[Frame], weakref.ref[Frame]] | None = None
        self._flows: tuple[FlowArray, FlowArray] | None = None

    def both_ways(self, first: Frame, second: Frame) -> tuple[FlowArray, FlowArray]:
        """Flow from first to second, and from second to first.

        Returns:
            Two flows, [H, W, 2] float32 as (x, y), px.
        """
        if self._flows is None or not self._is_of(first, second):
            levels = (
                np.ascontiguousarray(matching_luma(one), np.float32) for one in (first, second)
            )
            self._flows = self._dis.both_ways(*levels)
            self._pair = weakref.ref(first), weakref.ref(second)
        return self._flows

    def motion_px(self, first: Frame, second: Frame) -> float:
        """How far the fastest part of a pair moves.

        Returns:
            Length of the `FAST_PERCENTILE` of the flow from first to second, px.
        """
        forward, _ = self.both_ways(first, second)
        length = np.hypot(forward[..., 0], forward[..., 1])
        return float(np.percentile(length, FAST_PERCENTILE))

    def _is_of(self, first: Frame, second: Frame) -> bool:
        return self._pair is not None and self._pair[0]() is first and self._pair[1]() is second
