"""The shift of details that are missed: how something small may have moved."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.definitions import Floats, Mask

LEAST_SHIFT = 4
"""Shorter shifts, px, are left to the search."""
AGREEMENT = 0.2
"""Least correlation of a shift."""
AHEAD = 1.1
"""Another shift counts as its rival if the best one is not this many times above it."""

WIDE = 4
"""The wide mean is over the longer side divided by this."""


def wide_detail(image: NDArray[np.float64]) -> NDArray[np.float64]:
    """An image minus its mean over a wide square around each pixel."""
    side = max(image.shape) // WIDE | 1
    padded = np.pad(image, side // 2, mode="edge")
    total = np.pad(padded.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    square = total[side:, side:] - total[:-side, side:] - total[side:, :-side]
    return np.asarray(image - (square + total[:-side, :-side]) / side**2)


def correlate_missed(
    images: tuple[NDArray[np.float64], NDArray[np.float64]], missed: tuple[Mask, Mask]
) -> list[Floats]:
    """The shift at which the missed detail of two images agrees best, and its rival.

    Every shift by up to a third of the sides is tried.

    Args:
        images: [H, W] each, the detail of the images.
        missed: [H, W] each; the other pixels do not count.

    Returns:
        (x, y) px from the one to the other: the best shift, then a rival if there is one; empty if
        nothing agrees.
    """
    one, other = (np.where(mask, image, 0) for image, mask in zip(images, missed, strict=True))
    reach = [side // 3 for side in one.shape]
    shape = tuple(_fast_length(side + most) for side, most in zip(one.shape, reach, strict=True))
    spectra = [np.fft.rfft2(image.astype(np.float32), shape) for image in (one, other)]
    product = np.fft.irfft2(spectra[1] * np.conj(spectra[0]), shape)
    agreement = product[np.ix_(*(np.arange(-most, most + 1) for most in reach))]
    agreement = agreement / (np.sqrt((one**2).sum() * (other**2).sum()) + 1.0)
    held = np.where(_is_peak(agreement), agreement, -1.0)
    _clear(held, (reach[0], reach[1]))
    found, least = [], AGREEMENT
    for _ in range(2):
        peak = np.unravel_index(int(held.argmax()), held.shape)
        row, column = int(peak[0]), int(peak[1])
        if held[row, column] < least:
            break
        x = column - reach[1] + _vertex(agreement[row, :], column)
        y = row - reach[0] + _vertex(agreement[:, column], row)
        found.append(np.array([x, y], np.float32))
        least = float(held[row, column]) / AHEAD
        _clear(held, (row, column))
    return found


def _fast_length(least: int) -> int:
    """The next length for which Fourier transforms are fast."""
    length = least
    while math.gcd(length, 2**16 * 3**8 * 5**5) != length:
        length += 1
    return length


def _is_peak(agreement: NDArray[np.float64]) -> Mask:
    """Whether no neighbour agrees better: the flank of a wide peak is no other shift."""
    padded = np.pad(agreement, 1, constant_values=-1.0)
    rows = np.maximum(np.maximum(padded[:-2], padded[2:]), padded[1:-1])
    best = np.maximum(np.maximum(rows[:, :-2], rows[:, 2:]), rows[:, 1:-1])
    return np.asarray(agreement >= best)


def _clear(agreement: NDArray[np.float64], peak: tuple[int, int]) -> None:
    """Take a peak and the shifts near it out."""
    rows, columns = (slice(max(at - LEAST_SHIFT, 0), at + LEAST_SHIFT + 1) for at in peak)
    agreement[rows, columns] = -1.0


def _vertex(values: NDArray[np.float64], at: int) -> float:
    """Where a parabola through a peak and its neighbours is highest, −0.5..0.5."""
    if not 0 < at < len(values) - 1:
        return 0.0
    before, here, after = values[at - 1 : at + 2]
    bend = before - 2.0 * here + after
    return float(np.clip(0.5 * (before - after) / bend, -0.5, 0.5)) if bend < 0 else 0.0
