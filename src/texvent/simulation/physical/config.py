"""Options of the `physical` pixel model, and its noise rate by intensity."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.config import IdleOptions, check_choices, check_range
from texvent.errors import ConfigError, shown
from texvent.simulation.random.mismatch import LOWEST_THRESHOLD

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
    except (AttributeError, TypeError, ValueError):
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


@dataclass(frozen=True, kw_only=True)
class PhysicalConfig:
    """Options of the physical pixel model.

    Raises:
        ConfigError: an option is out of range, or two contradict each other.

    Example:
        >>> from texvent.pixel_models import PhysicalConfig
        >>> PhysicalConfig(threshold_sigma=0.0).contrast_threshold
        0.3
    """

    idle_with: ClassVar[IdleOptions] = {
        "noise_curve": ("noise_scale", (0.0,)),
        "noise_decades": ("noise_scale", (0.0,)),
        "leak_rate_decades": ("leak_rate_hz", (0.0,)),
        "hot_pixel_rate_hz": ("hot_pixel_fraction", (0.0,)),
    }

    gamma: float = 2.2
    """Exponent that turns the levels of ordinary video into linear light; 1 for frames that are
    linear already, such as those of a DAVIS. Frames that say so themselves, such as OpenEXR, are
    taken as they are whatever it is."""
    balance: float = 10.0
    """Balance α, in linear levels of 0..255: what is added to intensities before the logarithm,
    as the current that flows in the dark."""
    contrast_threshold: float = 0.3
    """Contrast threshold δ: change of brightness ln(α + I) that fires an event; the mean over
    pixels, and the geometric mean of ON and OFF."""
    on_off_ratio: float = 1.0
    """ON threshold divided by OFF threshold."""
    threshold_sigma: float = 0.03
    """Standard deviation of both thresholds between pixels, log units; none is below 0.01."""
    threshold_map: Path | None = None
    """Thresholds of each pixel of one sensor, over their mean: a file of texvent calibrate
    --threshold-map. Pixels that it does not know have drawn ones."""
    initial_phase: Literal["random", "zero"] = "zero"
    """Change of each pixel at the first frame: anywhere between its
    thresholds, as in a sensor that was on before, for frames without grain (random), or just reset
    (zero); leak then begins to fire after 1 / leak_rate_hz."""
    cutoff_hz: float = 250.0
    """Bandwidth of the photoreceptor at white; proportionally less at lower intensity. 0 is
    unlimited."""
    cutoff_limit_hz: float = 0.0
    """Bandwidth that bright light does not exceed, that of the circuit behind the photodiode; 0 is
    unlimited."""
    refractory_period_us: int = 300
    """Refractory period: brightness changes within it are lost."""
    leak_rate_hz: float = 0.01
    """ON events per pixel and second from junction leakage: the mean over pixels."""
    leak_rate_decades: float = 0.1
    """Standard deviation of log10 of the leak rate between pixels."""
    noise_curve: str = DAVIS346_NOISE
    """Noise events per pixel and second by linear intensity, as points LEVEL:RATE; log-linear
    between them."""
    noise_scale: float = 0.2
    """Sensor factor on the noise rate; 0 is no noise."""
    noise_decades: float = 0.25
    """Standard deviation of log10 of the noise rate between pixels."""
    noise_on_fraction: float = 0.53
    """Share of ON among noise events, 0..1."""
    hot_pixel_fraction: float = 0.0
    """Share of pixels that fire all the time, 0..1."""
    hot_pixel_rate_hz: float = 20.0
    """Noise events per second of such a pixel."""
    sensor_seed: int | None = None
    """Seed of everything fixed to a pixel (thresholds, noise and leak rates, hot pixels); without
    it, the run's seed. Set it to record many clips with one sensor."""
    scan_period_ns: int = 0
    """Period of a readout that scans the columns evenly, ns, as a DVXplorer has it; events that a
    pixel fires while one waits are lost. 0 reads every event at once."""

    def __post_init__(self) -> None:
        for name, (low, high) in RANGES.items():
            check_range(name, getattr(self, name), low, high)
        check_choices(self)
        if self.sensor_seed is not None:
            check_range("sensor_seed", self.sensor_seed, 0, 2**63 - 1)
        parse_noise_curve(self.noise_curve)

    @property
    def contrast_threshold_on(self) -> float:
        """Mean ON threshold, log units."""
        return max(self.contrast_threshold * math.sqrt(self.on_off_ratio), LOWEST_THRESHOLD)

    @property
    def contrast_threshold_off(self) -> float:
        """Mean OFF threshold, log units."""
        return max(self.contrast_threshold / math.sqrt(self.on_off_ratio), LOWEST_THRESHOLD)


RANGES: Mapping[str, tuple[float, float]] = {
    "gamma": (0.1, 10.0),
    "balance": (1e-3, 1e6),
    "contrast_threshold": (LOWEST_THRESHOLD, 10.0),
    "on_off_ratio": (0.1, 10.0),
    "threshold_sigma": (0.0, 10.0),
    "cutoff_hz": (0.0, 1e6),
    "cutoff_limit_hz": (0.0, 1e6),
    "refractory_period_us": (0, 10**9),
    "leak_rate_hz": (0.0, 1e3),
    "leak_rate_decades": (0.0, 1.0),
    "noise_scale": (0.0, 1e3),
    "noise_decades": (0.0, 1.0),
    "noise_on_fraction": (0.0, 1.0),
    "hot_pixel_fraction": (0.0, 1.0),
    "hot_pixel_rate_hz": (0.0, 1e5),
    "scan_period_ns": (0, 10**9),
}
"""Lowest and highest value of every numeric option."""
