"""Motion-compensated mixing of two frames, as it is defined (NumPy, float64)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array
from texvent.interpolate.kernels.tolerance import (
    LOST_PX2,
    LOST_RELATIVE,
    UNSEEN_WEIGHT,
    VISIBLE_PX2,
    VISIBLE_RELATIVE,
)


def warp_between(
    first: NDArray[np.float32],
    second: NDArray[np.float32],
    forward: NDArray[np.float32],
    backward: NDArray[np.float32],
    position: float,
) -> NDArray[np.float32]:
    """The picture at `position` between two frames whose motion is known.

    Args:
        first: the earlier frame, [H, W], intensity.
        second: the later frame, [H, W], intensity.
        forward: flow from first to second, [H, W, 2] as (x, y), px.
        backward: flow from second to first, [H, W, 2], px.
        position: τ, 0 = first, 1 = second.

    Returns:
        [H, W] float32, intensity.

    Source: flows to the intermediate frame as in Jiang et al., Super SloMo (CVPR 2018), eq. 4;
        the weights are ours: see `tolerance.py`.
    """
    height, width = first.shape
    y, x = np.mgrid[:height, :width].astype(np.float64)
    ahead, back = forward.astype(np.float64), backward.astype(np.float64)
    rest = 1.0 - position
    to_first = -rest * position * ahead + position * position * back
    to_second = rest * rest * ahead - rest * position * back
    path = to_second - to_first
    length2 = _squared(path)

    x_first, y_first = x + to_first[..., 0], y + to_first[..., 1]
    x_second, y_second = x + to_second[..., 0], y + to_second[..., 1]
    error_first = _squared(sample(ahead, x_first, y_first) - path)
    error_second = _squared(sample(back, x_second, y_second) + path)

    visible = VISIBLE_RELATIVE * length2 + VISIBLE_PX2
    seen_first = trust(error_first, visible) * inside(x_first, y_first, first.shape)
    seen_second = trust(error_second, visible) * inside(x_second, y_second, first.shape)
    weight_first = rest * (seen_first + UNSEEN_WEIGHT)
    weight_second = position * (seen_second + UNSEEN_WEIGHT)
    a, b = sample(first, x_first, y_first), sample(second, x_second, y_second)
    warped = a + (b - a) * (weight_second / (weight_first + weight_second))

    lost = LOST_RELATIVE * length2 + LOST_PX2
    confidence = trust(np.minimum(error_first, error_second), lost)
    blended = first + (second.astype(np.float64) - first) * position
    return np.asarray(blended + (warped - blended) * confidence, dtype=np.float32)


def trust(error2: Float64Array, tolerance2: Float64Array) -> Float64Array:
    """1 for no error, 1/2 at the tolerance, falling to 0 with the fourth power of the error."""
    ratio = error2 / tolerance2
    return np.asarray(1.0 / (1.0 + ratio * ratio))


def inside(x: Float64Array, y: Float64Array, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """Whether points lie on the picture, whose pixels reach half a pixel past their centres."""
    height, width = shape
    return (x >= -0.5) & (x <= width - 0.5) & (y >= -0.5) & (y <= height - 0.5)


def sample(picture: NDArray[Any], x: Float64Array, y: Float64Array) -> Float64Array:
    """Bilinear samples at (x, y); outside, the nearest edge pixel.

    Args:
        picture: [H, W] or [H, W, C].
        x: columns, px, [H, W].
        y: rows, px, [H, W].
    """
    height, width = picture.shape[:2]
    x, y = np.clip(x, 0.0, width - 1.0), np.clip(y, 0.0, height - 1.0)
    left, top = x.astype(np.intp), y.astype(np.intp)
    right, bottom = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    fx, fy = x - left, y - top
    if picture.ndim == 3:
        fx, fy = fx[..., np.newaxis], fy[..., np.newaxis]
    picture = picture.astype(np.float64)
    upper = picture[top, left] + (picture[top, right] - picture[top, left]) * fx
    lower = picture[bottom, left] + (picture[bottom, right] - picture[bottom, left]) * fx
    return np.asarray(upper + (lower - upper) * fy)


def _squared(vectors: Float64Array) -> Float64Array:
    return np.asarray(vectors[..., 0] * vectors[..., 0] + vectors[..., 1] * vectors[..., 1])
