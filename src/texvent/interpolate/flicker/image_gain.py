"""A lamp that lights the whole image: the gain from frame to frame follows its sinusoid.

What moves hardly changes the median gain, so this also finds a lamp under which everything moves.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.flicker.fit_reference import (
    LEAST_MODULATION,
    UNKNOWNS,
    explained_by_chance,
    waves,
)
from texvent.video import MICROSECONDS

CHANCE = 1e-3
"""How rarely noise may look like a lamp; there is one gain per pair of frames."""
ITERATIONS = 12
LARGEST_MODULATION = 0.6
"""Largest amplitude that is taken off; darker moments would be divided by almost nothing."""
STEADY = (0.0, 0.0)


def fit_gain(
    log_gains: NDArray[np.float64], times_us: NDArray[np.int64], origin_us: int, hz: float
) -> tuple[float, float]:
    """The modulation of the whole image by a lamp.

    Least squares of `ln (1 + m)`, `m = c cos + d sin`, from frame to frame beside a steady fade:
    `m` is fitted to the gains plus `m − ln (1 + m)` of the fit before.

    Args:
        log_gains: ln of the gain from each frame to the next, [N − 1].
        times_us: of the frames, [N].
        origin_us: where the phase is 0, µs.
        hz: frequency of the lamp.

    Returns:
        c and d; `STEADY` if noise or movement explain the gains as well.
    """
    freedom = len(log_gains) - (UNKNOWNS - 1)
    if freedom < 2:
        return STEADY
    wave = waves(times_us, origin_us, hz)
    fade = np.diff(times_us)[:, None] / MICROSECONDS
    columns, _ = np.linalg.qr(np.concatenate([fade, np.diff(wave, axis=0)], axis=1))
    shares = columns.T @ log_gains
    moving, explained = (log_gains**2).sum() - shares[0] ** 2, (shares[1:] ** 2).sum()
    if not explained > explained_by_chance(CHANCE, freedom) * moving:
        return STEADY
    both = np.concatenate([fade, np.diff(wave, axis=0)], axis=1)
    modulation = np.zeros(2)
    for _ in range(ITERATIONS):
        swing = np.clip(wave @ modulation, -LARGEST_MODULATION, LARGEST_MODULATION)
        bent = log_gains + np.diff(swing - np.log1p(swing))
        modulation = np.linalg.lstsq(both, bent, rcond=None)[0][1:]
    size = float(np.hypot(*modulation))
    if not LEAST_MODULATION < size < LARGEST_MODULATION:
        return STEADY
    return float(modulation[0]), float(modulation[1])
