"""A scene at rest: its stationary blocks, and the leak of pixels that are left alone.

Leak gives ON events where a pixel had no event for the leak period.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from texvent.calibrate.estimates import Float64Array
from texvent.events import EventStream

WINDOWS = 16
"""Parts of the recording whose counts are compared."""
BLOCK = 16
"""Side of the blocks of pixels that are judged together."""
SURPRISE = 5.0
"""Standard deviations by which the counts of a block may vary more than those of a Poisson
process."""
MAINS_HZ = (100.0, 120.0)
"""At which lamps on the mains flicker."""
MAINS_SHARE, MAINS_SURPRISE = 0.1, 5.0
"""Events follow the mains if a tenth of them and five times chance do."""
NODES, WEIGHTS = np.polynomial.hermite_e.hermegauss(9)
"""Gauss-Hermite quadrature of the mean over a normal distribution."""


def find_stationary(events: EventStream) -> NDArray[np.bool_]:
    """Pixels in blocks whose number of events does not change over time, [H, W].

    In 16 equal windows, counts of a Poisson process with the same rate give a sum of squared
    deviations over the mean that is distributed as χ² of 15 degrees of freedom; noise, hot pixels
    and leak stay below its mean plus five standard deviations, moving blocks do not.
    """
    width, height = events.size
    rows, columns = -(-height // BLOCK), -(-width // BLOCK)
    start_us, stop_us = events.time_range or (0, 1)
    block = (events.y // BLOCK).astype(np.int64) * columns + events.x // BLOCK
    window = (events.t - start_us) * WINDOWS // max(stop_us - start_us, 1)
    counts = np.bincount(window * (rows * columns) + block, minlength=WINDOWS * rows * columns)
    counts = counts.reshape(WINDOWS, rows * columns)
    mean = counts.mean(axis=0)
    deviation = ((counts - mean) ** 2).sum(axis=0) / np.maximum(mean, 1e-9)
    freedom = WINDOWS - 1
    rests = deviation <= freedom + SURPRISE * math.sqrt(2 * freedom)
    return np.kron(rests.reshape(rows, columns), np.ones((BLOCK, BLOCK), np.bool_))[
        :height, :width
    ].astype(np.bool_)


def mains_flicker(events: EventStream) -> float | None:
    """The frequency of lamps on the mains if the events follow it, Hz, else None.

    The events follow a frequency if the mean of `exp(2πi f t)` is well above `1 / √n`.
    """
    if not len(events):
        return None
    seconds = (events.t - events.t[0]) / 1e6
    share = {hz: float(np.abs(np.exp(2j * np.pi * hz * seconds).mean())) for hz in MAINS_HZ}
    hz = max(MAINS_HZ, key=lambda one: share[one])
    limit = max(MAINS_SHARE, MAINS_SURPRISE / math.sqrt(len(events)))
    return hz if share[hz] > limit else None


def leak_rate(
    noise_hz: float, surplus_hz: float, noise_decades: float, leak_decades: float
) -> float:
    """Leak rate of a pixel that is left alone, from the rate at which leak fires among noise.

    Every event resets the pixel, so leak fires only after a leak period 1/g without noise of rate
    n. Among noise it fires at the rate `n / (exp(n / g) − 1)`: the chance of such a wait, per
    event. Both rates are log-normal over pixels.

    Args:
        noise_hz: mean noise rate, events per pixel and second.
        surplus_hz: rate of ON events that are not noise.
        noise_decades: standard deviation of log10 of the noise rate.
        leak_decades: that of the leak rate.

    Returns:
        The mean leak rate g, events per pixel and second; 0 if the surplus is.

    Example:
        >>> round(leak_rate(0.0, 0.5, 0.0, 0.0), 3)
        0.5
        >>> round(leak_rate(1.0, 1 / (np.e - 1), 0.0, 0.0), 3)  # n = g = 1
        1.0
    """
    if surplus_hz <= 0:
        return 0.0
    noise = noise_hz * _factors(noise_decades)[:, None]
    factor = _factors(leak_decades)[None, :]
    weight = np.outer(WEIGHTS, WEIGHTS) / WEIGHTS.sum() ** 2

    def fires(rate_hz: float) -> float:
        rate = rate_hz * factor
        ratio = np.minimum(np.maximum(noise / rate, 1e-9), 500.0)
        return float((weight * rate * ratio / np.expm1(ratio)).sum())

    low, high = math.log(surplus_hz), math.log(surplus_hz + 100.0 * (noise_hz + surplus_hz))
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if fires(math.exp(middle)) < surplus_hz else (low, middle)
    return math.exp((low + high) / 2)


def _factors(decades: float) -> Float64Array:
    """Log-normal factors of mean 1 at the nodes."""
    spread = math.log(10) * decades
    return np.asarray(np.exp(spread * NODES - spread**2 / 2))
