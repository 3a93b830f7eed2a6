"""Paths of the pixels of a frame to the other frame of its pair."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.motion.layers import Floats, Layers
from texvent.runtime.jit import jit

CURVE_LIMIT = np.float32(0.6)
"""Without the other frame's word, a path bends by at most this share of its length."""
AGREEMENT = np.float32(2.0)
"""The two frames' accelerations may differ by this factor; the larger is reduced to it."""
LEAST_MOTION_PX = np.float32(1e-3)
"""Shorter vectors are none."""
LEAST_BEND_PX = np.float32(0.01)
"""Paths that bend by less are straight."""
SAME_DEPTH = np.float32(0.1)
"""ln depth: a surface changes its distance by less than this between two frames."""
LEAST_STRETCH, MOST_STRETCH = np.float32(-0.9), np.float32(3.0)
"""Bounds of how a displacement changes from pixel to pixel."""

PATH = 11
"""Numbers per pixel: three coefficients of a cubic in x and y, change of ln depth, and how the
displacement changes along x and y, [dx/dx, dx/dy, dy/dx, dy/dy]."""

FRAGMENT = PATH + 4
"""Numbers per fragment of surface; see `list_fragments`."""


@jit
def make_paths(
    vectors: Floats,
    bend: Floats,
    other_bend: Floats,
    order: Floats,
    other_order: Floats,
    tolerance: Floats,
) -> Floats:
    """Paths from a frame (s = 0) to the other frame of the pair (s = 1).

    A pixel's second difference of position is known at both frames: `bend`, the sum of its forward
    and its backward vector, here and at the other frame where it arrives. Everett's formula then
    gives the cubic through four positions:

        x(s) = s F - s (1 - s) [(2 - s) b + (1 + s) b'] / 6

    Where the two disagree (something bounces or starts), the path is straight: a minmod limiter.

    Args:
        vectors: [H, W, 2] F, to the other frame, px; NaN where unknown.
        bend: [H, W, 2] b; an empty array where only two frames are known.
        other_bend: [H, W, 2] b' of the other frame, or an empty array.
        order: [H, W] ln depth.
        other_order: [H, W] ln depth of the other frame.
        tolerance: [H, W] of ln depth within a layer.

    Returns:
        [H, W, PATH] float32; the first number is NaN where the vector is unknown.
    """
    height, width = order.shape
    vectors = _without_noise(vectors)
    paths = np.zeros((height, width, PATH), np.float32)
    for y in range(height):
        for x in range(width):
            dx, dy = vectors[y, x, 0], vectors[y, x, 1]
            if not (math.isfinite(dx) and math.isfinite(dy)):
                paths[y, x, 0] = np.nan
                continue
            paths[y, x, 0], paths[y, x, 1] = dx, dy
            column, row = math.floor(x + dx + 0.5), math.floor(y + dy + 0.5)
            is_met = False
            if 0 <= column < width and 0 <= row < height:
                change = other_order[row, column] - order[y, x]
                is_met = abs(change) < SAME_DEPTH + tolerance[y, x]
                if is_met:
                    paths[y, x, 6] = change
            if bend.size and max(abs(bend[y, x, 0]), abs(bend[y, x, 1])) > LEAST_BEND_PX:
                has_other = is_met and other_bend.size > 0
                there = other_bend[row, column] if has_other else bend[y, x]
                _bend(paths[y, x], vectors[y, x], bend[y, x], there, has_other)
    for y in range(height):
        for x in range(width):
            for axis in range(2):
                along_x, along_y = _stretch(vectors, order, tolerance[y, x], x, y, axis)
                paths[y, x, 7 + axis], paths[y, x, 9 + axis] = along_x, along_y
    return paths


@jit(inner=True)
def _without_noise(vectors: Floats) -> Floats:
    """The vectors, with those shorter than `LEAST_MOTION_PX` set to 0."""
    result = vectors.copy()
    for y in range(len(result)):
        for x in range(result.shape[1]):
            if max(abs(result[y, x, 0]), abs(result[y, x, 1])) < LEAST_MOTION_PX:
                result[y, x] = 0.0
    return result


@jit(inner=True)
def _bend(path: Floats, vector: Floats, here: Floats, there: Floats, has_other: bool) -> None:
    """Add the terms of Everett's formula that bend the path."""
    length = math.hypot(here[0], here[1])
    other = math.hypot(there[0], there[1])
    if not (math.isfinite(length) and math.isfinite(other)):
        return
    if has_other and here[0] * there[0] + here[1] * there[1] <= 0:
        return
    if not has_other and length > CURVE_LIMIT * math.hypot(vector[0], vector[1]):
        return
    scale = min(1.0, AGREEMENT * other / max(length, 1e-9))
    other_scale = min(1.0, AGREEMENT * length / max(other, 1e-9))
    for axis in range(2):
        b, b_other = scale * here[axis], other_scale * there[axis]
        path[axis] -= (2.0 * b + b_other) / 6.0
        path[2 + axis] = b / 2.0
        path[4 + axis] = (b_other - b) / 6.0


@jit(inner=True)
def _stretch(
    vectors: Floats, order: Floats, tolerance: np.float32, x: int, y: int, axis: int
) -> tuple[np.float32, np.float32]:
    """Change of the displacement from pixel to pixel along an axis, within the layer."""
    height, width = order.shape
    along_x, along_y, number = np.float32(0.0), np.float32(0.0), 0
    for sign in (-1, 1):
        column, row = x + sign * (1 - axis), y + sign * axis
        if not (0 <= column < width and 0 <= row < height):
            continue
        if abs(order[row, column] - order[y, x]) >= tolerance:
            continue
        dx, dy = vectors[row, column, 0], vectors[row, column, 1]
        if math.isfinite(dx) and math.isfinite(dy):
            along_x += sign * (dx - vectors[y, x, 0])
            along_y += sign * (dy - vectors[y, x, 1])
            number += 1
    if number == 0 or not math.isfinite(along_x):
        return np.float32(0.0), np.float32(0.0)
    along_x, along_y = along_x / np.float32(number), along_y / np.float32(number)
    return (
        min(max(along_x, LEAST_STRETCH), MOST_STRETCH),
        min(max(along_y, LEAST_STRETCH), MOST_STRETCH),
    )


@jit
def list_fragments(layers: Layers, paths: Floats) -> Floats:
    """Every fragment of surface of a frame and its path: one per pixel, two at contours.

    Returns:
        [n, FRAGMENT] float32: x and y in the frame, the path, ln depth and its tolerance.
    """
    height, width = layers.order.shape
    count = 0
    for y in range(height):
        for x in range(width):
            count += not math.isnan(paths[y, x, 0])
            count += layers.other_pixel[y, x] >= 0
    fragments = np.empty((count, FRAGMENT), np.float32)
    count = 0
    for y in range(height):
        for x in range(width):
            if not math.isnan(paths[y, x, 0]):
                _write_fragment(fragments, count, (x, y), paths, (x, y))
                fragments[count, FRAGMENT - 2] = layers.order[y, x]
                fragments[count, FRAGMENT - 1] = layers.tolerance[y, x]
                count += 1
            other = layers.other_pixel[y, x]
            if other >= 0:
                donor = other % width, other // width
                _write_fragment(fragments, count, (x, y), paths, donor)
                fragments[count, FRAGMENT - 2] = layers.other_order[y, x]
                fragments[count, FRAGMENT - 1] = layers.tolerance[donor[1], donor[0]]
                count += 1
    return fragments


@jit(inner=True)
def _write_fragment(
    fragments: Floats, k: int, pixel: tuple[int, int], paths: Floats, donor: tuple[int, int]
) -> None:
    """Place and path of fragment `k`, which moves as the pixel `donor` does."""
    fragments[k, 0], fragments[k, 1] = pixel
    for j in range(PATH):
        fragments[k, 2 + j] = paths[donor[1], donor[0], j]


@jit
def reverse_vectors(vectors: Floats, order: Floats) -> Floats:
    """Vectors of the other frame back to this one, where they are not given.

    Every pixel leaves the negative of its vector where it arrives; the nearest one counts.

    Returns:
        [H, W, 2] px; NaN where nothing arrives.
    """
    height, width = order.shape
    result = np.full((height, width, 2), np.nan, np.float32)
    nearest = np.full((height, width), np.inf, np.float32)
    for y in range(height):
        for x in range(width):
            dx, dy = vectors[y, x, 0], vectors[y, x, 1]
            if not (math.isfinite(dx) and math.isfinite(dy)):
                continue
            left, top = math.floor(x + dx), math.floor(y + dy)
            for row in range(max(top, 0), min(top + 2, height)):
                for column in range(max(left, 0), min(left + 2, width)):
                    if order[y, x] < nearest[row, column]:
                        nearest[row, column] = order[y, x]
                        result[row, column, 0], result[row, column, 1] = -dx, -dy
    return result


def bend_of(forward: NDArray[np.float32] | None, backward: NDArray[np.float32] | None) -> Floats:
    """Second difference of position at a frame, [H, W, 2] px; empty where a side is unknown."""
    if forward is None or backward is None:
        return np.empty((0, 0, 2), np.float32)
    return np.ascontiguousarray(forward + backward, dtype=np.float32)
