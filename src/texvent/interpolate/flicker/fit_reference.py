"""The definition of the fit: a steady, slowly changing level and a sinusoid, by least squares."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.video import MICROSECONDS

Float64Array = NDArray[np.float64]

WINDOW_FRAMES = 12
"""Frames that a fit looks at: half a second of ordinary video."""
UNKNOWNS = 4
"""Level, slope, cosine, sine."""
LEAST_SEEN = 0.5
"""Least energy of either phase of the sinusoid in the frames, a mean one being 1. The lamp beats
too slowly in the frames below it (movement looks alike), or one of its phases does not show."""
CHANCE = 1e-5
"""How rarely noise may look like a lamp, per pixel."""
LEAST_MODULATION = 0.02
"""Least amplitude, as a share of the mean light."""
LEAST_TOGETHER = 3
"""Pixels of 3x3, itself among them, that must be found for one of them to count."""


class Design(NamedTuple):
    """What the times of some frames and a frequency make of the fit."""

    orthonormal: Float64Array
    """[N, 4], the columns 1, time, cosine and sine, made orthonormal from left to right."""
    to_waves: Float64Array
    """[2, 2] from the shares of the last two columns to the amplitudes of cosine and sine."""
    seen: float
    """Energy of the worse phase of the sinusoid, which level and slope cannot explain."""

    @property
    def least_share(self) -> float:
        """Share of what changes that the sinusoid must explain, by `CHANCE`."""
        return explained_by_chance(CHANCE, len(self.orthonormal) - UNKNOWNS)

    @property
    def is_enough(self) -> bool:
        """Whether frames at these times tell a lamp from movement and noise."""
        return len(self.orthonormal) > UNKNOWNS + 1 and self.seen >= LEAST_SEEN


def explained_by_chance(chance: float, freedom: int) -> float:
    """Share of white noise that two columns explain with a probability of `chance`.

    It is Beta(1, freedom / 2) distributed, `freedom` being what is left beside all columns.

    Example:
        >>> round(explained_by_chance(1e-5, 8), 3)
        0.944
    """
    return float(1 - chance ** (2 / freedom))


def waves(times_us: NDArray[np.int64], origin_us: int, hz: float) -> Float64Array:
    """Cosine and sine of the lamp, [N, 2], whose phase is 0 at `origin_us`."""
    angle = 2 * math.pi * hz * (times_us - origin_us) / MICROSECONDS
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def design_fit(times_us: NDArray[np.int64], origin_us: int, hz: float) -> Design:
    """The fit for frames at some times, µs, and a lamp of `hz`."""
    seconds = (times_us - times_us.mean()) / MICROSECONDS
    columns = np.concatenate(
        [np.stack([np.ones_like(seconds), seconds], axis=1), waves(times_us, origin_us, hz)], axis=1
    )
    if len(columns) <= UNKNOWNS:
        return Design(columns, np.zeros((2, 2)), 0.0)
    orthonormal, upper = np.linalg.qr(columns)
    lower_right = upper[2:, 2:]
    seen = float(np.linalg.svd(lower_right, compute_uv=False)[-1] ** 2 / (len(columns) / 2))
    to_waves = np.linalg.inv(lower_right) if seen >= LEAST_SEEN else np.zeros((2, 2))
    return Design(orthonormal, to_waves, seen)


def fit_pixels(
    light: NDArray[np.float32], gain: Float64Array, design: Design
) -> tuple[NDArray[np.bool_], NDArray[np.float32]]:
    """Pixels that follow the lamp, by least squares of each: slow and readable.

    Args:
        light: the frames in linear light, [N, H, W].
        gain: by which each frame is multiplied first, [N].
        design: of the times of the frames.

    Returns:
        Which pixels follow it, alone, [H, W], and their amplitudes of cosine and sine, [H, W, 2].
    """
    _, height, width = light.shape
    found = np.zeros((height, width), np.bool_)
    amplitude = np.zeros((height, width, 2), np.float32)
    for y, x in np.ndindex(height, width):
        level = light[:, y, x].astype(np.float64) * gain
        shares = design.orthonormal.T @ (level - level[0])
        moving = ((level - level[0]) ** 2).sum() - (shares[:2] ** 2).sum()
        explained = (shares[2:] ** 2).sum()
        amplitude[y, x] = design.to_waves @ shares[2:]
        swing = math.hypot(*(design.to_waves @ shares[2:]))
        found[y, x] = explained > design.least_share * moving
        found[y, x] &= swing > LEAST_MODULATION * level.mean()
    return found, amplitude


def together(found: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The found pixels that have others beside them, [H, W]."""
    padded = np.pad(found.astype(np.uint8), 1)
    height, width = found.shape
    number = sum(padded[y : y + height, x : x + width] for y in range(3) for x in range(3))
    return found & (np.asarray(number) >= LEAST_TOGETHER)
