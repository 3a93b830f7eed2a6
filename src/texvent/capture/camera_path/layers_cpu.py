"""Pieces of an image with depth drawn where a camera sees them, compiled by Numba."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit

LEAST_OVERLAP = 1e-9
"""Smaller parts of a pixel are left out."""
FULL = 1.0 - 1e-9


@jit
def draw_pieces(
    pieces: NDArray[np.float64],
    out: NDArray[np.float32],
    depth: NDArray[np.float32],
    covered: NDArray[np.float64],
) -> None:
    """Draw rectangles in their order: what one has covered of a pixel, later ones do not change.

    Args:
        pieces: [n, 6] left, right, top and bottom in px of the sensor, level, depth as the camera
            sees it; nearest first.
        out: [h, w] written: mean level of what is seen in each pixel.
        depth: [h, w] written: of the nearest piece in each pixel; inf where there is none.
        covered: [h, w] written: part of each pixel that is covered. What is not is left out of
            the mean; a pixel of which nothing is takes its neighbour's level.
    """
    height, width = out.shape
    total = np.zeros((height, width))
    covered[:] = 0.0
    depth[:] = np.inf
    for k in range(len(pieces)):
        left, right, top, bottom = pieces[k, 0], pieces[k, 1], pieces[k, 2], pieces[k, 3]
        if not (right > 0.0 and left < width and bottom > 0.0 and top < height):
            continue
        for row in range(max(math.floor(top), 0), min(math.ceil(bottom), height)):
            down = min(bottom, row + 1.0) - max(top, float(row))
            for column in range(max(math.floor(left), 0), min(math.ceil(right), width)):
                across = min(right, column + 1.0) - max(left, float(column))
                part = min(across * down, 1.0 - covered[row, column])
                if part <= LEAST_OVERLAP or covered[row, column] >= FULL:
                    continue
                if covered[row, column] == 0.0:
                    depth[row, column] = pieces[k, 5]
                covered[row, column] += part
                total[row, column] += part * pieces[k, 4]
    _fill(total, covered, out)


@jit(inner=True)
def _fill(
    total: NDArray[np.float64], covered: NDArray[np.float64], out: NDArray[np.float32]
) -> None:
    """Means from sums; pixels without any take the one to the left, or above."""
    height, width = out.shape
    for row in range(height):
        for column in range(width):
            if covered[row, column] > 0.0:
                out[row, column] = total[row, column] / covered[row, column]
            elif column > 0:
                out[row, column] = out[row, column - 1]
            else:
                out[row, column] = out[row - 1, column] if row > 0 else np.float32(0.0)
