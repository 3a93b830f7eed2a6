"""Dense inverse search: the method and its constants.

Optical flow after Kroeger et al., Fast Optical Flow using Dense Inverse Search (ECCV 2016). On each
level of an image pyramid, from the coarsest to half size (of small images to full size):

1. *Search.* Patches of 8×8 px are searched for in the other frame by Gauss-Newton steps on their
   mean-free difference. A patch starts from the coarser level's flow, and keeps it where that
   explains it up to `EXPLAINED`; else it tries a neighbour's too (first those to the left and
   above; in a second pass those to the right and below). On the coarsest level it first tries the
   whole pixels around. Patches are three px apart, four on large levels.
   Where the motion of the whole frame is known (`frame_motion.py`), every patch then tries it. A
   patch that it takes out of the view follows it if it was not found elsewhere.
2. *Join.* The flow of a pixel is the weighted mean over the patches that contain it; those that
   fit the pixel better count more.
3. *Refine*, except on large levels. One linearisation of brightness constancy with an
   edge-preserving smoothness term, solved by a few sweeps of red-black over-relaxation (after Brox
   et al., 2004).

A *level* is [3, H + 32, W + 32] float32: an image with `MARGIN` repeated pixels at each edge, then
its slopes to the right and downwards, levels per px. Flow is planar here: [2, H, W] float32, x
before y, px. `tests/interpolate/dis_flow/reference.py` defines the kernels in NumPy.

Deviation: Gauss-Newton steps of full length, so two do instead of 25; images keep their precision;
    no gradient constancy; whole pixels are tried on the coarsest level. More steps and sweeps
    are not better (docs/design.md).
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float32]
Mask: TypeAlias = NDArray[np.bool_]

PATCH = 8
"""Side of a patch, px."""
STEP, LARGE_STEP = 3, 4
"""Distance of patches, px: on most levels, and on large ones."""
LARGE_SIDE = 200
"""A level whose shorter side is at least this is large: its patches are fine enough for the picture
to be left as they are found, px."""
EXPLAINED = 256.0
"""Cost up to which a patch stays as it is, squared levels: two levels per pixel."""
MARGIN = 16
"""Repeated pixels at each edge: a patch may be outside the image."""
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
"""Flow is confirmed if the path there and back ends, squared, at most this share of its squared
length, plus this, px², from its start."""
UNEXPLAINED, NOISE_COST = 0.25, 64.0
"""A patch whose cost exceeds this share of its spread, plus this, was not found, squared levels."""

SWEEPS = 3
RELAXATION = 1.6
SMOOTHNESS, DATA = 10.0, 2.5
"""Weights of the two terms of the refinement."""
LEAST_SLOPE2 = 0.01
"""Added to the squared slope of the image, levels²/px²."""
LEAST2 = 1e-6
"""Added under square roots."""


def step_of(level: Floats) -> int:
    """Distance of a level's patches, px."""
    return LARGE_STEP if is_large(level) else STEP


def is_large(level: Floats) -> bool:
    """Whether a level is as large as `LARGE_SIDE`."""
    return min(size_of(level)) >= LARGE_SIDE


def size_of(level: Floats) -> tuple[int, int]:
    """Height and width without the margin."""
    _, height, width = level.shape
    return height - 2 * MARGIN, width - 2 * MARGIN
