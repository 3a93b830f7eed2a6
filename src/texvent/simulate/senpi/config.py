"""Options of SENPI's pixel model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from texvent.config import check_range
from texvent.simulate.random.mismatch import check_nominal_thresholds

WHITE = 255.0
FULL_SCALE = 0.9616
"""SENPI's threshold of 0.1 in its unit of ln(15000): 0.96158 in natural-log units."""


@dataclass(frozen=True, kw_only=True)
class SenpiConfig:
    """Options of the SENPI pixel model; the defaults are those of its program, per second.

    Raises:
        ConfigError: an option is out of range.
    """

    contrast_threshold_on: float = FULL_SCALE
    """Rise of ln(photons) that fires an ON event: the mean over pixels."""
    contrast_threshold_off: float = FULL_SCALE
    """Fall of ln(photons) that fires an OFF event: the mean over pixels."""
    threshold_sigma: float = 0.0
    """Standard deviation of both thresholds between pixels, log units; none is below 0.01."""
    well_capacity: float = 15_000.0
    """Photons of a white pixel."""
    noise_rate_hz: float = 1.2
    """Noise events per pixel and second; SENPI's 0.05 per frame, at 24 frames per second."""
    hot_fraction: float = 0.0
    """Share of hot pixels, 0..1."""
    hot_rate_hz: float = 10.0
    """Noise events per second of a hot pixel."""
    shot_noise: bool = False
    """Add the noise events that photon statistics cause."""
    dark_electrons: float = 2.0
    """Rms of the dark noise, electrons; counts with shot noise only."""
    exposure_us: int = 41_667
    """Time between independent samples of the photon number: how often shot noise can fire."""
    refractory_period_us: int = 50
    """Time after an event in which a change cannot fire the pixel."""

    def __post_init__(self) -> None:
        check_nominal_thresholds(self)
        check_range("well_capacity", self.well_capacity, WHITE, 1e9)
        check_range("noise_rate_hz", self.noise_rate_hz, 0.0, 1e4)
        check_range("hot_fraction", self.hot_fraction, 0.0, 1.0)
        check_range("hot_rate_hz", self.hot_rate_hz, 0.0, 1e4)
        check_range("dark_electrons", self.dark_electrons, 0.0, 1e6)
        check_range("exposure_us", self.exposure_us, 1, 10**9)
        check_range("refractory_period_us", self.refractory_period_us, 0, 10**9)


PRESETS: Mapping[str, SenpiConfig] = {
    "default": SenpiConfig(),
    "peer-common": SenpiConfig(
        contrast_threshold_on=0.2,
        contrast_threshold_off=0.2,
        noise_rate_hz=0.0,
        refractory_period_us=0,
    ),
}
"""Name → options."""
