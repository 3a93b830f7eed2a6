"""Texture that repeats takes the nearest of the places it fits, compiled by Numba."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.definitions import (
    AGAINST,
    ALIKE,
    BETWEEN,
    LEAST_FLOW2,
    LEAST_SPREAD,
    MARGIN,
    NOISE_COST,
    PATCH,
    REPEATED,
    SAME_FLOW2,
    SHORTER2,
    SPARSE,
    STEP,
    Floats,
    Mask,
)
from texvent.interpolate.dis_flow.search_cpu import (
    compare,
    gauss_newton,
    search_integer,
    spread_of,
    sum_slopes,
)
from texvent.runtime.jit import jit

# As float32: Numba computes with float64 where a constant is one.
_0, _HALF, _QUARTER = np.float32(0.0), np.float32(0.5), np.float32(0.25)
_ALIKE, _BETWEEN = np.float32(ALIKE), np.float32(BETWEEN)
_LEAST_FLOW2, _SHORTER2 = np.float32(LEAST_FLOW2), np.float32(SHORTER2)
_SAME_FLOW2 = np.float32(SAME_FLOW2)
_LEAST_SPREAD, _NOISE_COST = np.float32(LEAST_SPREAD), np.float32(NOISE_COST)
_REPEATED = np.float32(REPEATED)

Images = tuple[Floats, Floats, tuple[int, int]]
"""Level of the patches, flat; the other level, flat; the shape of both, with margins."""


@jit(error_model="numpy")
def take_nearest(start: Floats, stop: Floats, patches: Floats) -> Floats:
    """The patches; where texture repeats, each with the shortest flow that fits alike."""
    down, across, _ = patches.shape
    images = start.reshape(-1), stop.reshape(-1), start.shape[1:]
    found, tried = patches.copy(), np.empty_like(patches)
    slopes = np.empty((down, across, 6), np.float32)
    is_reached = np.zeros((down, across), np.bool_)
    reached = np.empty((down * across, 2), np.int32)
    for row in range(SPARSE // 2, down, SPARSE):
        for column in range(SPARSE // 2, across, SPARSE):
            patch, own = (row, column), patches[row, column]
            if is_reached[patch] or own[0] * own[0] + own[1] * own[1] < _LEAST_FLOW2:
                continue
            here = row * STEP, column * STEP
            spread = spread_of(images[0], images[2], here)
            if spread < _LEAST_SPREAD or own[2] > _REPEATED * spread:
                continue
            begin = search_integer(images[0], images[1], images[2], here)
            _try(images, begin, slopes, tried, patch)
            if _fits_alike(images, here, own, tried[patch], spread):
                found[patch], is_reached[patch] = tried[patch], True
                reached[0, 0], reached[0, 1] = row, column
                _spread_out(images, patches, found, tried, slopes, is_reached, reached)
    return found


@jit(error_model="numpy", inner=True)
def _spread_out(
    images: Images,
    patches: Floats,
    found: Floats,
    tried: Floats,
    slopes: Floats,
    is_reached: Mask,
    reached: NDArray[np.int32],
) -> None:
    """Give the flow of the first patch that is `reached` to those around it that it fits too.

    Nothing is changed if patches around them say otherwise.
    """
    down, across, _ = found.shape
    count, at, against, support = 1, 0, 0, 0
    while at < count:
        i, j = reached[at, 0], reached[at, 1]
        at += 1
        for row in range(max(0, i - 1), min(down, i + 2)):
            for column in range(max(0, j - 1), min(across, j + 2)):
                patch, own = (row, column), patches[row, column]
                if is_reached[patch]:
                    continue
                here = row * STEP, column * STEP
                spread = spread_of(images[0], images[2], here)
                is_found = own[2] <= _REPEATED * spread
                if is_found and _distance2(own, found[i, j]) < _SAME_FLOW2:
                    support += 1
                else:
                    _try(images, (found[i, j, 0], found[i, j, 1]), slopes, tried, patch)
                    if not _fits_alike(images, here, own, tried[patch], spread):
                        is_seen = _is_inside(images, here, own)
                        is_seen &= _is_inside(images, here, tried[patch])
                        says_other = _distance2(own, patches[i, j]) < np.float32(1.0)
                        against += 1 if is_found and is_seen and says_other else 0
                        continue
                    found[patch] = tried[patch]
                is_reached[patch] = True
                reached[count, 0], reached[count, 1] = row, column
                count += 1
    if against > support + AGAINST * count:
        for k in range(count):
            patch = reached[k, 0], reached[k, 1]
            found[patch] = patches[patch]


@jit(error_model="numpy", inner=True)
def _try(
    images: Images,
    begin: tuple[np.float32, np.float32],
    slopes: Floats,
    tried: Floats,
    patch: tuple[int, int],
) -> None:
    """Fill in the flow and cost of a patch, descended from a beginning."""
    level, target, shape = images
    here, own = (patch[0] * STEP, patch[1] * STEP), tried[patch]
    own[0], own[1] = begin
    _, own[2], _, _ = compare(level, target, shape, here, begin)
    sum_slopes(level, target, shape, here, slopes[patch])
    gauss_newton(level, target, shape, begin, slopes, tried, patch)


@jit(error_model="numpy", inner=True)
def _fits_alike(
    images: Images, here: tuple[int, int], own: Floats, short: Floats, spread: np.float32
) -> bool:
    """Whether a patch fits a shorter flow as well as its own, but nothing between both."""
    level, target, shape = images
    u, v, x, y = own[0], own[1], short[0], short[1]
    if spread < _LEAST_SPREAD or short[2] > _REPEATED * spread:
        return False
    if x * x + y * y >= _SHORTER2 * (u * u + v * v):
        return False
    u, v = u - x, v - y
    _, half, _, _ = compare(level, target, shape, here, (x + _HALF * u, y + _HALF * v))
    _, quarter, _, _ = compare(level, target, shape, here, (x + _QUARTER * u, y + _QUARTER * v))
    between = max(half, quarter)
    is_alike: bool = short[2] < own[2] + _NOISE_COST + _ALIKE * between
    return bool(between > _BETWEEN * spread) and is_alike


@jit(error_model="numpy", inner=True)
def _is_inside(images: Images, here: tuple[int, int], flow: Floats) -> bool:
    """Whether the place of a patch lies within the other image."""
    x, y = np.float32(here[1]) + flow[0], np.float32(here[0]) + flow[1]
    below, right = images[2][0] - 2 * MARGIN - PATCH, images[2][1] - 2 * MARGIN - PATCH
    return bool(x >= _0 and y >= _0 and x <= np.float32(right) and y <= np.float32(below))


@jit(error_model="numpy", inner=True)
def _distance2(one: Floats, other: Floats) -> np.float32:
    x, y = one[0] - other[0], one[1] - other[1]
    return np.float32(x * x + y * y)
