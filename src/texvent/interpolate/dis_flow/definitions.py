"""Dense inverse search: what it does, its numbers, and the way from coarse to fine.

Optical flow after Kroeger et al., Fast Optical Flow using Dense Inverse Search (ECCV 2016). On each
of a pyramid's levels, from the coarsest to half size:

1. *Search.* Patches of 8×8 px, three apart, look for themselves in the other frame, from where the
   coarser level or a neighbour says (first those to the left and above, then, on a way back, those
   to the right and below), by Gauss-Newton steps that leave out the patch's mean. On the coarsest
   level they try whole pixels around first.
2. *Join.* The flow of a pixel is the mean over the patches that hold it, those that fit it better
   counting more.
3. *Refine.* One linearisation of brightness constancy with a smoothness that spares edges of the
   flow, solved by a few sweeps of over-relaxation over a chequerboard (after Brox et al., 2004).

`dis_reference` defines the parts in NumPy float32, `dis_cpu` has the same compiled; the order of
the operations is part of the definition. Both have these functions (flow is planar here: [2, H, W],
x before y, px):

* `halve(picture)`: means of 2×2 pixels; an odd last row or column counts twice.
* `make_level(picture)`: [3, H + 32, W + 32]: the picture with `MARGIN` at each edge, then its
  slopes to the right and downwards (Sobel's, levels per px), 0 in the margin.
* `double(flow, shape)`: the flow of a picture of twice the size, or a row or column less.
* `search(start, stop, flow, is_coarsest)`: what the patches of a level find in another, from a flow
  to begin with: [rows, columns, 3], x, y, and how well that fits.
* `join(start, stop, patches)`: the flow.
* `refine(start, stop, flow)`: the flow.

Deviation: Gauss-Newton steps of full length, so two do instead of 25; pictures keep their
    precision; no gradient constancy; whole pixels are tried on the coarsest level. More steps and
    sweeps were not better (docs/speed.md).
"""

from __future__ import annotations

import math
from types import ModuleType
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float32]

PATCH = 8
"""Side of a patch, px."""
STEP = 3
"""Distance of patches, px."""
MARGIN = 16
"""How far pictures are continued past their edges, px: a patch may lie outside altogether."""
MOST_STEPS = 2
"""Gauss-Newton steps at most."""
SMALL_STEP2 = 1e-3
"""Squared length of a step, px², after which no other follows."""
FARTHEST = 8.0
"""Steps lead no further than this from where they began, px."""
SAME = 0.05
"""A neighbour whose flow differs by less is not asked, px."""
FLAT = 1e-3
"""Below this determinant of the slopes a patch shows nothing that could be matched. Also added to
the diagonal."""
REACH = 2
"""Whole pixels that are tried to each side on the coarsest level, and ..."""
REACH_COST = 8.0
"""... what a squared pixel of them costs, in squared levels."""
LEAST_DIFFERENCE = 1.0
"""Patches that differ by less at a pixel count alike there, levels."""

SWEEPS = 3
RELAXATION = 1.6
SMOOTHNESS, DATA = 10.0, 2.5
"""Weights of both terms of the refinement."""
LEAST_SLOPE2 = 0.01
"""Added to the squared slope of the picture, levels²/px²."""
LEAST2 = 1e-6
"""Added to squares under a root."""


def count_levels(shape: tuple[int, int]) -> int:
    """How often a picture is halved: until its longer side is about four patches.

    The shorter side stays a patch at least.
    """
    longest = round(math.log2(max(shape) / (4 * PATCH)))
    return max(0, min(longest, math.floor(math.log2(min(shape) / PATCH))))


def make_pyramid(picture: Floats, finest: int, coarsest: int, kernels: ModuleType) -> list[Floats]:
    """The levels of a picture, the finest first.

    Args:
        picture: [H, W], levels of 0..255 or so.
        finest: how often the picture is halved for the first of them.
        coarsest: and for the last.
        kernels: that compute.
    """
    pictures = [picture]
    for _ in range(coarsest):
        pictures.append(kernels.halve(pictures[-1]))
    return [kernels.make_level(one) for one in pictures[finest:]]


def follow_levels(start: list[Floats], stop: list[Floats], kernels: ModuleType) -> Floats:
    """Flow from one picture to another.

    Args:
        start: pyramid of the one.
        stop: pyramid of the other.
        kernels: that compute.

    Returns:
        [2, H, W] float32: x and y, px, of the finest level.
    """
    flow = np.zeros((2, *size_of(start[-1])), np.float32)
    for number in range(len(start) - 1, -1, -1):
        one, other, is_coarsest = start[number], stop[number], number == len(start) - 1
        if not is_coarsest:
            flow = kernels.double(flow, size_of(one))
        flow = match(one, other, flow, is_coarsest, kernels=kernels)
    return flow


def match(
    start: Floats, stop: Floats, flow: Floats, is_coarsest: bool, *, kernels: ModuleType
) -> Floats:
    """The flow from a level to another, to begin with a flow: search, join, refine."""
    patches = kernels.search(start, stop, flow, is_coarsest)
    matched: Floats = kernels.refine(start, stop, kernels.join(start, stop, patches))
    return matched


def size_of(level: Floats) -> tuple[int, int]:
    """Height and width without the margin."""
    _, height, width = level.shape
    return height - 2 * MARGIN, width - 2 * MARGIN
