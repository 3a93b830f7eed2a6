"""Noise rate as a function of intensity, written as `LEVEL:RATE` points."""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, shown

DAVIS346_NOISE = "1:0.46 3.5:0.77 7.5:0.30 15:0.12 25:0.015 37.5:0.004 57.5:0.003"
"""Events per pixel and second, ON and OFF together, at the linear intensity of static pixels of a
DAVIS346 (frame levels, 0..255). Measured by us; the points are the middles of the level ranges
0-2, 2-5, 5-10, 10-20, 20-30, 30-45 and 45-70."""


class NoiseCurve(NamedTuple):
    """Noise rate by intensity: log-linear between points, constant outside them."""

    levels: NDArray[np.float64]
    """[n] linear intensity, 0..255 scale, increasing."""
    rates_hz: NDArray[np.float64]
    """[n] events per pixel and second, above 0."""

    @property
    def highest_hz(self) -> float:
        """The highest rate at any intensity, events per pixel and second."""
        return float(self.rates_hz.max())

    def rate_at(self, intensity: NDArray[np.float64]) -> NDArray[np.float64]:
        """Events per pixel and second at a linear intensity, of the same shape."""
        return np.asarray(np.exp(np.interp(intensity, self.levels, np.log(self.rates_hz))))

    def __str__(self) -> str:
        return " ".join(
            f"{level:g}:{rate:g}" for level, rate in zip(self.levels, self.rates_hz, strict=True)
        )


def parse_noise_curve(text: str) -> NoiseCurve:
    """The curve that a text such as "2:0.5 20:0.1 60:0.003" describes.

    Raises:
        ConfigError: it is empty or no list of LEVEL:RATE, levels do not increase within 0..255,
            or a rate is not above 0.

    Example:
        >>> parse_noise_curve("0:1 10:0.01").rate_at(np.array([5.0, 50.0])).round(4).tolist()
        [0.1, 0.01]
    """
    try:
        points = [tuple(map(float, word.split(":"))) for word in re.split(r"[\s,]+", text.strip())]
        levels, rates = np.array(points, np.float64).reshape(len(points), 2).T
    except ValueError:
        raise ConfigError(
            f"noise_curve is {shown(text)}; it must be points LEVEL:RATE such as "
            "'2:0.5 20:0.1 60:0.003'"
        ) from None
    is_range = levels[0] >= 0 and levels[-1] <= 255 and (np.diff(levels) > 0).all()
    if not (is_range and np.isfinite(rates).all() and (rates > 0).all()):
        raise ConfigError(
            f"noise_curve is {shown(text)}; levels must increase within 0..255 and rates be "
            "above 0 (for no noise at all, set noise_scale to 0)"
        )
    return NoiseCurve(levels, rates)
