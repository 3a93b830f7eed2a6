"""Options of the SENPI pixel model, and its presets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from texvent.config import check_range
from texvent.simulation.random.mismatch import LOWEST_THRESHOLD


@dataclass(frozen=True, kw_only=True)
class SenpiConfig:
    """Options of the SENPI pixel model; the defaults are those of its program, noise per second.

    Raises:
        ConfigError: an option is out of range.

    Example:
        >>> from texvent.pixel_models import SenpiConfig
        >>> SenpiConfig(noise_rate_hz=0.0).refractory_period_us
        50
    """

    contrast_threshold_on: float = 0.9616
    """Rise of ln(photons) that fires an ON event. The default is the program's 0.1, in its unit of
    ln(15000)."""
    contrast_threshold_off: float = 0.9616
    """Fall of ln(photons) that fires an OFF event."""
    noise_rate_hz: float = 1.2
    """Noise events per pixel and second; the program's 0.05 per frame, at 24 frames per second."""
    refractory_period_us: int = 50
    """Time after an event in which a change cannot fire the pixel; it is kept for later."""

    def __post_init__(self) -> None:
        for name in ("contrast_threshold_on", "contrast_threshold_off"):
            check_range(name, getattr(self, name), LOWEST_THRESHOLD, 10.0)
        check_range("noise_rate_hz", self.noise_rate_hz, 0.0, 1e4)
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
