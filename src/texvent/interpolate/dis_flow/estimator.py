"""Dense optical flow between two frames by dense inverse search, in both directions."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow import flow_cpu
from texvent.interpolate.dis_flow.definitions import (
    PATCH,
    Floats,
    coarse_to_fine,
    count_levels,
    make_pyramid,
    match_level,
)
from texvent.interpolate.dis_flow.frame_motion import (
    NO_MOTIONS,
    Motions,
    find_motions,
    scale,
    shift_motion,
)
from texvent.interpolate.dis_flow.shifts import find_shift
from texvent.interpolate.dis_flow.things.fast_things import follow_fast_things, level_of_things
from texvent.runtime.allocator import keep_freed_memory

FlowArray = NDArray[np.float32]

SMALL_SIDE_PX = 100
"""Frames with a shorter side than this are matched up to full size, others up to half size: patches
of 8×8 px on half-size images are coarse for a small frame."""
LEAST_SIDE_PX = 2 * PATCH
"""Smaller frames are padded to this side by repeating their edges."""
FULL_RANGE, LEAST_RANGE = 255.0, 16.0
"""Both frames are stretched to the full range, for which the constants of the search are made. A
smaller range counts as `LEAST_RANGE`, so that the noise of a flat frame does not become texture."""


class DisFlow:
    """Dense inverse search on stretched copies of the frames.

    The result does not depend on the number of threads, nor on the pairs before.

    Source: Kroeger et al., Fast Optical Flow using Dense Inverse Search (ECCV 2016).
    """

    def __init__(self) -> None:
        keep_freed_memory()
        # One thread per direction where there is more than one core; it ends with this object.
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
        shape = first.shape
        images = [_pad_small(image) for image in stretch(first, second)]
        finest = 0 if min(shape) < SMALL_SIDE_PX else 1
        levels = max(finest, count_levels(images[0].shape))
        earlier, later = (make_pyramid(one, finest, levels, flow_cpu) for one in images)
        shift = find_shift(earlier, later)
        motions = NO_MOTIONS if shift is None else (shift_motion(shift), shift_motion(-shift))
        number = level_of_things(earlier)
        one, other = earlier[number], later[number]
        flows = self._follow(earlier[number:], later[number:], scale(motions, 0.5**number))
        found = find_motions(one, other, flows, flow_cpu)
        if found is not None:
            motions = scale(found, 2.0**number)
            flows = self._both(
                _match_again, (one, other, flows[0], found[0]), (other, one, flows[1], found[1])
            )
        is_full_size = finest == number == 0
        flows = follow_fast_things(one, other, flows, flow_cpu, is_full_size=is_full_size)
        if number:
            flows = self._follow(earlier[:number], later[:number], motions, flows)
        full = images[0].shape

        def enlarge(planes: Floats) -> FlowArray:
            planes = flow_cpu.double(planes, full) if finest else planes
            return np.stack([plane[: shape[0], : shape[1]] for plane in planes], axis=-1)

        return self._both(enlarge, (flows[0],), (flows[1],))

    def _follow(
        self,
        earlier: list[Floats],
        later: list[Floats],
        motions: Motions,
        coarser: tuple[Floats, Floats] | tuple[None, None] = (None, None),
    ) -> tuple[Floats, Floats]:
        """Both flows between some levels, from those of the next coarser level."""
        return self._both(
            partial(coarse_to_fine, kernels=flow_cpu),
            (earlier, later, motions[0], coarser[0]),
            (later, earlier, motions[1], coarser[1]),
        )

    def _both(
        self, function: Callable[..., Floats], ahead: tuple[Any, ...], back: tuple[Any, ...]
    ) -> tuple[Floats, Floats]:
        """What a function returns for each direction, in two threads if there are."""
        if self._helper is None:
            return function(*ahead), function(*back)
        other = self._helper.submit(function, *back)
        return function(*ahead), other.result()


def _match_again(start: Floats, stop: Floats, flow: Floats, motion: Floats) -> Floats:
    return match_level(start, stop, flow, False, motion=motion, kernels=flow_cpu)


def stretch(
    first: NDArray[np.float32], second: NDArray[np.float32]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Copies of two frames with one common scale, from their darkest to their brightest level."""
    low = min(first.min(), second.min())
    high = max(first.max(), second.max())
    gain = np.float32(FULL_RANGE / max(float(high) - float(low), LEAST_RANGE))
    return (first - low) * gain, (second - low) * gain


def _pad_small(image: NDArray[np.float32]) -> NDArray[np.float32]:
    height, width = image.shape
    below, right = max(0, LEAST_SIDE_PX - height), max(0, LEAST_SIDE_PX - width)
    if below == 0 and right == 0:
        return image
    return np.pad(image, ((0, below), (0, right)), mode="edge")
