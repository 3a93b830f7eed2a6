"""Motion of the whole frame tried for every patch, compiled by Numba."""

from __future__ import annotations

import numpy as np

from texvent.interpolate.dis_flow.definitions import (
    MARGIN,
    NOISE_COST,
    PATCH,
    SAME_FLOW,
    STEP,
    UNEXPLAINED,
    Floats,
)
from texvent.interpolate.dis_flow.search_cpu import compare, gauss_newton, spread_of, sum_slopes
from texvent.runtime.jit import jit

# As float32: Numba computes with float64 where a constant is one.
_0 = np.float32(0.0)
_SIDE = np.float32(PATCH)
_SAME_FLOW = np.float32(SAME_FLOW)
_UNEXPLAINED, _NOISE_COST = np.float32(UNEXPLAINED), np.float32(NOISE_COST)


@jit(error_model="numpy")
def try_vectors(start: Floats, stop: Floats, patches: Floats, vectors: Floats) -> Floats:
    """The patches, each with its vector if that fits no worse than its own flow."""
    found = patches.copy()
    slopes = np.empty((found.shape[0], found.shape[1], 6), np.float32)
    level, target, shape = start.reshape(-1), stop.reshape(-1), start.shape[1:]
    height, width = np.float32(shape[0] - 2 * MARGIN), np.float32(shape[1] - 2 * MARGIN)
    for row in range(found.shape[0]):
        for column in range(found.shape[1]):
            here, own = (row * STEP, column * STEP), found[row, column]
            u, v = vectors[row, column, 0], vectors[row, column, 1]
            if abs(u - own[0]) + abs(v - own[1]) < _SAME_FLOW:
                continue
            x, y = np.float32(here[1]) + u, np.float32(here[0]) + v
            if x < _0 or y < _0 or x > width - _SIDE or y > height - _SIDE:
                if own[2] > _UNEXPLAINED * spread_of(level, shape, here) + _NOISE_COST:
                    own[0], own[1], own[2] = u, v, _0
                continue
            _, cost, _, _ = compare(level, target, shape, here, (u, v))
            if cost < own[2] + _NOISE_COST:
                own[0], own[1], own[2] = u, v, cost
                sum_slopes(level, target, shape, here, slopes[row, column])
                gauss_newton(level, target, shape, (u, v), slopes, found, (row, column))
    return found
