"""Patch search and the flow of each pixel from its patches, compiled by Numba."""

from __future__ import annotations

import numpy as np

from texvent.interpolate.dis_flow.definitions import (
    EXPLAINED,
    LEAST_DETERMINANT,
    LEAST_DIFFERENCE,
    MARGIN,
    MOST_DRIFT,
    MOST_STEPS,
    NOISE_COST,
    PATCH,
    SAME_FLOW,
    SEARCH_COST,
    SEARCH_RADIUS,
    SMALL_STEP2,
    UNEXPLAINED,
    Floats,
)
from texvent.interpolate.dis_flow.patches import compare_patch, spread_patch
from texvent.runtime.jit import jit

# As float32: Numba computes with float64 where a constant is one.
_0 = np.float32(0.0)
_1 = np.float32(1.0)
_AREA = np.float32(PATCH * PATCH)
_MOST_DRIFT = np.float32(MOST_DRIFT)
_LEAST_DETERMINANT = np.float32(LEAST_DETERMINANT)
_SAME_FLOW = np.float32(SAME_FLOW)
_SMALL_STEP2 = np.float32(SMALL_STEP2)
_SEARCH_COST = np.float32(SEARCH_COST)
_LEAST_DIFFERENCE = np.float32(LEAST_DIFFERENCE)
_EXPLAINED = np.float32(EXPLAINED)
_OUTSIDE = np.float32(-PATCH)
_SIDE = np.float32(PATCH)
_UNEXPLAINED, _NOISE_COST = np.float32(UNEXPLAINED), np.float32(NOISE_COST)

Sums = tuple[np.float32, np.float32, np.float32, np.float32]
"""Sums of d, d², d·slope_x and d·slope_y over a patch."""
Vector = tuple[np.float32, np.float32]


@jit(error_model="numpy")
def search(start: Floats, stop: Floats, flow: Floats, step: int, is_coarsest: bool) -> Floats:
    """Flow of each patch, [rows, columns, 3]: x, y, cost."""
    _, height, width = flow.shape
    down, across = 1 + (height - PATCH) // step, 1 + (width - PATCH) // step
    found = np.empty((down, across, 3), np.float32)
    slopes = np.empty((down, across, 6), np.float32)
    level, target, shape = start.reshape(-1), stop.reshape(-1), start.shape[1:]
    for row in range(down):
        for column in range(across):
            here = row * step, column * step
            own = (
                flow[0, here[0] + PATCH // 2, here[1] + PATCH // 2],
                flow[1, here[0] + PATCH // 2, here[1] + PATCH // 2],
            )
            if is_coarsest:
                own = _search_integer(level, target, shape, here)
            sums = _compare(level, target, shape, here, own)
            patch, known = found[row, column], slopes[row, column]
            patch[0], patch[1], patch[2] = own[0], own[1], sums[1]
            if sums[1] > _EXPLAINED:
                _sum_slopes(level, target, shape, here, known)
                sums = _propagate(level, target, shape, here, sums, found, (row, column, -1))
                _gauss_newton(level, target, shape, here, sums, own, known, patch)
    for row in range(down - 1, -1, -1):
        for column in range(across - 1, -1, -1):
            here, patch = (row * step, column * step), found[row, column]
            if patch[2] <= _EXPLAINED:
                continue
            own, cost = (patch[0], patch[1]), patch[2]
            sums = _propagate(
                level, target, shape, here, (_0, cost, _0, _0), found, (row, column, 1)
            )
            if sums[1] < cost:
                _gauss_newton(level, target, shape, here, sums, own, slopes[row, column], patch)
    return found


@jit(error_model="numpy", inner=True)
def _compare(
    level: Floats, target: Floats, shape: tuple[int, int], here: tuple[int, int], flow: Vector
) -> Sums:
    """The sums of `compare_patch` for a patch and its place; the second one mean-free."""
    corner, weights = _place(shape, np.float32(here[1]) + flow[0], np.float32(here[0]) + flow[1])
    plane, place = shape[0] * shape[1], (here[0] + MARGIN) * shape[1] + here[1] + MARGIN
    sums = compare_patch(level, target, (plane, place, corner, shape[1]), weights)
    return sums[0], sums[1] - sums[0] * sums[0] / _AREA, sums[2], sums[3]


@jit(error_model="numpy", inner=True)
def _place(shape: tuple[int, int], x: np.float32, y: np.float32) -> tuple[int, Sums]:
    """Flat index of the pixel up left of a place, and bilinear weights of it and the others.

    Places are at most a patch outside the image.
    """
    x = min(max(_OUTSIDE, x), np.float32(shape[1] - 2 * MARGIN))
    y = min(max(_OUTSIDE, y), np.float32(shape[0] - 2 * MARGIN))
    left, top = np.floor(x), np.floor(y)
    u, v = x - left, y - top
    corner = (int(top) + MARGIN) * shape[1] + int(left) + MARGIN
    return corner, ((_1 - u) * (_1 - v), u * (_1 - v), (_1 - u) * v, u * v)


@jit(error_model="numpy", inner=True)
def _sum_slopes(
    level: Floats, target: Floats, shape: tuple[int, int], here: tuple[int, int], sums: Floats
) -> None:
    """Fill in the sums over slopes that Gauss-Newton steps need: xx, xy, yy, x, y, determinant."""
    plane, place = shape[0] * shape[1], (here[0] + MARGIN) * shape[1] + here[1] + MARGIN
    nothing = _0, _0, _0, _0
    # Zero minus a slope is the negative slope. Here slope_y is the patch, and slope_x the array
    # before it.
    y, yy, xy, _ = compare_patch(
        level, target, (-plane, place + 2 * plane, place, shape[1]), nothing
    )
    x, xx, _, _ = compare_patch(level, target, (0, place + plane, place, shape[1]), nothing)
    x, y = -x, -y
    xx = xx - x * x / _AREA + _LEAST_DETERMINANT
    xy = -xy - x * y / _AREA
    yy = yy - y * y / _AREA + _LEAST_DETERMINANT
    sums[0], sums[1], sums[2], sums[3], sums[4], sums[5] = xx, xy, yy, x, y, xx * yy - xy * xy


@jit(error_model="numpy", inner=True)
def _spread_of(level: Floats, shape: tuple[int, int], here: tuple[int, int]) -> np.float32:
    """Mean-free squares of a patch, summed."""
    place = (here[0] + MARGIN) * shape[1] + here[1] + MARGIN
    layout = shape[0] * shape[1], place, place, shape[1]
    total, squares, _, _ = compare_patch(level, level, layout, (_0, _0, _0, _0))
    return np.float32(squares - total * total / _AREA)


@jit(error_model="numpy", inner=True)
def _search_integer(
    level: Floats, target: Floats, shape: tuple[int, int], here: tuple[int, int]
) -> Vector:
    """The best displacement by whole pixels."""
    least, best = np.float32(np.inf), (_0, _0)
    for down in range(-SEARCH_RADIUS, SEARCH_RADIUS + 1):
        for right in range(-SEARCH_RADIUS, SEARCH_RADIUS + 1):
            flow = np.float32(right), np.float32(down)
            _, cost, _, _ = _compare(level, target, shape, here, flow)
            cost += _SEARCH_COST * np.float32(right * right + down * down)
            if cost < least:
                least, best = cost, flow
    return best


@jit(error_model="numpy", inner=True)
def _propagate(
    level: Floats,
    target: Floats,
    shape: tuple[int, int],
    here: tuple[int, int],
    sums: Sums,
    found: Floats,
    patch: tuple[int, int, int],
) -> Sums:
    """Give a patch the flow of a neighbour, beside it or above or below, if it fits better.

    Args:
        level: level of the patch, flat.
        target: the other image, flat.
        shape: of both, with margins.
        here: row and column of the patch's first pixel.
        sums: of `_compare` with its own flow.
        found: of all patches.
        patch: row and column in `found`, and the direction of its neighbours, −1 or 1.

    Returns:
        The sums with the flow that it has now.
    """
    row, column, direction = patch
    own = found[row, column]
    for turn in range(2):
        i, j = (row, column + direction) if turn == 0 else (row + direction, column)
        if i < 0 or j < 0 or i >= found.shape[0] or j >= found.shape[1]:
            continue
        u, v = found[i, j, 0], found[i, j, 1]
        if abs(u - own[0]) + abs(v - own[1]) < _SAME_FLOW:
            continue
        other = _compare(level, target, shape, here, (u, v))
        if other[1] < own[2]:
            own[0], own[1], own[2] = u, v, other[1]
            sums = other
    return sums


@jit(error_model="numpy", inner=True)
def _gauss_newton(
    level: Floats,
    target: Floats,
    shape: tuple[int, int],
    here: tuple[int, int],
    sums: Sums,
    begin: Vector,
    known: Floats,
    own: Floats,
) -> None:
    """Gauss-Newton steps, as long as they make a patch fit better.

    Args:
        level: level of the patch, flat.
        target: the other image, flat.
        shape: of both, with margins.
        here: row and column of the patch's first pixel.
        sums: of `_compare` with its own flow.
        begin: initial flow; the result stays within `MOST_DRIFT` of it.
        known: from `_sum_slopes`.
        own: flow and cost of the patch, changed.
    """
    xx, xy, yy, x, y, determinant = known[0], known[1], known[2], known[3], known[4], known[5]
    if not determinant > _LEAST_DETERMINANT:
        return
    mean, _, sum_x, sum_y = sums
    for _ in range(MOST_STEPS):
        sum_x, sum_y = sum_x - mean * x / _AREA, sum_y - mean * y / _AREA
        du = (yy * sum_x - xy * sum_y) / determinant
        dv = (xx * sum_y - xy * sum_x) / determinant
        u, v = own[0] - du, own[1] - dv
        if abs(u - begin[0]) > _MOST_DRIFT or abs(v - begin[1]) > _MOST_DRIFT:
            return
        mean, cost, sum_x, sum_y = _compare(level, target, shape, here, (u, v))
        if not cost < own[2]:
            return
        own[0], own[1], own[2] = u, v, cost
        if du * du + dv * dv < _SMALL_STEP2:
            return


@jit(error_model="numpy")
def try_vectors(start: Floats, stop: Floats, patches: Floats, step: int, vectors: Floats) -> Floats:
    """The patches, each with its vector if that fits no worse than its own flow."""
    found, known = patches.copy(), np.empty(6, np.float32)
    level, target, shape = start.reshape(-1), stop.reshape(-1), start.shape[1:]
    height, width = np.float32(shape[0] - 2 * MARGIN), np.float32(shape[1] - 2 * MARGIN)
    for row in range(found.shape[0]):
        for column in range(found.shape[1]):
            here, own = (row * step, column * step), found[row, column]
            u, v = vectors[row, column, 0], vectors[row, column, 1]
            if abs(u - own[0]) + abs(v - own[1]) < _SAME_FLOW:
                continue
            x, y = np.float32(here[1]) + u, np.float32(here[0]) + v
            if x < _0 or y < _0 or x > width - _SIDE or y > height - _SIDE:
                if own[2] > _UNEXPLAINED * _spread_of(level, shape, here) + _NOISE_COST:
                    own[0], own[1], own[2] = u, v, _0
                continue
            sums = _compare(level, target, shape, here, (u, v))
            if sums[1] < own[2] + _NOISE_COST:
                own[0], own[1], own[2] = u, v, sums[1]
                _sum_slopes(level, target, shape, here, known)
                _gauss_newton(level, target, shape, here, sums, (u, v), known, own)
    return found


@jit(error_model="numpy")
def join(start: Floats, stop: Floats, patches: Floats, step: int) -> Floats:
    """Flow of each pixel, [2, H, W], from those of the patches that contain it."""
    _, rows, columns = start.shape
    height, width = rows - 2 * MARGIN, columns - 2 * MARGIN
    sums = np.zeros((3, rows * columns), np.float32)
    level, target, flat_sums = start.reshape(-1), stop.reshape(-1), sums.reshape(-1)
    for i in range(patches.shape[0]):
        for j in range(patches.shape[1]):
            u, v = patches[i, j, 0], patches[i, j, 1]
            x, y = np.float32(j * step) + u, np.float32(i * step) + v
            corner, weights = _place((rows, columns), x, y)
            place = (i * step + MARGIN) * columns + j * step + MARGIN
            flow = u, v, _LEAST_DIFFERENCE
            layout = rows * columns, place, corner, columns
            spread_patch(level, target, layout, weights, flat_sums, flow)
    # Pixels in no patch, at the right and below, take the flow of the nearest pixel in one.
    last_row = (patches.shape[0] - 1) * step + PATCH - 1
    last_column = (patches.shape[1] - 1) * step + PATCH - 1
    joined = np.empty((2, height, width), np.float32)
    for y in range(height):
        first = (min(y, last_row) + MARGIN) * columns + MARGIN
        weight = sums[0, first : first + width]
        for axis in range(2):
            total, out = sums[axis + 1, first : first + width], joined[axis, y]
            for x in range(last_column + 1):
                out[x] = total[x] / weight[x]
            for x in range(last_column + 1, width):
                out[x] = out[last_column]
    return joined
