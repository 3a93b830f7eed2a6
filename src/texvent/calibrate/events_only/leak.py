"""The leak: ON events that come when a pixel was left alone for the leak period."""

from __future__ import annotations

import math

import numpy as np

from texvent.calibrate.bootstrap import Float64Array

NODES, WEIGHTS = np.polynomial.hermite_e.hermegauss(9)
"""Gauss-Hermite quadrature of the mean over a normal distribution."""


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
