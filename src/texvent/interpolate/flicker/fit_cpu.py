"""The fit of `fit_reference.py`, compiled by Numba: row by row, frame by frame."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.flicker.fit_reference import LEAST_MODULATION, Design
from texvent.runtime.jit import jit


def fit_pixels(
    light: NDArray[np.float32], gain: NDArray[np.float64], design: Design
) -> tuple[NDArray[np.bool_], NDArray[np.float32]]:
    """As `fit_reference.fit_pixels`."""
    return _fit_rows(
        light, gain, np.ascontiguousarray(design.orthonormal), design.to_waves, design.least_share
    )


@jit
def _fit_rows(
    light: NDArray[np.float32],
    gain: NDArray[np.float64],
    orthonormal: NDArray[np.float64],
    to_waves: NDArray[np.float64],
    least_share: float,
) -> tuple[NDArray[np.bool_], NDArray[np.float32]]:
    number, height, width = light.shape
    found = np.empty((height, width), np.bool_)
    amplitude = np.empty((height, width, 2), np.float32)
    sums = np.empty((6, width))  # squares, the four shares, and the level
    for y in range(height):
        sums[:] = 0.0
        for n in range(number):
            level_of, slope_of = orthonormal[n, 0], orthonormal[n, 1]
            cos_of, sin_of = orthonormal[n, 2], orthonormal[n, 3]
            for x in range(width):
                level = light[n, y, x] * gain[n]
                change = level - light[0, y, x] * gain[0]
                sums[0, x] += change * change
                sums[1, x] += level_of * change
                sums[2, x] += slope_of * change
                sums[3, x] += cos_of * change
                sums[4, x] += sin_of * change
                sums[5, x] += level
        for x in range(width):
            moving = sums[0, x] - sums[1, x] ** 2 - sums[2, x] ** 2
            explained = sums[3, x] ** 2 + sums[4, x] ** 2
            cosine = to_waves[0, 0] * sums[3, x] + to_waves[0, 1] * sums[4, x]
            sine = to_waves[1, 0] * sums[3, x] + to_waves[1, 1] * sums[4, x]
            amplitude[y, x, 0], amplitude[y, x, 1] = cosine, sine
            least = LEAST_MODULATION * sums[5, x] / number
            is_enough = np.sqrt(cosine * cosine + sine * sine) > least
            found[y, x] = is_enough and explained > least_share * moving
    return found, amplitude
