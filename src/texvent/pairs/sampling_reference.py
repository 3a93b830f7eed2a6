"""Samples of an image between its pixels, as they are defined (NumPy, float32 or float64)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[Any]
"""float32; float64 to measure the rounding of float32."""


def sample_along(
    image: FloatArray, flow: FloatArray, shift: FloatArray
) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Samples of an image at displaced places; places outside take its nearest edge.

    Along an axis, between pixels p1 and p2 with p0 and p3 beside them, a sample is the mean of the
    parabolas through p0, p1, p2 and through p1, p2, p3: `p1 + u (p2 − p1) − u (1 − u) s`, with the
    bend `s = (p0 − p1 − p2 + p3) / 4`. In two dimensions the bends of both axes, each mixed
    linearly along the other one, are taken off the bilinear sample; the result is limited to the
    range of the four pixels around the place.

    Args:
        image: [H, W].
        flow: [H, W, 2].
        shift: of each pixel's place, [H, W, 2] as (x, y), px.

    Returns:
        The image there, the flow of the nearest pixel, and whether the place lies inside the image,
        whose pixels reach half a pixel past their centres.

    Source: the piecewise parabolic interpolator of Erup, Gardner and Harris (IEEE Transactions on
        Communications 41, 1993) with α = 1/4, which gives parabolas exactly. The sum of both axes
        and the limit are ours.
    """
    height, width = image.shape
    row, column = np.mgrid[:height, :width]
    kind = image.dtype
    x = np.clip(shift[..., 0], (-column).astype(kind), (width - 1 - column).astype(kind))
    y = np.clip(shift[..., 1], (-row).astype(kind), (height - 1 - row).astype(kind))
    outside = np.maximum(np.abs(shift[..., 0] - x), np.abs(shift[..., 1] - y))
    left, top = np.floor(x), np.floor(y)
    u, v = x - left, y - top
    left, top = column + left.astype(np.intp), row + top.astype(np.intp)
    right, bottom = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    corners = image[top, left], image[top, right], image[bottom, left], image[bottom, right]
    upper = corners[0] + (corners[1] - corners[0]) * u
    lower = corners[2] + (corners[3] - corners[2]) * u
    straight = upper + (lower - upper) * v
    bend_x, bend_y = find_bends(image)
    along = bend_x[top, left] + (bend_x[bottom, left] - bend_x[top, left]) * v
    across = bend_y[top, left] + (bend_y[top, right] - bend_y[top, left]) * u
    sample = straight - (u * (1 - u) * along + v * (1 - v) * across)
    sample = np.clip(sample, np.minimum.reduce(corners), np.maximum.reduce(corners))
    nearest = np.where(v >= 0.5, bottom, top), np.where(u >= 0.5, right, left)
    return sample, flow[nearest], outside <= 0.5


def find_bends(image: FloatArray) -> tuple[FloatArray, FloatArray]:
    """How far brightness between two neighbours bends, for `sample_along`.

    A quarter of the sum of the changes of slope at both; at the edge the slope does not change.

    Args:
        image: [H, W].

    Returns:
        Between each pixel and its right neighbour, and between each and the one below, [H, W] each;
        0 where there is no neighbour.
    """
    return _find_bends_along(image), _find_bends_along(image.T).T


def _find_bends_along(image: FloatArray) -> FloatArray:
    turns, bends = np.zeros_like(image), np.zeros_like(image)
    middle = image[:, 1:-1]
    turns[:, 1:-1] = (image[:, :-2] - middle) + (image[:, 2:] - middle)
    bends[:, :-1] = 0.25 * (turns[:, :-1] + turns[:, 1:])
    return bends
