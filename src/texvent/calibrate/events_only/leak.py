"""The leak: ON events that come when a pixel was left alone for the leak period."""

from __future__ import annotations

import math

import numpy as np

from texvent.calibrate.bootstrap import Float64Array, bootstrap
from texvent.calibrate.estimates import Estimate
from texvent.calibrate.events_only.pixel_trains import BoolArray, PixelTrains
from texvent.video import MICROSECONDS

NODES, WEIGHTS = np.polynomial.hermite_e.hermegauss(9)
"""Gauss-Hermite quadrature of the mean over a normal distribution."""
LEAST_PER_PIXEL, LEAST_SHARE = 4, 0.8
"""Intervals that a pixel needs, and pixels that must have them, for the spread of the leak."""


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


def leak_spread(trains: PixelTrains, leak_hz: float, groups: int) -> Estimate | None:
    """Spread of the leak over pixels, from their regular intervals.

    Most intervals that end in an ON event must be whole leak periods; then their median is the
    pixel's.

    Args:
        trains: of pixels at rest.
        leak_hz: mean leak rate, events per pixel and second.
        groups: of pixels, which the bootstrap draws.

    Returns:
        The constant `leak_rate_decades`, or None if leak is too rare.
    """
    waits = trains.waits_us()
    chosen = trains.is_on & np.isfinite(waits)
    pixel, period = trains.pixel[chosen], waits[chosen]
    if leak_hz <= 0 or _share(period * leak_hz > 0.4 * MICROSECONDS) < LEAST_SHARE:
        return None
    numbers, first, count = np.unique(pixel, return_index=True, return_counts=True)
    order = np.lexsort((period, pixel))
    middle = np.log10(period[order][first + count // 2])
    enough = count >= LEAST_PER_PIXEL
    seen = len(np.unique(trains.pixel))
    if enough.sum() < max(LEAST_SHARE * seen, 2):
        return None
    group, middle = numbers[enough] % groups, middle[enough] - middle[enough].mean()
    sums = np.stack(
        [np.bincount(group, weights=middle**power, minlength=groups) for power in (0, 1, 2)]
    )

    def spread(weights: Float64Array) -> Float64Array:
        number, total, squares = sums @ weights
        return np.array([math.sqrt(max(squares / number - (total / number) ** 2, 0.0))])

    low, high = bootstrap(spread, (groups,))[:, 0]
    return Estimate("leak_rate_decades", float(spread(np.ones(groups))[0]), low, high)


def _share(chosen: BoolArray) -> float:
    return float(chosen.mean()) if chosen.size else 0.0
