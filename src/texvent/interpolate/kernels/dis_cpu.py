"""The parts of dense inverse search compiled by Numba: `dis_reference`, bit for bit."""

from __future__ import annotations

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.kernels.dis import (
    DATA,
    FARTHEST,
    FLAT,
    LEAST2,
    LEAST_DIFFERENCE,
    LEAST_SLOPE2,
    MARGIN,
    MOST_STEPS,
    PATCH,
    REACH,
    REACH_COST,
    RELAXATION,
    SAME,
    SMALL_STEP2,
    SMOOTHNESS,
    STEP,
    SWEEPS,
    Floats,
)
from texvent.interpolate.kernels.patches_cpu import compare_patch, spread_patch

# As float32: Numba computes with float64 where a constant is one.
_0, _1, _2, _HALF = np.float32(0.0), np.float32(1.0), np.float32(2.0), np.float32(0.5)
_EIGHTH, _QUARTER, _AREA = np.float32(0.125), np.float32(0.25), np.float32(PATCH * PATCH)
_FARTHEST, _FLAT, _SAME = np.float32(FARTHEST), np.float32(FLAT), np.float32(SAME)
_SMALL_STEP2, _REACH_COST = np.float32(SMALL_STEP2), np.float32(REACH_COST)
_LEAST_DIFFERENCE, _OUTSIDE = np.float32(LEAST_DIFFERENCE), np.float32(-PATCH)
_DATA, _SMOOTHNESS, _RELAXATION = np.float32(DATA), np.float32(SMOOTHNESS), np.float32(RELAXATION)
_LEAST2, _LEAST_SLOPE2 = np.float32(LEAST2), np.float32(LEAST_SLOPE2)

_part = numba.njit(
    cache=True, nogil=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True
)
"""For what other compiled functions alone call: it compiles sooner."""

Sums = tuple[np.float32, np.float32, np.float32, np.float32]
"""Of d, d², d·slope_x and d·slope_y over a patch."""
Vector = tuple[np.float32, np.float32]
Numbers = NDArray[np.int32]


@numba.njit(cache=True, nogil=True)
def halve(picture: Floats) -> Floats:
    """Means of 2×2 pixels; an odd last row or column counts twice."""
    height, width = picture.shape
    half = np.empty(((height + 1) // 2, (width + 1) // 2), np.float32)
    for row in range(half.shape[0]):
        upper, lower = picture[2 * row], picture[min(2 * row + 1, height - 1)]
        out = half[row]
        for x in range(width // 2):
            left, right = upper[2 * x] + lower[2 * x], upper[2 * x + 1] + lower[2 * x + 1]
            out[x] = (left + right) * _QUARTER
        if width % 2:
            left = upper[width - 1] + lower[width - 1]
            out[width // 2] = (left + left) * _QUARTER
    return half


@numba.njit(cache=True, nogil=True)
def make_level(picture: Floats) -> Floats:
    """The picture with its edges continued, and its slopes; see `dis.Kernels`."""
    height, width = picture.shape
    level = np.zeros((3, height + 2 * MARGIN, width + 2 * MARGIN), np.float32)
    padded = level[0]
    for row in range(padded.shape[0]):
        source, target = picture[min(max(row - MARGIN, 0), height - 1)], padded[row]
        for x in range(MARGIN):
            target[x], target[MARGIN + width + x] = source[0], source[width - 1]
        for x in range(width):
            target[MARGIN + x] = source[x]
    inner, near = slice(MARGIN, MARGIN + width), slice(MARGIN - 1, MARGIN + width + 1)
    for row in range(MARGIN, MARGIN + height):
        above, here, below = padded[row - 1, near], padded[row, near], padded[row + 1, near]
        _find_slopes(above, here, below, level[1, row, inner], level[2, row, inner])
    return level


@_part
def _find_slopes(
    above: Floats, here: Floats, below: Floats, slope_x: Floats, slope_y: Floats
) -> None:
    for x in range(slope_x.size):
        outer = (above[x + 2] - above[x]) + (below[x + 2] - below[x])
        slope_x[x] = (outer + _2 * (here[x + 2] - here[x])) * _EIGHTH
    for x in range(slope_y.size):
        outer = (below[x] - above[x]) + (below[x + 2] - above[x + 2])
        slope_y[x] = (outer + _2 * (below[x + 1] - above[x + 1])) * _EIGHTH


@numba.njit(cache=True, nogil=True)
def double(flow: Floats, shape: tuple[int, int]) -> Floats:
    """The flow of a picture of twice the size: bilinear, between the centres of pixels."""
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


@numba.njit(cache=True, nogil=True, error_model="numpy")
def search(start: Floats, stop: Floats, flow: Floats, is_coarsest: bool) -> Floats:
    """Flow of each patch, [rows, columns, 3]: x, y, and how well that fits."""
    _, height, width = flow.shape
    down, across = 1 + (height - PATCH) // STEP, 1 + (width - PATCH) // STEP
    found = np.empty((down, across, 3), np.float32)
    slopes = np.empty((down, across, 6), np.float32)
    level, sought, shape = start.reshape(-1), stop.reshape(-1), start.shape[1:]
    for row in range(down):
        for column in range(across):
            here = row * STEP, column * STEP
            own = (
                flow[0, here[0] + PATCH // 2, here[1] + PATCH // 2],
                flow[1, here[0] + PATCH // 2, here[1] + PATCH // 2],
            )
            if is_coarsest:
                own = _try_around(level, sought, shape, here)
            _sum_slopes(level, sought, shape, here, slopes[row, column])
            found[row, column, 0], found[row, column, 1] = own
            _, found[row, column, 2], _, _ = _compare(level, sought, shape, here, own)
            _ask(level, sought, shape, found, (row, column, -1))
            _descend(level, sought, shape, own, slopes, found, (row, column))
    for row in range(down - 1, -1, -1):
        for column in range(across - 1, -1, -1):
            own = found[row, column, 0], found[row, column, 1]
            if _ask(level, sought, shape, found, (row, column, 1)):
                _descend(level, sought, shape, own, slopes, found, (row, column))
    return found


@_part
def _compare(
    level: Floats, sought: Floats, shape: tuple[int, int], here: tuple[int, int], flow: Vector
) -> Sums:
    """The sums of `compare_patch` for a patch and its place, the second without the means'."""
    corner, weights = _place(shape, np.float32(here[1]) + flow[0], np.float32(here[0]) + flow[1])
    plane, place = shape[0] * shape[1], (here[0] + MARGIN) * shape[1] + here[1] + MARGIN
    sums = compare_patch(level, sought, (plane, place, corner, shape[1]), weights)
    return sums[0], sums[1] - sums[0] * sums[0] / _AREA, sums[2], sums[3]


@_part
def _place(shape: tuple[int, int], x: np.float32, y: np.float32) -> tuple[int, Sums]:
    """Flat index of the pixel up left of a place, and bilinear weights of it and the others.

    Nothing is sought further out than a patch.
    """
    x = min(max(_OUTSIDE, x), np.float32(shape[1] - 2 * MARGIN))
    y = min(max(_OUTSIDE, y), np.float32(shape[0] - 2 * MARGIN))
    left, top = np.floor(x), np.floor(y)
    u, v = x - left, y - top
    corner = (int(top) + MARGIN) * shape[1] + int(left) + MARGIN
    return corner, ((_1 - u) * (_1 - v), u * (_1 - v), (_1 - u) * v, u * v)


@_part
def _sum_slopes(
    level: Floats, sought: Floats, shape: tuple[int, int], here: tuple[int, int], sums: Floats
) -> None:
    """Fill in what steps of a patch need: slopes squared and summed (xx, xy, yy, x, y), det."""
    plane, place = shape[0] * shape[1], (here[0] + MARGIN) * shape[1] + here[1] + MARGIN
    nothing = _0, _0, _0, _0
    # The difference of nothing and a slope is the slope turned around. slope_y is the patch here,
    # and the array before it slope_x.
    y, yy, xy, _ = compare_patch(
        level, sought, (-plane, place + 2 * plane, place, shape[1]), nothing
    )
    x, xx, _, _ = compare_patch(level, sought, (0, place + plane, place, shape[1]), nothing)
    x, y = -x, -y
    xx = xx - x * x / _AREA + _FLAT
    xy = -xy - x * y / _AREA
    yy = yy - y * y / _AREA + _FLAT
    sums[0], sums[1], sums[2], sums[3], sums[4], sums[5] = xx, xy, yy, x, y, xx * yy - xy * xy


@_part
def _try_around(
    level: Floats, sought: Floats, shape: tuple[int, int], here: tuple[int, int]
) -> Vector:
    """The best of the whole pixels around."""
    least, best = np.float32(np.inf), (_0, _0)
    for down in range(-REACH, REACH + 1):
        for right in range(-REACH, REACH + 1):
            flow = np.float32(right), np.float32(down)
            _, cost, _, _ = _compare(level, sought, shape, here, flow)
            cost += _REACH_COST * np.float32(right * right + down * down)
            if cost < least:
                least, best = cost, flow
    return best


@_part
def _ask(
    level: Floats,
    sought: Floats,
    shape: tuple[int, int],
    found: Floats,
    patch: tuple[int, int, int],
) -> bool:
    """Let a patch take the flow of a neighbour, to one side and above or below, if it fits better.

    Args:
        level: the patch's, flat.
        sought: the other picture, flat.
        shape: of both, with margins.
        found: of all patches.
        patch: row and column in `found`, and which way its neighbours are, −1 or 1.

    Returns:
        Whether it has taken one.
    """
    row, column, way = patch
    here, own = (row * STEP, column * STEP), found[row, column]
    is_better = False
    for turn in range(2):
        i, j = (row, column + way) if turn == 0 else (row + way, column)
        if i < 0 or j < 0 or i >= found.shape[0] or j >= found.shape[1]:
            continue
        u, v = found[i, j, 0], found[i, j, 1]
        if abs(u - own[0]) + abs(v - own[1]) < _SAME:
            continue
        _, cost, _, _ = _compare(level, sought, shape, here, (u, v))
        if cost < own[2]:
            own[0], own[1], own[2] = u, v, cost
            is_better = True
    return is_better


@_part
def _descend(
    level: Floats,
    sought: Floats,
    shape: tuple[int, int],
    begin: Vector,
    slopes: Floats,
    found: Floats,
    patch: tuple[int, int],
) -> None:
    """Gauss-Newton steps, as long as they make a patch fit better.

    Args:
        level: the patch's, flat.
        sought: the other picture, flat.
        shape: of both, with margins.
        begin: flow from which it must not stray.
        slopes: of `_sum_slopes`, of all patches.
        found: of all patches.
        patch: row and column.
    """
    row, column = patch
    here, own, known = (row * STEP, column * STEP), found[row, column], slopes[row, column]
    xx, xy, yy, x, y, determinant = known[0], known[1], known[2], known[3], known[4], known[5]
    if not determinant > _FLAT:
        return
    mean, _, sum_x, sum_y = _compare(level, sought, shape, here, (own[0], own[1]))
    for _ in range(MOST_STEPS):
        sum_x, sum_y = sum_x - mean * x / _AREA, sum_y - mean * y / _AREA
        du = (yy * sum_x - xy * sum_y) / determinant
        dv = (xx * sum_y - xy * sum_x) / determinant
        u, v = own[0] - du, own[1] - dv
        if abs(u - begin[0]) > _FARTHEST or abs(v - begin[1]) > _FARTHEST:
            return
        mean, cost, sum_x, sum_y = _compare(level, sought, shape, here, (u, v))
        if not cost < own[2]:
            return
        own[0], own[1], own[2] = u, v, cost
        if du * du + dv * dv < _SMALL_STEP2:
            return


@numba.njit(cache=True, nogil=True, error_model="numpy")
def join(start: Floats, stop: Floats, patches: Floats) -> Floats:
    """Flow of each pixel, [2, H, W], from those of the patches that hold it."""
    _, rows, columns = start.shape
    height, width = rows - 2 * MARGIN, columns - 2 * MARGIN
    sums = np.zeros((3, rows * columns), np.float32)
    level, sought, target = start.reshape(-1), stop.reshape(-1), sums.reshape(-1)
    for i in range(patches.shape[0]):
        for j in range(patches.shape[1]):
            u, v = patches[i, j, 0], patches[i, j, 1]
            x, y = np.float32(j * STEP) + u, np.float32(i * STEP) + v
            corner, weights = _place((rows, columns), x, y)
            place = (i * STEP + MARGIN) * columns + j * STEP + MARGIN
            flow = u, v, _LEAST_DIFFERENCE
            layout = rows * columns, place, corner, columns
            spread_patch(level, sought, layout, weights, target, flow)
    # What no patch holds, at the right and below, is like its nearest pixel that one does.
    last_row = (patches.shape[0] - 1) * STEP + PATCH - 1
    last_column = (patches.shape[1] - 1) * STEP + PATCH - 1
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


@numba.njit(cache=True, nogil=True, error_model="numpy")
def refine(start: Floats, stop: Floats, flow: Floats) -> Floats:
    """The flow after a few sweeps towards constant brightness and smoothness."""
    _, height, width = flow.shape
    terms = _linearize(start[0], stop[0], flow)
    # A pixel of margin, so that every pixel has four neighbours; those outside weigh nothing.
    bonds = np.zeros((2, height + 2, width + 2), np.float32)
    _bind(flow, bonds)
    _solve(terms, bonds)
    now = np.zeros((2, height + 2, width + 2), np.float32)
    then = np.zeros((2, height + 2, width + 2), np.float32)
    _copy(flow, now, 0, 1)
    for turn in range(2 * SWEEPS):
        for y in range(height):
            _relax(now, then, bonds, terms, y, turn % 2)
        now, then = then, now
    refined = np.empty(flow.shape, np.float32)
    _copy(now, refined, 1, 0)
    return refined


@_part
def _copy(source: Floats, target: Floats, margin: int, new_margin: int) -> None:
    """Copy a flow that has some pixels of margin to where it has others."""
    for axis in range(2):
        for y in range(source.shape[1] - 2 * margin):
            old, new = source[axis, y + margin], target[axis, y + new_margin]
            for x in range(source.shape[2] - 2 * margin):
                new[x + new_margin] = old[x + margin]


@_part
def _linearize(start: Floats, stop: Floats, flow: Floats) -> Floats:
    """The data term: matrix (xx, xy, yy) and right side (x, y) of each pixel, [5, H, W]."""
    _, height, width = flow.shape
    columns = stop.shape[1]
    terms = np.empty((5, height, width), np.float32)
    middle, change = np.empty((height, width), np.float32), np.empty((height, width), np.float32)
    flat = stop.reshape(-1)
    corner, weights = np.empty(width, np.int32), np.empty((2, width), np.float32)
    corners = np.empty((4, width), np.float32)
    for y in range(height):
        _aim(flow[0, y], flow[1, y], y, (height, width), corner, weights)
        for x in range(width):
            i = corner[x]
            corners[0, x], corners[1, x] = flat[np.uint64(i)], flat[np.uint64(i + 1)]
            corners[2, x] = flat[np.uint64(i + columns)]
            corners[3, x] = flat[np.uint64(i + columns + 1)]
        here = start[y + MARGIN, MARGIN : MARGIN + width]
        _mix(corners, weights, here, middle[y], change[y])
    for y in range(height):
        rows = middle[max(y - 1, 0)], middle[y], middle[min(y + 1, height - 1)]
        _weigh(rows, change[y], (flow[0, y], flow[1, y]), terms, y)
    return terms


@_part
def _aim(
    u: Floats, v: Floats, y: int, shape: tuple[int, int], corner: Numbers, weights: Floats
) -> None:
    """Find where the pixels of a row are in the other picture."""
    right, below = weights[0], weights[1]
    height, width = np.float32(shape[0]), np.float32(shape[1])
    columns = np.int32(shape[1] + 2 * MARGIN)
    for x in range(u.size):
        place_x = min(max(_OUTSIDE, np.float32(x) + u[x]), width)
        place_y = min(max(_OUTSIDE, np.float32(y) + v[x]), height)
        left, top = np.floor(place_x), np.floor(place_y)
        right[x], below[x] = place_x - left, place_y - top
        corner[x] = (np.int32(top) + np.int32(MARGIN)) * columns + np.int32(left) + np.int32(MARGIN)


@_part
def _mix(corners: Floats, weights: Floats, here: Floats, middle: Floats, change: Floats) -> None:
    """Fill in the mean of both pictures, and by how much the other is brighter."""
    a, b, c, d = corners[0], corners[1], corners[2], corners[3]
    right, below = weights[0], weights[1]
    for x in range(here.size):
        upper = a[x] + (b[x] - a[x]) * right[x]
        lower = c[x] + (d[x] - c[x]) * right[x]
        there = upper + (lower - upper) * below[x]
        middle[x] = _HALF * (here[x] + there)
        change[x] = there - here[x]


@_part
def _weigh(
    rows: tuple[Floats, Floats, Floats],
    change: Floats,
    flow: tuple[Floats, Floats],
    terms: Floats,
    y: int,
) -> None:
    """Fill in the data term of a row."""
    above, here, below = rows
    u, v = flow
    xx, xy, yy, side_x, side_y = terms[0, y], terms[1, y], terms[2, y], terms[3, y], terms[4, y]
    slope_x, slope_y, weight = xx, yy, xy  # for the time being
    last = here.size - 1
    slope_x[0] = _HALF * (here[min(1, last)] - here[0])
    for x in range(1, last):
        slope_x[x] = _HALF * (here[x + 1] - here[x - 1])
    slope_x[last] = _HALF * (here[last] - here[max(last - 1, 0)])
    # Few arrays in a loop, or Numba does not find out that they do not overlap.
    for x in range(here.size):
        slope_y[x] = _HALF * (below[x] - above[x])
        length2 = slope_x[x] * slope_x[x] + slope_y[x] * slope_y[x] + _LEAST_SLOPE2
        weight[x] = _DATA / (np.sqrt(change[x] * change[x] / length2 + _LEAST2) * length2)
    for x in range(here.size):
        # What the linearisation says of the flow itself, not of its change.
        wanted = weight[x] * (slope_x[x] * u[x] + slope_y[x] * v[x] - change[x])
        side_x[x], side_y[x] = slope_x[x] * wanted, slope_y[x] * wanted
    for x in range(here.size):
        along, across, strength = slope_x[x], slope_y[x], weight[x]
        xx[x] = strength * along * along
        xy[x], yy[x] = strength * along * across, strength * across * across


@_part
def _bind(flow: Floats, bonds: Floats) -> None:
    """Fill in how much each pixel is drawn to the next one to the right and below, inside only."""
    _, height, width = flow.shape
    for y in range(height):
        u, v, u_below, v_below = flow[0, y], flow[1, y], flow[0, min(y + 1, height - 1)], flow[1, y]
        v_below = flow[1, min(y + 1, height - 1)]
        aside, down = bonds[0, y + 1, 1:], bonds[1, y + 1, 1:]
        for x in range(width - 1):
            ux, uy = u[x + 1] - u[x], u_below[x] - u[x]
            vx, vy = v[x + 1] - v[x], v_below[x] - v[x]
            bond = _SMOOTHNESS / np.sqrt(ux * ux + uy * uy + vx * vx + vy * vy + _LEAST2)
            aside[x], down[x] = bond, bond
        uy, vy = u_below[width - 1] - u[width - 1], v_below[width - 1] - v[width - 1]
        down[width - 1] = _SMOOTHNESS / np.sqrt(uy * uy + vy * vy + _LEAST2)
        if y == height - 1:
            for x in range(width):
                down[x] = _0


@_part
def _solve(terms: Floats, bonds: Floats) -> None:
    """Turn each pixel's matrix, with its bonds, into its inverse."""
    for y in range(terms.shape[1]):
        xx, xy, yy = terms[0, y], terms[1, y], terms[2, y]
        right, left = bonds[0, y + 1, 1:], bonds[0, y + 1]
        below, above = bonds[1, y + 1, 1:], bonds[1, y, 1:]
        for x in range(xx.size):
            bond = (left[x] + right[x]) + (above[x] + below[x])
            a, b, c = xx[x] + bond, xy[x], yy[x] + bond
            determinant = a * c - b * b
            xx[x], xy[x], yy[x] = c / determinant, -b / determinant, a / determinant


@_part
def _relax(now: Floats, then: Floats, bonds: Floats, terms: Floats, y: int, colour: int) -> None:
    """Move the fields of one colour in a row towards what their neighbours and the data want."""
    right, left = bonds[0, y + 1, 1:], bonds[0, y + 1]
    below, above = bonds[1, y + 1, 1:], bonds[1, y, 1:]
    xx, xy, yy, side_x, side_y = terms[0, y], terms[1, y], terms[2, y], terms[3, y], terms[4, y]
    u, u_above, u_below = now[0, y + 1], now[0, y, 1:], now[0, y + 2, 1:]
    v, v_above, v_below = now[1, y + 1], now[1, y, 1:], now[1, y + 2, 1:]
    new_u, new_v = then[0, y + 1, 1:], then[1, y + 1, 1:]
    for x in range(xx.size):
        p = side_x[x] + (
            (left[x] * u[x] + right[x] * u[x + 2]) + (above[x] * u_above[x] + below[x] * u_below[x])
        )
        q = side_y[x] + (
            (left[x] * v[x] + right[x] * v[x + 2]) + (above[x] * v_above[x] + below[x] * v_below[x])
        )
        is_moved = (x + y) & 1 == colour
        du, dv = xx[x] * p + xy[x] * q - u[x + 1], xy[x] * p + yy[x] * q - v[x + 1]
        new_u[x] = u[x + 1] + (_RELAXATION * du if is_moved else _0)
        new_v[x] = v[x + 1] + (_RELAXATION * dv if is_moved else _0)
