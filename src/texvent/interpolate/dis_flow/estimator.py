"""Dense optical flow between two frames by dense inverse search, in both directions."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.definitions import (
    CHANGED,
    PATCH,
    Floats,
    is_large,
    size_of,
    step_of,
)
from texvent.interpolate.dis_flow.frame_motion import (
    NO_MOTIONS,
    Flows,
    Motions,
    find_motions,
    find_shift,
    leads_outside,
    patch_vectors,
    pixel_vectors,
    scale_motion,
    shift_motion,
)
from texvent.interpolate.dis_flow.pyramid import double, halve, make_level
from texvent.interpolate.dis_flow.refine import change_along, refine
from texvent.interpolate.dis_flow.search import join, search, try_vectors
from texvent.runtime.memory import keep_freed_memory

FlowArray = NDArray[np.float32]

SMALL_SIDE_PX = 100
"""Frames with a shorter side than this have a vector for each pixel, others for each 2×2: patches
of 8×8 px on half-size images are coarse for a small frame."""
LEAST_SIDE_PX = 2 * PATCH
"""Smaller frames are padded to this side by repeating their edges."""
MOTION_SIDE_PX = 400
"""Longer side of the level on which the motion of the whole frame is fitted, at most."""
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
            Two flows, px of the frames, finite: [H, W, 2] float32 as (x, y), or half as many rows
            and columns (rounded up), a vector for each 2×2 px.
        """
        side = 1 if min(first.shape) < SMALL_SIDE_PX else 2
        one, other = ((image if side == 1 else halve(image)) for image in (first, second))
        shape = one.shape
        images = [_pad_small(image) for image in stretch(one, other)]
        levels = count_levels(images[0].shape)
        earlier, later = (make_pyramid(image, levels) for image in images)
        shift = find_shift(earlier, later)
        motions = NO_MOTIONS if shift is None else (shift_motion(shift), shift_motion(-shift))
        sides = [max(size_of(level)) for level in earlier]
        number = next((k for k, side in enumerate(sides) if side <= MOTION_SIDE_PX), len(sides) - 1)
        flows = self._follow(earlier[number:], later[number:], _scaled(motions, 0.5**number))
        one, other = earlier[number], later[number]
        found = find_motions(one, other, flows)
        if found is not None:
            motions = _scaled(found, 2.0**number)
            flows = self._both(
                match_level,
                (one, other, flows[0], False, found[0]),
                (other, one, flows[1], False, found[1]),
            )
        if number:
            flows = self._follow(earlier[:number], later[:number], motions, flows)
        ahead, back = (
            np.stack([side * plane[: shape[0], : shape[1]] for plane in flow], axis=-1)
            for flow in flows
        )
        return ahead, back

    def _follow(
        self,
        earlier: list[Floats],
        later: list[Floats],
        motions: Motions,
        coarser: Flows | tuple[None, None] = (None, None),
    ) -> Flows:
        """Both flows between some levels, from those of the next coarser level."""
        return self._both(
            coarse_to_fine,
            (earlier, later, motions[0], coarser[0]),
            (later, earlier, motions[1], coarser[1]),
        )

    def _both(
        self, function: Callable[..., Floats], ahead: tuple[Any, ...], back: tuple[Any, ...]
    ) -> Flows:
        """Results of a function for each direction, in two threads if there are."""
        if self._helper is None:
            return function(*ahead), function(*back)
        other = self._helper.submit(function, *back)
        return function(*ahead), other.result()


def count_levels(shape: tuple[int, int]) -> int:
    """Number of times an image is halved: until its longer side is about four patches.

    The shorter side stays at least one patch.
    """
    longest = round(math.log2(max(shape) / (4 * PATCH)))
    return max(0, min(longest, math.floor(math.log2(min(shape) / PATCH))))


def make_pyramid(image: Floats, coarsest: int) -> list[Floats]:
    """The levels of an image, the finest first; see `definitions`.

    Args:
        image: [H, W], about 0..255.
        coarsest: how often it is halved for the last level.
    """
    images = [image]
    for _ in range(coarsest):
        images.append(halve(images[-1]))
    return [make_level(one) for one in images]


def coarse_to_fine(
    start: list[Floats],
    stop: list[Floats],
    motion: Floats | None = None,
    coarser: Floats | None = None,
) -> Floats:
    """Flow from one image to another.

    Args:
        start: pyramid of the one.
        stop: pyramid of the other.
        motion: of the whole image, which patches try too; see `frame_motion.Motions`.
        coarser: the flow of the next coarser level, if levels have been matched already.

    Returns:
        [2, H, W] float32: x and y, px, of the finest level.
    """
    flow = np.zeros((2, *size_of(start[-1])), np.float32) if coarser is None else coarser
    for number in range(len(start) - 1, -1, -1):
        one, other = start[number], stop[number]
        is_coarsest = coarser is None and number == len(start) - 1
        if not is_coarsest:
            flow = double(flow, size_of(one))
        scaled = None if motion is None else scale_motion(motion, 0.5**number)
        flow = match_level(one, other, flow, is_coarsest, scaled)
    return flow


def match_level(
    start: Floats, stop: Floats, flow: Floats, is_coarsest: bool, motion: Floats | None = None
) -> Floats:
    """The flow from one level to another, from an initial flow: search, join, refine."""
    step = step_of(start)
    patches = search(start, stop, flow, step, is_coarsest)
    if motion is not None:
        patches = try_vectors(start, stop, patches, step, patch_vectors(motion, start))
    refined = join(start, stop, patches, step)
    if not is_large(start):
        refined = refine(start, stop, refined)
    if motion is None:
        return refined
    # Outside the view, brightness says nothing: what leaves it moves as the frame does.
    moved = pixel_vectors(motion, size_of(start))
    is_lost = np.abs(change_along(start, stop, refined)) > CHANGED
    return np.where(leads_outside(moved) & (leads_outside(refined) | is_lost), moved, refined)


def _scaled(motions: Motions, factor: float) -> Motions:
    """Both motions, for an image that is larger by a factor."""
    one, other = motions
    if one is None or other is None:
        return NO_MOTIONS
    return scale_motion(one, factor), scale_motion(other, factor)


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
