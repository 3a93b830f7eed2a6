"""What pixels of a moved sensor see of an image, compiled by Numba."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit


@jit(inner=True)
def fold(index: int, count: int) -> int:
    """The place of an index in an image that is mirrored at its borders."""
    index %= 2 * count
    return index if index < count else 2 * count - 1 - index


@jit(inner=True)
def _determinant(m: NDArray[np.float64]) -> float:
    determinant: float = (
        m[0, 0] * (m[1, 1] * m[2, 2] - m[1, 2] * m[2, 1])
        - m[0, 1] * (m[1, 0] * m[2, 2] - m[1, 2] * m[2, 0])
        + m[0, 2] * (m[1, 0] * m[2, 1] - m[1, 1] * m[2, 0])
    )
    return determinant


@jit(error_model="numpy")
def sample_rows(
    image: NDArray[np.float32],
    matrix: NDArray[np.float64],
    top: int,
    out: NDArray[np.float32],
) -> None:
    """The mean of the image over the area of each sensor pixel, exact at any sub-pixel position.

    The image is made of squares of one brightness each, and mirrored beyond its borders. A sensor
    pixel becomes an upright square of the right area about its centre: exact where the camera does
    not turn about its axis, else as good as the square's corners are far from the true ones.

    Args:
        image: [H, W] levels.
        matrix: [3, 3] sensor px → image px, homogeneous; pixel i covers i to i + 1.
        top: first row of the sensor that `out` holds.
        out: [h, w] written.
    """
    height, width = image.shape
    determinant = _determinant(matrix)
    is_upright = matrix[0, 1] == 0 and matrix[2, 0] == 0 and matrix[2, 1] == 0
    for row in range(out.shape[0]):
        for column in range(out.shape[1]):
            x, y = column + 0.5, top + row + 0.5
            w = matrix[2, 0] * x + matrix[2, 1] * y + matrix[2, 2]
            u = (matrix[0, 0] * x + matrix[0, 1] * y + matrix[0, 2]) / w
            v = (matrix[1, 0] * x + matrix[1, 1] * y + matrix[1, 2]) / w
            side = matrix[0, 0] / w if is_upright else math.sqrt(abs(determinant / (w * w * w)))
            left, upper = u - 0.5 * side, v - 0.5 * side
            right, lower = u + 0.5 * side, v + 0.5 * side
            total = 0.0
            for i in range(math.floor(upper), math.ceil(lower)):
                down = min(lower, i + 1.0) - max(upper, float(i))
                line, part = fold(i, height), 0.0
                for j in range(math.floor(left), math.ceil(right)):
                    part += (min(right, j + 1.0) - max(left, float(j))) * image[
                        line, fold(j, width)
                    ]
                total += down * part
            out[row, column] = total / (side * side)
