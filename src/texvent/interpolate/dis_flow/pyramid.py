"""Levels of an image pyramid, and flow carried from a level to the next finer one; compiled."""

from __future__ import annotations

import numpy as np

from texvent.interpolate.dis_flow.definitions import MARGIN, Floats
from texvent.runtime.jit import jit

# As float32: Numba computes with float64 where a constant is one.
_2 = np.float32(2.0)
_HALF = np.float32(0.5)
_EIGHTH = np.float32(0.125)
_QUARTER = np.float32(0.25)


@jit
def halve(image: Floats) -> Floats:
    """Means of 2×2 pixels; an odd last row or column counts twice."""
    height, width = image.shape
    half = np.empty(((height + 1) // 2, (width + 1) // 2), np.float32)
    for row in range(half.shape[0]):
        upper, lower = image[2 * row], image[min(2 * row + 1, height - 1)]
        out = half[row]
        for x in range(width // 2):
            left, right = upper[2 * x] + lower[2 * x], upper[2 * x + 1] + lower[2 * x + 1]
            out[x] = (left + right) * _QUARTER
        if width % 2:
            left = upper[width - 1] + lower[width - 1]
            out[width // 2] = (left + left) * _QUARTER
    return half


@jit
def make_level(image: Floats) -> Floats:
    """The image with its edges repeated, and its slopes; see `definitions`."""
    height, width = image.shape
    level = np.zeros((3, height + 2 * MARGIN, width + 2 * MARGIN), np.float32)
    padded = level[0]
    for row in range(padded.shape[0]):
        source, target = image[min(max(row - MARGIN, 0), height - 1)], padded[row]
        for x in range(MARGIN):
            target[x], target[MARGIN + width + x] = source[0], source[width - 1]
        for x in range(width):
            target[MARGIN + x] = source[x]
    inner, near = slice(MARGIN, MARGIN + width), slice(MARGIN - 1, MARGIN + width + 1)
    for row in range(MARGIN, MARGIN + height):
        above, here, below = padded[row - 1, near], padded[row, near], padded[row + 1, near]
        _find_slopes(above, here, below, level[1, row, inner], level[2, row, inner])
    return level


@jit(error_model="numpy", inner=True)
def _find_slopes(
    above: Floats, here: Floats, below: Floats, slope_x: Floats, slope_y: Floats
) -> None:
    for x in range(slope_x.size):
        outer = (above[x + 2] - above[x]) + (below[x + 2] - below[x])
        slope_x[x] = (outer + _2 * (here[x + 2] - here[x])) * _EIGHTH
    for x in range(slope_y.size):
        outer = (below[x] - above[x]) + (below[x + 2] - above[x + 2])
        slope_y[x] = (outer + _2 * (below[x + 1] - above[x + 1])) * _EIGHTH


@jit
def double(flow: Floats, shape: tuple[int, int]) -> Floats:
    """The flow of an image of twice the size: bilinear, between the centres of pixels."""
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
