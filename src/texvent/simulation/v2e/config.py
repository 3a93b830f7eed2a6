"""Options of the v2e pixel model, and its presets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from texvent.config import IdleOptions, check_range
from texvent.simulation.random.mismatch import check_nominal_thresholds

LINEAR_BELOW = 20.0
"""Intensity, in levels of 0..255, below which brightness is linear instead of logarithmic."""


@dataclass(frozen=True, kw_only=True)
class V2eConfig:
    """Options of the v2e pixel model; the defaults are those of its command line.

    Raises:
        ConfigError: an option is out of range.

    Example:
        >>> from texvent.pixel_models import V2eConfig
        >>> V2eConfig(cutoff_hz=0.0).shot_noise_rate_hz
        0.001
    """

    idle_with: ClassVar[IdleOptions] = {"leak_rate_decades": ("leak_rate_hz", (0.0,))}

    contrast_threshold_on: float = 0.2
    """Rise of the lin-log brightness that fires an ON event: the mean over pixels."""
    contrast_threshold_off: float = 0.2
    """Fall of the lin-log brightness that fires an OFF event: the mean over pixels."""
    threshold_sigma: float = 0.03
    """Standard deviation of both thresholds between pixels, log units; none is below 0.01."""
    cutoff_hz: float = 300.0
    """Bandwidth of the photoreceptor at white; less at lower intensity. 0 is unlimited."""
    leak_rate_hz: float = 0.01
    """ON events per pixel and second from junction leakage."""
    leak_rate_decades: float = 0.1
    """Standard deviation of log10 of the leak rate between pixels."""
    shot_noise_rate_hz: float = 0.001
    """Noise events per pixel and second in the dark; a quarter of it at white."""
    refractory_period_us: int = 500
    """Time after an event in which the pixel cannot fire; the change is kept for later."""

    def __post_init__(self) -> None:
        check_nominal_thresholds(self)
        check_range("cutoff_hz", self.cutoff_hz, 0.0, 1e6)
        check_range("leak_rate_hz", self.leak_rate_hz, 0.0, 1e3)
        check_range("leak_rate_decades", self.leak_rate_decades, 0.0, 1.0)
        check_range("shot_noise_rate_hz", self.shot_noise_rate_hz, 0.0, 1e3)
        check_range("refractory_period_us", self.refractory_period_us, 0, 10**9)


PRESETS: Mapping[str, V2eConfig] = {
    "default": V2eConfig(),
    "noisy": V2eConfig(
        threshold_sigma=0.05,
        cutoff_hz=30.0,
        leak_rate_hz=0.1,
        shot_noise_rate_hz=5.0,
        refractory_period_us=0,
    ),
    "peer-common": V2eConfig(
        threshold_sigma=0.0,
        cutoff_hz=0.0,
        leak_rate_hz=0.0,
        shot_noise_rate_hz=0.0,
        refractory_period_us=0,
    ),
}
"""Name → options."""
