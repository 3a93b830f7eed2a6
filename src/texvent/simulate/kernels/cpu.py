"""The two passes compiled by Numba: one thread, no fast-math, the reference's bits.

Each pass counts before it fills, so nothing as large as the frame is allocated.
"""

from __future__ import annotations

import numba
import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.cpu_draws import draw_uniform
from texvent.simulate.kernels.interface import Crossings


def find_crossings(
    brightness: NDArray[np.float64], reference: NDArray[np.float64], threshold: float
) -> Crossings:
    """Pixels with `|L(α + I^j) − reference| ≥ δ`; see `interface.Kernels`."""
    return Crossings(*_find_crossings(brightness.ravel(), reference.ravel(), float(threshold)))


def find_noisy_pixels(
    mask: NDArray[np.bool_], key: np.uint64, draw: int, quiet: float
) -> NDArray[np.int64]:
    """Masked pixels whose Poisson number is not zero; see `interface.Kernels`."""
    # With NUMBA_DISABLE_JIT=1 the hash runs in NumPy, which would warn of its wrap-around.
    with np.errstate(over="ignore"):
        pixel: NDArray[np.int64] = _find_noisy_pixels(mask, key, int(draw), float(quiet))
    return pixel


@numba.njit(cache=True, nogil=True)
def _find_crossings(
    brightness: NDArray[np.float64], reference: NDArray[np.float64], threshold: float
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    total = 0
    for i in range(brightness.size):
        total += abs(brightness[i] - reference[i]) >= threshold
    pixel = np.empty(total, np.int64)
    change = np.empty(total, np.float64)
    found = 0
    for i in range(brightness.size):
        if found == total:
            break
        difference = brightness[i] - reference[i]
        if abs(difference) >= threshold:
            pixel[found] = i
            change[found] = difference
            found += 1
    return pixel, change


@numba.njit(cache=True, nogil=True)
def _find_noisy_pixels(
    mask: NDArray[np.bool_], key: np.uint64, draw: int, quiet: float
) -> NDArray[np.int64]:
    height, width = mask.shape
    per_row = np.zeros(height, np.int64)
    for y in range(height):
        for x in range(width):
            per_row[y] += mask[y, x] and draw_uniform(key, y, x, draw) >= quiet
    pixel = np.empty(per_row.sum(), np.int64)
    found = 0
    for y in range(height):
        if per_row[y] == 0:
            continue
        for x in range(width):
            if mask[y, x] and draw_uniform(key, y, x, draw) >= quiet:
                pixel[found] = y * width + x
                found += 1
    return pixel
