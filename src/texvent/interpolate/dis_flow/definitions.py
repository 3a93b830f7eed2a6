"""Dense inverse search: the method, its constants, and the coarse-to-fine loop.

Optical flow after Kroeger et al., Fast Optical Flow using Dense Inverse Search (ECCV 2016). On each
level of an image pyramid, from the coarsest to half size:

1. *Search.* Patches of 8×8 px, three apart, are searched for in the other frame by Gauss-Newton
   steps on their mean-free difference. A patch starts from the coarser level's flow or from a
   neighbour's (first those to the left and above; in a second pass those to the right and below).
   On the coarsest level it first tries the whole pixels around.
   Where the motion of the whole frame is known (`shifts.find_shift`, `frame_motion.find_motion`),
   every patch then tries it. A patch that it takes out of the view follows it if it was not found
   elsewhere. Where it is not known, texture that repeats takes the nearest place that it fits:
   coarser levels cannot resolve it.
2. *Join.* The flow of a pixel is the weighted mean over the patches that contain it; those that
   fit the pixel better count more.
3. *Refine.* One linearisation of brightness constancy with an edge-preserving smoothness term,
   solved by a few sweeps of red-black over-relaxation (after Brox et al., 2004).

`flow_reference` defines the parts in NumPy float32, `flow_cpu` compiles them; the order of the
operations is part of the definition. Both have these functions (flow is planar here: [2, H, W], x
before y, px):

* `halve(image)`: means of 2×2 pixels; an odd last row or column counts twice.
* `make_level(image)`: [3, H + 32, W + 32]: the image with `MARGIN` repeated pixels at each edge,
  then its slopes to the right and downwards (Sobel, levels per px), 0 in the margin.
* `double(flow, shape)`: the flow of an image of twice the size, or a row or column less.
* `search(start, stop, flow, is_coarsest)`: the flow of each patch, from an initial flow:
  [rows, columns, 3], x, y and cost.
* `try_vectors(start, stop, patches, vectors)`: the patches, each with its vector if that fits no
  worse, within `NOISE_COST`: texture that repeats goes with the frame; vectors are [rows, columns,
  2], px.
* `take_nearest(start, stop, patches)`: the patches, each where texture repeats with the shortest of
  the flows that fit alike; a region whose surroundings have its flow keeps it.
* `join(start, stop, patches)`: the flow of each pixel.
* `refine(start, stop, flow)`: the refined flow.
* `change_along(start, stop, flow)`: what brightness changes by along a flow, [H, W], levels.
* `unconfirmed(start, stop, flow, back)`: [H, W], where brightness changes along the flow, or the
  flow of the other direction does not lead back.

Deviation: Gauss-Newton steps of full length, so two do instead of 25; images keep their precision;
    no gradient constancy; whole pixels are tried on the coarsest level. More steps and sweeps were
    not better (docs/speed.md).
"""

from __future__ import annotations

import math
from types import ModuleType
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float32]
Mask: TypeAlias = NDArray[np.bool_]

PATCH = 8
"""Side of a patch, px."""
STEP = 3
"""Distance of patches, px."""
MARGIN = 16
"""Repeated pixels at each edge: a patch may lie outside the image."""
MOST_STEPS = 2
"""Most Gauss-Newton steps."""
SMALL_STEP2 = 1e-3
"""A step of smaller squared length, px², is the last one."""
MOST_DRIFT = 8.0
"""Gauss-Newton steps end this far from their start, px."""
SAME_FLOW = 0.05
"""Flows that differ by less are not tried again, px."""
LEAST_DETERMINANT = 1e-3
"""A patch with a smaller determinant of the slopes has no texture to match. Also added to the
diagonal."""
SEARCH_RADIUS = 2
"""Whole pixels tried to each side on the coarsest level."""
SEARCH_COST = 8.0
"""Their cost per squared pixel, squared levels."""
LEAST_DIFFERENCE = 1.0
"""Patches that differ by less at a pixel have equal weights there, levels."""

CHANGED = 24.0
"""Change of brightness along its flow from which a pixel is not explained by it, of 255 levels."""
SAME_RELATIVE, SAME_PX2 = 0.02, 0.5
"""The way there and back may end this share of its squared length, plus this, px², from its start,
squared."""
UNEXPLAINED, NOISE_COST = 0.25, 64.0
"""A patch whose cost exceeds this share of its spread, plus this, was not found, squared levels."""

SPARSE = 4
"""Every fourth patch, across and down, is asked whether its texture repeats."""
REPEATED, LEAST_SPREAD = 0.2, 4096.0
"""Texture repeats where a patch fits two places: each costs at most this share of its spread, which
is at least this (squared levels, summed: 8 levels per pixel),"""
BETWEEN = 1.0
"""what lies between them costs more than this share: else the patch slides along an edge,"""
ALIKE = 0.1
"""and the nearer place costs at most this share of that more, plus `NOISE_COST`."""
LEAST_FLOW2, SHORTER2 = 2.0, 0.8
"""Flow of less squared length, px², is the nearest; a nearer place has at most this share of it."""
SAME_FLOW2 = 0.25
"""Patches whose flows differ by less, px², squared, go together."""
AGAINST = 0.03
"""Texture keeps its flow if this many patches around it, per patch, do not repeat and have it too:
they belong to the same thing."""

SWEEPS = 3
RELAXATION = 1.6
SMOOTHNESS, DATA = 10.0, 2.5
"""Weights of the two terms of the refinement."""
LEAST_SLOPE2 = 0.01
"""Added to the squared slope of the image, levels²/px²."""
LEAST2 = 1e-6
"""Added under square roots."""


def count_levels(shape: tuple[int, int]) -> int:
    """How often an image is halved: until its longer side is about four patches.

    The shorter side stays at least one patch.
    """
    longest = round(math.log2(max(shape) / (4 * PATCH)))
    return max(0, min(longest, math.floor(math.log2(min(shape) / PATCH))))


def make_pyramid(image: Floats, finest: int, coarsest: int, kernels: ModuleType) -> list[Floats]:
    """The levels of an image, the finest first.

    Args:
        image: [H, W], about 0..255.
        finest: how often the image is halved for the first level.
        coarsest: how often for the last level.
        kernels: `flow_reference` or `flow_cpu`.
    """
    images = [image]
    for _ in range(coarsest):
        images.append(kernels.halve(images[-1]))
    return [kernels.make_level(one) for one in images[finest:]]


def coarse_to_fine(
    start: list[Floats],
    stop: list[Floats],
    motion: Floats | None = None,
    coarser: Floats | None = None,
    *,
    kernels: ModuleType,
) -> Floats:
    """Flow from one image to another.

    Args:
        start: pyramid of the one.
        stop: pyramid of the other.
        motion: of the whole image, which patches try too; [2, 3]; see
            `scale_motion`.
        coarser: the flow of the next coarser level, if levels have been matched already.
        kernels: `flow_reference` or `flow_cpu`.

    Returns:
        [2, H, W] float32: x and y, px, of the finest level.
    """
    flow = np.zeros((2, *size_of(start[-1])), np.float32) if coarser is None else coarser
    for number in range(len(start) - 1, -1, -1):
        one, other, is_coarsest = start[number], stop[number], number == len(start) - 1
        is_coarsest &= coarser is None
        if not is_coarsest:
            flow = kernels.double(flow, size_of(one))
        scaled = None if motion is None else scale_motion(motion, 0.5**number)
        flow = match_level(one, other, flow, is_coarsest, motion=scaled, kernels=kernels)
    return flow


def match_level(
    start: Floats,
    stop: Floats,
    flow: Floats,
    is_coarsest: bool,
    *,
    kernels: ModuleType,
    motion: Floats | None = None,
) -> Floats:
    """The flow from one level to another, from an initial flow: search, join, refine."""
    patches = kernels.search(start, stop, flow, is_coarsest)
    if motion is not None:
        vectors = patch_vectors(motion, size_of(start))
        patches = kernels.try_vectors(start, stop, patches, vectors)
    elif not is_coarsest:
        patches = kernels.take_nearest(start, stop, patches)
    joined = kernels.join(start, stop, patches)
    refined: Floats = kernels.refine(start, stop, joined)
    if motion is None:
        return refined
    # Outside the view, brightness tells nothing.
    height, width = size_of(start)
    x = np.arange(width, dtype=np.float32) + np.float32(0.5 - width / 2)
    y = np.arange(height, dtype=np.float32) + np.float32(0.5 - height / 2)
    moved = np.moveaxis(vectors_at(motion, x, y[:, np.newaxis]), -1, 0)
    is_lost = np.abs(kernels.change_along(start, stop, refined)) > CHANGED
    return np.where(leads_outside(moved) & (leads_outside(refined) | is_lost), moved, refined)


def scale_motion(motion: Floats, factor: float) -> Floats:
    """The motion of the whole frame, for an image of another size.

    Args:
        motion: [2, 3]: x and y of the middle of the frame, px, then what they grow by per px to the
            right, and per px downwards.
        factor: how many times as large the image is.
    """
    return motion * np.array([factor, 1, 1], np.float32)


def vectors_at(motion: Floats, x: Floats, y: Floats) -> Floats:
    """What a motion moves places by, px from the middle of the frame; [..., 2] px."""
    return np.stack([own[0] + own[1] * x + own[2] * y for own in motion], axis=-1)


def patch_vectors(motion: Floats, shape: tuple[int, int]) -> Floats:
    """What a motion moves the middle of each patch by, [rows, columns, 2] px."""
    y, x = (
        np.arange(0, side - PATCH + 1, STEP).astype(np.float32) + np.float32((PATCH - side) / 2)
        for side in shape
    )
    return vectors_at(motion, x, y[:, np.newaxis])


def leads_outside(flow: Floats) -> Mask:
    """Whether each pixel's flow leads out of the image, [H, W]."""
    _, height, width = flow.shape
    y, x = np.ogrid[:height, :width]
    to_x, to_y = x + flow[0], y + flow[1]
    outside: Mask = (to_x < 0) | (to_y < 0) | (to_x > width - 1) | (to_y > height - 1)
    return outside


def size_of(level: Floats) -> tuple[int, int]:
    """Height and width without the margin."""
    _, height, width = level.shape
    return height - 2 * MARGIN, width - 2 * MARGIN
