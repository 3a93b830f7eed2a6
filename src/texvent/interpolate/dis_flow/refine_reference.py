"""The refinement of a flow as it is defined (NumPy, float32)."""

from __future__ import annotations

import numpy as np

from texvent.interpolate.dis_flow.definitions import (
    DATA,
    LEAST2,
    LEAST_SLOPE2,
    MARGIN,
    PATCH,
    RELAXATION,
    SMOOTHNESS,
    SWEEPS,
    Floats,
    size_of,
)


def refine(start: Floats, stop: Floats, flow: Floats) -> Floats:
    """The flow after a few sweeps towards constant brightness and smoothness.

    In each pixel flow w minimises Σ ψ_d (g·(w − w₀) + c)² + Σ ψ_s |w − w_n|² over its neighbours n,
    where w₀ is the flow before, g the slope of brightness and c its change along w₀. The weights ψ
    fall with the error of w₀.
    """
    _, height, width = flow.shape
    (xx, xy, yy), sides = _data_term(start, stop, flow)
    right, below = _smoothness_weights(flow)
    left, above = np.zeros_like(right), np.zeros_like(below)
    left[:, 1:], above[1:] = right[:, :-1], below[:-1]
    coupling = (left + right) + (above + below)
    a, b, c = xx + coupling, xy, yy + coupling
    determinant = a * c - b * b
    a, b, c = c / determinant, -b / determinant, a / determinant
    y, x = np.mgrid[:height, :width]
    now = np.pad(flow, ((0, 0), (1, 1), (1, 1)))
    for turn in range(2 * SWEEPS):
        aside = left * now[:, 1:-1, :-2] + right * now[:, 1:-1, 2:]
        p, q = sides + (aside + (above * now[:, :-2, 1:-1] + below * now[:, 2:, 1:-1]))
        wanted = np.stack([a * p + b * q, b * p + c * q])
        change = np.float32(RELAXATION) * (wanted - now[:, 1:-1, 1:-1])
        now[:, 1:-1, 1:-1] += np.where((x + y) % 2 == turn % 2, change, np.float32(0))
    return now[:, 1:-1, 1:-1]


def _data_term(start: Floats, stop: Floats, flow: Floats) -> tuple[Floats, Floats]:
    """Matrix (xx, xy, yy) and right side (x, y) of each pixel, [3, H, W] and [2, H, W]."""
    here, there = start[0, MARGIN:-MARGIN, MARGIN:-MARGIN], _sample_along(stop, flow)
    middle, change = np.float32(0.5) * (here + there), there - here
    padded = np.pad(middle, 1, mode="edge")
    slope_x = np.float32(0.5) * (padded[1:-1, 2:] - padded[1:-1, :-2])
    slope_y = np.float32(0.5) * (padded[2:, 1:-1] - padded[:-2, 1:-1])
    length2 = slope_x * slope_x + slope_y * slope_y + np.float32(LEAST_SLOPE2)
    error = np.sqrt(change * change / length2 + np.float32(LEAST2))
    weight = np.float32(DATA) / (error * length2)
    wanted = weight * (slope_x * flow[0] + slope_y * flow[1] - change)
    matrix = weight * slope_x * slope_x, weight * slope_x * slope_y, weight * slope_y * slope_y
    return np.stack(matrix), np.stack([slope_x * wanted, slope_y * wanted])


def change_along(start: Floats, stop: Floats, flow: Floats) -> Floats:
    """What brightness changes by along a flow, [H, W], levels."""
    return _sample_along(stop, flow) - start[0, MARGIN:-MARGIN, MARGIN:-MARGIN]


def _sample_along(stop: Floats, flow: Floats) -> Floats:
    """A level at the places of the moved pixels, [H, W], bilinear."""
    height, width = size_of(stop)
    row, column = np.mgrid[:height, :width].astype(np.float32)
    x = np.clip(column + flow[0], np.float32(-PATCH), np.float32(width))
    y = np.clip(row + flow[1], np.float32(-PATCH), np.float32(height))
    left, top = np.floor(x), np.floor(y)
    u, v = x - left, y - top
    i, j = top.astype(np.intp) + MARGIN, left.astype(np.intp) + MARGIN
    upper = stop[0, i, j] + (stop[0, i, j + 1] - stop[0, i, j]) * u
    lower = stop[0, i + 1, j] + (stop[0, i + 1, j + 1] - stop[0, i + 1, j]) * u
    seen: Floats = upper + (lower - upper) * v
    return seen


def _smoothness_weights(flow: Floats) -> tuple[Floats, Floats]:
    """Smoothness weights of each pixel and its right and lower neighbours, [H, W] each."""
    beside = np.diff(flow, axis=2, append=flow[:, :, -1:])
    down = np.diff(flow, axis=1, append=flow[:, -1:])
    slope2 = beside[0] * beside[0] + down[0] * down[0] + beside[1] * beside[1] + down[1] * down[1]
    coupling = np.float32(SMOOTHNESS) / np.sqrt(slope2 + np.float32(LEAST2))
    right, below = coupling.copy(), coupling.copy()
    right[:, -1] = below[-1] = 0.0
    return right, below
