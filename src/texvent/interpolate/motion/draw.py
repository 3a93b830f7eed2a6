"""Draw an instant between two frames whose motion is known, compiled by Numba.

1. Every fragment of surface is put where its path leads (`splat.py`).
2. Brightness and coverage are read from the source frames where the fragments came from: by a cubic
   spline inside a layer, so that texture stays sharp; by area at contours, so that edges do too.
3. The nearer layer covers the farther one by its share of the pixel, in linear light. Where both
   frames see a layer, they are mixed by time.

`tests/interpolate/motion/reference.py` defines the same readably.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from texvent.interpolate.motion.layers import (
    Floats,
    Layers,
    Numbers,
    gamma_coded,
    linear,
)
from texvent.interpolate.motion.splat import (
    SAME_LAYER,
    SOURCE,
    OccludedLayer,
    find_overlapping_fragments,
    make_nearest_layer,
    number_overlaps,
    splat,
    splat_overlaps,
)
from texvent.runtime.jit import jit

SIMILAR, DIFFERENT = np.float32(0.25), np.float32(0.75)
"""Two frames whose coverage differs by less agree; by more, one of them cannot see the layer."""


class FrameSide(NamedTuple):
    """One frame of a pair and its paths to the other."""

    layers: Layers
    fragments: Floats
    """[n, FRAGMENT]; see `paths.list_fragments`."""


@jit(error_model="numpy")
def draw(
    first: FrameSide,
    second: FrameSide,
    position: np.float32,
    image: Floats,
) -> None:
    """Draw the instant at τ = `position` into `image`."""
    height, width = image.shape
    rest = np.float32(1.0) - position
    visible = make_nearest_layer(height, width)
    splat(first.fragments, position, 0, visible)
    splat(second.fragments, rest, SOURCE, visible)
    overlaps = number_overlaps(visible)
    occluded = OccludedLayer(
        np.zeros((len(overlaps), 2 * SOURCE), np.float32),
        np.full(len(overlaps), np.inf, np.float32),
    )
    if len(overlaps) > 1:
        chosen = find_overlapping_fragments(first.fragments, position, visible.number)
        others = find_overlapping_fragments(second.fragments, rest, visible.number)
        for is_far in (False, True):
            splat_overlaps(first.fragments, chosen, position, 0, visible, occluded, is_far)
            splat_overlaps(second.fragments, others, rest, SOURCE, visible, occluded, is_far)
    pixels = np.arange(height * width).astype(np.int32)
    near = (
        _gather(first.layers, visible.places, 0, pixels),
        _gather(second.layers, visible.places, SOURCE, pixels),
    )
    far = (
        _gather(first.layers, occluded.places, 0, overlaps),
        _gather(second.layers, occluded.places, SOURCE, overlaps),
    )
    _compose(position, visible.number, near, far, image)
    _hold(first.layers.value, second.layers.value, position, image)


@jit(error_model="numpy", inner=True)
def _compose(
    position: np.float32,
    number: Numbers,
    near: tuple[Floats, Floats],
    far: tuple[Floats, Floats],
    image: Floats,
) -> None:
    """Mix what both frames know of each pixel, and cover the farther layer by the nearer one."""
    height, width = image.shape
    near_1, near_2 = near
    far_1, far_2 = far
    for y in range(height):
        for x in range(width):
            k, overlap = y * width + x, number[y, x]
            share_1, value_1 = near_1[k, 0], near_1[k, 1]
            share_2, value_2 = near_2[k, 0], near_2[k, 1]
            level = _mix(share_1, value_1, share_2, value_2, position)
            if overlap:
                farther = _mix(
                    far_1[overlap, 0],
                    far_1[overlap, 1],
                    far_2[overlap, 0],
                    far_2[overlap, 1],
                    position,
                )
                share = _covered(share_1, share_2, position)
                if level < 0:
                    level = farther
                elif farther >= 0 and share < 1:
                    light = share * linear(float(level)) + (1.0 - share) * linear(float(farther))
                    level = np.float32(gamma_coded(float(light)))
            image[y, x] = level


@jit(error_model="numpy", inner=True)
def _hold(first: Floats, second: Floats, position: np.float32, image: Floats) -> None:
    """Mix both frames in place where no path leads."""
    height, width = image.shape
    for y in range(height):
        for x in range(width):
            if image[y, x] < 0:
                image[y, x] = first[y, x] + position * (second[y, x] - first[y, x])


@jit(error_model="numpy", inner=True)
def _covered(share_1: np.float32, share_2: np.float32, position: np.float32) -> np.float32:
    """Share of a pixel that the nearer layer covers.

    Mixed by time, unless one frame cannot see the layer: then that of the other one.
    """
    mixed = share_1 + position * (share_2 - share_1)
    apart = (abs(share_1 - share_2) - SIMILAR) / (DIFFERENT - SIMILAR)
    doubt = min(max(apart, np.float32(0.0)), np.float32(1.0))
    return min(mixed + doubt * (max(share_1, share_2) - mixed), np.float32(1.0))


@jit(error_model="numpy", inner=True)
def _mix(
    share_1: np.float32,
    value_1: np.float32,
    share_2: np.float32,
    value_2: np.float32,
    position: np.float32,
) -> np.float32:
    """Level of a layer by its share and level in both frames; -1 where neither sees it."""
    weight_1, weight_2 = share_1 * (np.float32(1.0) - position), share_2 * position
    total = weight_1 + weight_2
    if total <= 0:
        return np.float32(-1.0)
    return (weight_1 * value_1 + weight_2 * value_2) / total


@jit(error_model="numpy", inner=True)
def _gather(layers: Layers, places: Floats, index: int, pixels: Numbers) -> Floats:
    """Share and level of a layer in a frame.

    Args:
        layers: the frame.
        places: [n, 2 · SOURCE] where from.
        index: first column of this frame.
        pixels: [n] flat index of the pixel that each row belongs to.

    Returns:
        [n, 2] float32.
    """
    height, width = layers.order.shape
    order, is_plain, value = layers.order, layers.is_plain, layers.value
    spline, lowest, highest = layers.spline, layers.lowest, layers.highest
    found = np.zeros((len(places), 2), np.float32)
    half = np.float32(0.5)
    for k in range(len(places)):
        weight = places[k, index]
        if weight <= 0:
            continue
        shift_x, shift_y = places[k, index + 1] / weight, places[k, index + 2] / weight
        depth, limit = places[k, index + 3] / weight, places[k, index + 4] / weight
        y, x = pixels[k] // width, pixels[k] % width
        from_x = min(max(x + shift_x, np.float32(0.0)), np.float32(width - 1))
        from_y = min(max(y + shift_y, np.float32(0.0)), np.float32(height - 1))
        column, row = int(from_x), int(from_y)
        u, v = from_x - np.float32(column), from_y - np.float32(row)
        away = order[int(from_y + half), int(from_x + half)] - depth
        if is_plain[row, column] and abs(away) <= 3 * limit:
            level = _spline(spline, column, row, u, v)
            level = min(max(level, lowest[row, column]), highest[row, column])
            if u == 0 and v == 0:
                level = value[row, column]
            found[k, 0], found[k, 1] = 1.0, level
        else:
            arguments = column, row, u, v, depth, SAME_LAYER * limit
            found[k, 0], found[k, 1] = _at_contour(layers, *arguments)
    return found


@jit(error_model="numpy", inner=True)
def _at_contour(
    layers: Layers,
    column: int,
    row: int,
    u: np.float32,
    v: np.float32,
    depth: np.float32,
    limit: np.float32,
) -> tuple[np.float32, np.float32]:
    """Share and level of the layer at `depth` in a pixel that four overlap."""
    height, width = layers.order.shape
    one = np.float32(1.0)
    share, light = np.float32(0.0), np.float32(0.0)
    for corner in range(4):
        i, j = corner % 2, corner // 2
        # What of this pixel the new one overlaps.
        left, right = (np.float32(0.0), u) if i else (u, one)
        top, bottom = (np.float32(0.0), v) if j else (v, one)
        part = (right - left) * (bottom - top)
        if part <= 0:
            continue
        x, y = min(column + i, width - 1), min(row + j, height - 1)
        beyond = layers.other_pixel[y, x]
        step_x, step_y = (beyond % width - x, beyond // width - y) if beyond >= 0 else (0, 0)
        if abs(layers.order[y, x] - depth) <= limit:
            part *= _filled(layers.share[y, x], step_x, step_y, left, right, top, bottom)
            value = layers.value[y, x]
        elif abs(layers.other_order[y, x] - depth) <= limit:
            part *= _filled(layers.other_share[y, x], -step_x, -step_y, left, right, top, bottom)
            value = layers.other_value[y, x]
        else:
            continue
        share += part
        light += part * value
    if share <= np.float32(1e-4):
        return np.float32(0.0), np.float32(0.0)
    return share, light / share


@jit(error_model="numpy", inner=True)
def _filled(
    share: np.float32,
    step_x: int,
    step_y: int,
    left: np.float32,
    right: np.float32,
    top: np.float32,
    bottom: np.float32,
) -> np.float32:
    """Share of a rectangle in a pixel that a surface fills which covers `share` of the pixel.

    It is on the side away from the step across its contour; the contour is taken as straight.
    """
    one = np.float32(1.0)
    if share >= one or (step_x == 0 and step_y == 0):
        return share
    if step_x != 0:
        start, stop = (left, right) if step_x > 0 else (one - right, one - left)
    else:
        start, stop = (top, bottom) if step_y > 0 else (one - bottom, one - top)
    return np.float32(min(max((share - start) / (stop - start), np.float32(0.0)), one))


@jit(error_model="numpy", inner=True)
def _spline(spline: Floats, column: int, row: int, u: np.float32, v: np.float32) -> np.float32:
    """The cubic B-spline at (column + u, row + v), inside the image."""
    a0, a1, a2, a3 = _weights(u)
    b0, b1, b2, b3 = _weights(v)
    total = np.float32(0.0)
    for j in range(4):
        at = row - 1 + j
        line = (
            a0 * spline[at, column - 1]
            + a1 * spline[at, column]
            + a2 * spline[at, column + 1]
            + a3 * spline[at, column + 2]
        )
        total += line * (b0 if j == 0 else b1 if j == 1 else b2 if j == 2 else b3)
    return total


@jit(error_model="numpy", inner=True)
def _weights(u: np.float32) -> tuple[np.float32, np.float32, np.float32, np.float32]:
    one, sixth = np.float32(1.0), np.float32(1.0 / 6.0)
    rest, u2 = one - u, u * u
    u3 = u2 * u
    first, last = sixth * rest * rest * rest, sixth * u3
    second = np.float32(2.0 / 3.0) - u2 + np.float32(0.5) * u3
    return first, second, one - first - second - last, last
