"""Dense optical flow between two frames by dense inverse search, in both directions.

Flow is searched on a pyramid of images: levels, and flow carried to the next finer one, are
compiled.
"""

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
    MARGIN,
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
from texvent.interpolate.dis_flow.refine import change_along, refine
from texvent.interpolate.dis_flow.search import join, search, try_vectors
from texvent.runtime.jit import jit
from texvent.runtime.memory import keep_freed_memory

# As float32: Numba computes with float64 where a constant is one.
_2 = np.float32(2.0)
_HALF = np.float32(0.5)
_EIGHTH = np.float32(0.125)
_QUARTER = np.float32(0.25)


@jit
def halve(image: Floats) -> Floats:
    """Means of 2×2 pixels; an odd last row or column counts twice."""
    height, width = image.shape
    half = np.empty(((height + 1) // 2, (width + 1) // 2), np.float32)
    for row in range(half.shape[0]):
        upper, lower = image[2 * row], image[min(2 * row + 1, height - 1)]
        out = half[row]
        for x in range(width // 2):
            left, right = upper[2 * x] + lower[2 * x], upper[2 * x + 1] + lower[2 * x + 1]
            out[x] = (left + right) * _QUARTER
        if width % 2:
            left = upper[width - 1] + lower[width - 1]
            out[width // 2] = (left + left) * _QUARTER
    return half


@jit
def make_level(image: Floats) -> Floats:
    """The image with its edges repeated, and its slopes; see `definitions`."""
    height, width = image.shape
    level = np.zeros((3, height + 2 * MARGIN, width + 2 * MARGIN), np.float32)
    padded = level[0]
    for row in range(padded.shape[0]):
        source, target = image[min(max(row - MARGIN, 0), height - 1)], padded[row]
        for x in range(MARGIN):
            target[x], target[MARGIN + width + x] = source[0], source[width - 1]
        for x in range(width):
            target[MARGIN + x] = source[x]
    inner, near = slice(MARGIN, MARGIN + width), slice(MARGIN - 1, MARGIN + width + 1)
    for row in range(MARGIN, MARGIN + height):
        above, here, below = padded[row - 1, near], padded[row, near], padded[row + 1, near]
        _find_slopes(above, here, below, level[1, row, inner], level[2, row, inner])
    return level


@jit(error_model="numpy", inner=True)
def _find_slopes(
    above: Floats, here: Floats, below: Floats, slope_x: Floats, slope_y: Floats
) -> None:
    for x in range(slope_x.size):
        outer = (above[x + 2] - above[x]) + (below[x + 2] - below[x])
        slope_x[x] = (outer + _2 * (here[x + 2] - here[x])) * _EIGHTH
    for x in range(slope_y.size):
        outer = (below[x] - above[x]) + (below[x + 2] - above[x + 2])
        slope_y[x] = (outer + _2 * (below[x + 1] - above[x + 1])) * _EIGHTH


@jit
def double(flow: Floats, shape: tuple[int, int]) -> Floats:
    """The flow of an image of twice the size: bilinear, between the centres of pixels."""
    _, height, width = flow.shape
    result = np.empty((2, shape[0], shape[1]), np.float32)
    mixed, wide = np.empty(width + 2, np.float32), np.empty(2 * width, np.float32)
    inner = mixed[1 : width + 1]
    for axis in range(2):
        for row in range(shape[0]):
            near = row // 2
            far = min(max(near + (1 if row % 2 else -1), 0), height - 1)
            one, other = flow[axis, near], flow[axis, far]
            for x in range(width):
                # Half of it is the mean, the other half the scale.
                inner[x] = np.float32(1.5) * one[x] + _HALF * other[x]
            mixed[0], mixed[width + 1] = inner[0], inner[width - 1]
            for x in range(width):
                middle = np.float32(0.75) * inner[x]
                wide[2 * x] = middle + _QUARTER * mixed[x]
                wide[2 * x + 1] = middle + _QUARTER * mixed[x + 2]
            out = result[axis, row]
            for x in range(shape[1]):
                out[x] = wide[x]
    return result


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
