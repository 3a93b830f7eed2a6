"""Dense optical flow between two frames by dense inverse search, in both directions."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow import flow_cpu
from texvent.interpolate.dis_flow.definitions import (
    PATCH,
    count_levels,
    follow_levels,
    make_pyramid,
)
from texvent.runtime.allocator import keep_freed_memory
from texvent.runtime.background_jit import is_ready, wait_until_ready

FlowArray = NDArray[np.float32]

SMALL_SIDE_PX = 100
"""Frames with a shorter side than this are matched down to their full size, others to half of it:
patches of 8×8 px on half-size pictures say little about a small frame."""
LEAST_SIDE_PX = 2 * PATCH
"""The edges of smaller frames are repeated this far."""
FULL_RANGE, LEAST_RANGE = 255.0, 16.0
"""Both frames are stretched to the full range, for which the numbers of the search are made; from
this many levels on, so that the noise of a flat frame does not look like texture."""


class DisFlow:
    """Dense inverse search (`kernels.dis`) on stretched copies of the frames.

    The result does not depend on the number of threads, nor on the pairs before.

    Source: Kroeger et al., Fast Optical Flow using Dense Inverse Search (ECCV 2016).
    """

    def __init__(self) -> None:
        keep_freed_memory()
        # Before what simulates, which has slower twins: nothing happens without flow.
        is_ready(flow_cpu.__name__)
        # One for each direction, where there is more than one core; it ends with this object.
        self._helper = (
            ThreadPoolExecutor(1, "texvent-flow") if numba.get_num_threads() > 1 else None
        )

    def both_ways(
        self, first: NDArray[np.float32], second: NDArray[np.float32]
    ) -> tuple[FlowArray, FlowArray]:
        """Flow from first to second, and from second to first.

        Args:
            first: the earlier frame, [H, W], intensity.
            second: the later frame, [H, W], intensity.

        Returns:
            Two flows, [H, W, 2] float32 as (x, y), px; finite.
        """
        wait_until_ready(flow_cpu.__name__)
        shape = first.shape
        pictures = [_pad(picture) for picture in stretch(first, second)]
        finest = 0 if min(shape) < SMALL_SIDE_PX else 1
        levels = max(finest, count_levels(pictures[0].shape))
        earlier, later = (make_pyramid(one, finest, levels, flow_cpu) for one in pictures)
        full = pictures[0].shape

        def follow(start: list[FlowArray], stop: list[FlowArray]) -> FlowArray:
            planes = follow_levels(start, stop, flow_cpu)
            if finest:
                planes = flow_cpu.double(planes, full)
            return np.stack([plane[: shape[0], : shape[1]] for plane in planes], axis=-1)

        if self._helper is None:
            return follow(earlier, later), follow(later, earlier)
        back = self._helper.submit(follow, later, earlier)
        return follow(earlier, later), back.result()


def stretch(
    first: NDArray[np.float32], second: NDArray[np.float32]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Copies of two frames with one common scale, from their darkest to their brightest level."""
    low = min(first.min(), second.min())
    high = max(first.max(), second.max())
    gain = np.float32(FULL_RANGE / max(float(high) - float(low), LEAST_RANGE))
    return (first - low) * gain, (second - low) * gain


def _pad(picture: NDArray[np.float32]) -> NDArray[np.float32]:
    height, width = picture.shape
    below, right = max(0, LEAST_SIDE_PX - height), max(0, LEAST_SIDE_PX - width)
    if below == 0 and right == 0:
        return picture
    return np.pad(picture, ((0, below), (0, right)), mode="edge")
