"""Motion-compensated mixing of two frames, as it is defined (NumPy, float32)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.paths_reference import choose_paths
from texvent.pairs.sampling_reference import sample_along
from texvent.pairs.warp_tolerance import (
    LOST_PX2,
    LOST_RELATIVE,
    MOST_PX2,
    UNSEEN_WEIGHT,
    VISIBLE_PX2,
    VISIBLE_RELATIVE,
)

FloatArray = NDArray[Any]
"""float32; float64 to measure the rounding of float32."""


def warp_between(
    first: FloatArray,
    second: FloatArray,
    forward: FloatArray,
    backward: FloatArray,
    position: float,
) -> FloatArray:
    """The frame at `position` between two frames whose motion is known.

    Everything is computed in the type of the frames; in float32, the order of the operations is
    part of the definition.

    Args:
        first: the earlier frame, [H, W], intensity.
        second: the later frame, [H, W], intensity.
        forward: flow from first to second, [H, W, 2] as (x, y), px.
        backward: flow from second to first, [H, W, 2], px.
        position: τ, 0 = first, 1 = second.

    Returns:
        [H, W], intensity.

    Where both flows agree, the path is (1 − τ) times the one minus τ times the other; see
    `paths_reference`.

    Source: flows to the intermediate frame as in Jiang et al., Super SloMo (CVPR 2018), eq. 4,
        which are −τ and 1 − τ times the path below; the weights are ours: see `warp_tolerance.py`.
    """
    position = first.dtype.type(position)
    rest = first.dtype.type(1.0) - position
    path = choose_paths(forward, backward, position)
    length2 = np.minimum(_squared(path), MOST_PX2)

    a, path_first, is_in_first = sample_along(first, forward, -position * path)
    b, path_second, is_in_second = sample_along(second, backward, rest * path)
    error_first = np.minimum(_squared(path_first - path), MOST_PX2)
    error_second = np.minimum(_squared(path_second + path), MOST_PX2)

    # A frame's weight is its share of the time, times (how well it sees the point + UNSEEN_WEIGHT
    # times how little the other is trusted); both over one denominator, which cancels.
    visible = _squared_number(VISIBLE_RELATIVE * length2 + VISIBLE_PX2)
    doubt_first = visible + error_first * error_first
    doubt_second = visible + error_second * error_second
    # Outside its view a frame shows nothing.
    trust_first = np.where(is_in_first, visible / doubt_first, 0)
    trust_second = np.where(is_in_second, visible / doubt_second, 0)
    unseen_first, unseen_second = UNSEEN_WEIGHT * doubt_first, UNSEEN_WEIGHT * doubt_second
    seen_first = np.where(is_in_first, visible, 0) + unseen_first * (1 - trust_second)
    seen_second = np.where(is_in_second, visible, 0) + unseen_second * (1 - trust_first)
    weight_first = rest * (seen_first * doubt_second)
    weight_second = position * (seen_second * doubt_first)
    warped = a + (b - a) * (weight_second / (weight_first + weight_second))

    lost = _squared_number(LOST_RELATIVE * length2 + LOST_PX2)
    confidence = lost / (lost + _squared_number(np.minimum(error_first, error_second)))
    blended = first + (second - first) * position
    return np.asarray(blended + (warped - blended) * confidence)


def _squared(vectors: FloatArray) -> FloatArray:
    return np.asarray(vectors[..., 0] * vectors[..., 0] + vectors[..., 1] * vectors[..., 1])


def _squared_number(number: FloatArray) -> FloatArray:
    return number * number
