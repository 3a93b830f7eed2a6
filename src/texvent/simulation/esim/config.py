"""Options of the ESIM pixel model."""

from __future__ import annotations

from dataclasses import dataclass

from texvent.config import check_range
from texvent.simulation.random.mismatch import (
    check_nominal_thresholds,
    smaller_threshold,
)

WHITE = 255.0


@dataclass(frozen=True, kw_only=True)
class EsimConfig:
    """Options of the ESIM pixel model; the defaults are those of VID2E.

    Raises:
        ConfigError: an option is out of range.

    Example:
        >>> from texvent.pixel_models import EsimConfig
        >>> config = EsimConfig(contrast_threshold_on=0.3)
        >>> config.contrast_threshold, config.balance
        (0.2, 0.255)
    """

    contrast_threshold_on: float = 0.2
    """Rise of ln(I/255 + log eps) that fires an ON event."""
    contrast_threshold_off: float = 0.2
    """Fall of ln(I/255 + log eps) that fires an OFF event."""
    threshold_sigma: float = 0.0
    """Standard deviation of both thresholds, log units; they are drawn again for every pixel and
    frame, as ESIM describes it, and are at least 0.01."""
    log_eps: float = 1e-3
    """Added to intensities on the 0..1 scale before the logarithm, above 0."""
    refractory_period_us: int = 0
    """Time after an event in which the pixel cannot fire; crossings in it are lost."""

    def __post_init__(self) -> None:
        check_nominal_thresholds(self)
        check_range("log_eps", self.log_eps, 1e-9, 1.0)
        check_range("refractory_period_us", self.refractory_period_us, 0, 10**9)

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units: δ that Eq. 4 should count with."""
        return smaller_threshold(self)

    @property
    def balance(self) -> float:
        """`255 · log_eps`, the α with which Eq. 4's logarithm is the model's own."""
        return WHITE * self.log_eps
