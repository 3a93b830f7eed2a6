"""Refinement of a flow, and the change of brightness along it; compiled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.definitions import (
    CHANGED,
    DATA,
    LEAST2,
    LEAST_SLOPE2,
    MARGIN,
    PATCH,
    RELAXATION,
    SAME_PX2,
    SAME_RELATIVE,
    SMOOTHNESS,
    SWEEPS,
    Floats,
    Mask,
)
from texvent.runtime.jit import jit

# As float32: Numba computes with float64 where a constant is one.
_0 = np.float32(0.0)
_HALF = np.float32(0.5)
_OUTSIDE = np.float32(-PATCH)
_DATA = np.float32(DATA)
_SMOOTHNESS = np.float32(SMOOTHNESS)
_RELAXATION = np.float32(RELAXATION)
_LEAST2 = np.float32(LEAST2)
_LEAST_SLOPE2 = np.float32(LEAST_SLOPE2)
_CHANGED = np.float32(CHANGED)
_SAME_RELATIVE, _SAME_PX2 = np.float32(SAME_RELATIVE), np.float32(SAME_PX2)

Numbers = NDArray[np.int32]


@jit(error_model="numpy")
def refine(start: Floats, stop: Floats, flow: Floats) -> Floats:
    """The flow after a few sweeps towards constant brightness and smoothness."""
    _, height, width = flow.shape
    terms = _linearize(start[0], stop[0], flow)
    # A margin of one pixel gives every pixel four neighbours; those outside have weight 0.
    smoothness = np.zeros((2, height + 2, width + 2), np.float32)
    _weigh_smoothness(flow, smoothness)
    _invert(terms, smoothness)
    now, moved = np.zeros((2, height + 2, width + 2), np.float32), np.empty((2, width), np.float32)
    _copy(flow, now, 0, 1)
    # Each turn follows the one before a row behind: a few rows stay in the nearest cache.
    for line in range(height + 2 * SWEEPS - 1):
        for turn in range(2 * SWEEPS):
            if 0 <= line - turn < height:
                _relax(now, moved, smoothness, terms, line - turn, turn % 2)
    refined = np.empty(flow.shape, np.float32)
    _copy(now, refined, 1, 0)
    return refined


@jit(error_model="numpy", inner=True)
def _copy(source: Floats, target: Floats, margin: int, new_margin: int) -> None:
    """Copy a flow into an array with another margin."""
    for axis in range(2):
        for y in range(source.shape[1] - 2 * margin):
            old, new = source[axis, y + margin], target[axis, y + new_margin]
            for x in range(source.shape[2] - 2 * margin):
                new[x + new_margin] = old[x + margin]


@jit(error_model="numpy")
def change_along(start: Floats, stop: Floats, flow: Floats) -> Floats:
    """Change of brightness along a flow, [H, W], levels."""
    _, change = _sample_along(start[0], stop[0], flow)
    return change


@jit(error_model="numpy")
def unconfirmed(start: Floats, stop: Floats, flow: Floats, back: Floats) -> Mask:
    """Pixels whose flow the other direction contradicts, or along which brightness changes."""
    _, height, width = flow.shape
    change = change_along(start, stop, flow)
    found = np.ones((height, width), np.bool_)
    for y in range(height):
        for x in range(width):
            u, v = flow[0, y, x], flow[1, y, x]
            column = int(np.floor(np.float32(x) + u + _HALF))
            row = int(np.floor(np.float32(y) + v + _HALF))
            if column < 0 or row < 0 or column >= width or row >= height:
                continue
            aside, down = u + back[0, row, column], v + back[1, row, column]
            contradicts = aside * aside + down * down > _SAME_RELATIVE * (u * u + v * v) + _SAME_PX2
            found[y, x] = contradicts or abs(change[y, x]) > _CHANGED
    return found


@jit(error_model="numpy", inner=True)
def _linearize(start: Floats, stop: Floats, flow: Floats) -> Floats:
    """The data term: matrix (xx, xy, yy) and right side (x, y) of each pixel, [5, H, W]."""
    _, height, width = flow.shape
    terms = np.empty((5, height, width), np.float32)
    middle, change = _sample_along(start, stop, flow)
    for y in range(height):
        rows = middle[max(y - 1, 0)], middle[y], middle[min(y + 1, height - 1)]
        _fill_data_term(rows, change[y], (flow[0, y], flow[1, y]), terms, y)
    return terms


@jit(error_model="numpy", inner=True)
def _sample_along(start: Floats, stop: Floats, flow: Floats) -> tuple[Floats, Floats]:
    """Mean of both images along a flow, and the change from one to the other, [H, W]."""
    _, height, width = flow.shape
    columns = stop.shape[1]
    middle, change = np.empty((height, width), np.float32), np.empty((height, width), np.float32)
    flat = stop.reshape(-1)
    corner, weights = np.empty(width, np.int32), np.empty((2, width), np.float32)
    corners = np.empty((4, width), np.float32)
    for y in range(height):
        _locate(flow[0, y], flow[1, y], y, (height, width), corner, weights)
        for x in range(width):
            i = corner[x]
            corners[0, x], corners[1, x] = flat[np.uint64(i)], flat[np.uint64(i + 1)]
            corners[2, x] = flat[np.uint64(i + columns)]
            corners[3, x] = flat[np.uint64(i + columns + 1)]
        here = start[y + MARGIN, MARGIN : MARGIN + width]
        _mix(corners, weights, here, middle[y], change[y])
    return middle, change


@jit(error_model="numpy", inner=True)
def _locate(
    u: Floats, v: Floats, y: int, shape: tuple[int, int], corner: Numbers, weights: Floats
) -> None:
    """Find the places of a row's pixels in the other image."""
    right, below = weights[0], weights[1]
    height, width = np.float32(shape[0]), np.float32(shape[1])
    columns = np.int32(shape[1] + 2 * MARGIN)
    for x in range(u.size):
        place_x = min(max(_OUTSIDE, np.float32(x) + u[x]), width)
        place_y = min(max(_OUTSIDE, np.float32(y) + v[x]), height)
        left, top = np.floor(place_x), np.floor(place_y)
        right[x], below[x] = place_x - left, place_y - top
        corner[x] = (np.int32(top) + np.int32(MARGIN)) * columns + np.int32(left) + np.int32(MARGIN)


@jit(error_model="numpy", inner=True)
def _mix(corners: Floats, weights: Floats, here: Floats, middle: Floats, change: Floats) -> None:
    """Fill in the mean of both images, and the change from one to the other."""
    a, b, c, d = corners[0], corners[1], corners[2], corners[3]
    right, below = weights[0], weights[1]
    for x in range(here.size):
        upper = a[x] + (b[x] - a[x]) * right[x]
        lower = c[x] + (d[x] - c[x]) * right[x]
        there = upper + (lower - upper) * below[x]
        middle[x] = _HALF * (here[x] + there)
        change[x] = there - here[x]


@jit(error_model="numpy", inner=True)
def _fill_data_term(
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
    slope_x, slope_y, weight = xx, yy, xy  # reused below
    last = here.size - 1
    slope_x[0] = _HALF * (here[min(1, last)] - here[0])
    for x in range(1, last):
        slope_x[x] = _HALF * (here[x + 1] - here[x - 1])
    slope_x[last] = _HALF * (here[last] - here[max(last - 1, 0)])
    # Few arrays per loop: else LLVM cannot prove that they do not overlap.
    for x in range(here.size):
        slope_y[x] = _HALF * (below[x] - above[x])
        length2 = slope_x[x] * slope_x[x] + slope_y[x] * slope_y[x] + _LEAST_SLOPE2
        weight[x] = _DATA / (np.sqrt(change[x] * change[x] / length2 + _LEAST2) * length2)
    for x in range(here.size):
        # The right side for the flow itself, not for its change.
        wanted = weight[x] * (slope_x[x] * u[x] + slope_y[x] * v[x] - change[x])
        side_x[x], side_y[x] = slope_x[x] * wanted, slope_y[x] * wanted
    for x in range(here.size):
        along, across, strength = slope_x[x], slope_y[x], weight[x]
        xx[x] = strength * along * along
        xy[x], yy[x] = strength * along * across, strength * across * across


@jit(error_model="numpy", inner=True)
def _weigh_smoothness(flow: Floats, smoothness: Floats) -> None:
    """Fill in the smoothness weights to the right and below, inside the image only."""
    _, height, width = flow.shape
    for y in range(height):
        under = min(y + 1, height - 1)
        u, v, u_below, v_below = flow[0, y], flow[1, y], flow[0, under], flow[1, under]
        aside, down = smoothness[0, y + 1, 1:], smoothness[1, y + 1, 1:]
        for x in range(width - 1):
            ux, uy = u[x + 1] - u[x], u_below[x] - u[x]
            vx, vy = v[x + 1] - v[x], v_below[x] - v[x]
            coupling = _SMOOTHNESS / np.sqrt(ux * ux + uy * uy + vx * vx + vy * vy + _LEAST2)
            aside[x], down[x] = coupling, coupling
        uy, vy = u_below[width - 1] - u[width - 1], v_below[width - 1] - v[width - 1]
        down[width - 1] = _SMOOTHNESS / np.sqrt(uy * uy + vy * vy + _LEAST2)
        if y == height - 1:
            for x in range(width):
                down[x] = _0


@jit(error_model="numpy", inner=True)
def _invert(terms: Floats, smoothness: Floats) -> None:
    """Add the smoothness weights to each pixel's matrix, and invert it."""
    for y in range(terms.shape[1]):
        xx, xy, yy = terms[0, y], terms[1, y], terms[2, y]
        right, left = smoothness[0, y + 1, 1:], smoothness[0, y + 1]
        below, above = smoothness[1, y + 1, 1:], smoothness[1, y, 1:]
        for x in range(xx.size):
            coupling = (left[x] + right[x]) + (above[x] + below[x])
            a, b, c = xx[x] + coupling, xy[x], yy[x] + coupling
            determinant = a * c - b * b
            xx[x], xy[x], yy[x] = c / determinant, -b / determinant, a / determinant


@jit(error_model="numpy", inner=True)
def _relax(
    now: Floats, moved: Floats, smoothness: Floats, terms: Floats, y: int, colour: int
) -> None:
    """Over-relax the pixels of one colour in a row."""
    right, left = smoothness[0, y + 1, 1:], smoothness[0, y + 1]
    below, above = smoothness[1, y + 1, 1:], smoothness[1, y, 1:]
    xx, xy, yy, side_x, side_y = terms[0, y], terms[1, y], terms[2, y], terms[3, y], terms[4, y]
    u, u_above, u_below = now[0, y + 1], now[0, y, 1:], now[0, y + 2, 1:]
    v, v_above, v_below = now[1, y + 1], now[1, y, 1:], now[1, y + 2, 1:]
    new_u, new_v = moved[0], moved[1]
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
    inner_u, inner_v = u[1:], v[1:]
    for x in range(xx.size):
        inner_u[x], inner_v[x] = new_u[x], new_v[x]
