"""Options of the paper's pixel model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from texvent.config import IdleOptions, check_choices, check_range
from texvent.errors import ConfigError

CachePolicy = Literal["local", "global", "none"]
ResetRule = Literal["current", "step"]
NoiseKind = Literal["adaptive", "gaussian", "random", "none"]
TimestampRule = Literal["eq7", "random", "linear", "end"]


@dataclass(frozen=True, kw_only=True)
class TexventConfig:
    """Options of the Texvent pixel model.

    The defaults are those of the preset "accurate"; "paper" has the publication's, or our choice
    where it gives none (docs/equations.md says which).

    Raises:
        ConfigError: an option is out of range, or two contradict each other.

    Example:
        >>> from texvent.pixel_models import TexventConfig
        >>> TexventConfig(contrast_threshold=0.3, noise="none").balance
        20.0
    """

    idle_with: ClassVar[IdleOptions] = {
        "residual_decay_hz": ("cache", ("local", "none")),
        "noise_rate_hz": ("noise", ("none",)),
        "noise_scale": ("noise", ("none",)),
        "noise_intensity": ("noise", ("none", "gaussian", "random")),
        "noise_on_fraction": ("noise", ("none", "gaussian")),
    }

    contrast_threshold: float = 0.2
    """Contrast threshold δ of ln(α + I). A change of brightness by it fires an event."""
    balance: float = 20.0
    """Balance α, in levels of 0..255: what is added to intensities before the logarithm, so that
    dark pixels do not fire more easily than bright ones."""
    cache: CachePolicy = "global"
    """Memory of the reference brightness of a pixel that has not fired: for the whole video
    (global), within a pair of source frames (local, the paper's; slow motion at a high frame rate
    then gives no event), or not at all (none)."""
    residual_decay_hz: float = 0.1
    """With --cache global: rate at which a pixel forgets change that has not fired yet, per second;
    0 is never."""
    reset: ResetRule = "step"
    """Reset of a pixel that fires: its reference becomes the current brightness (current), or moves
    by one threshold per event, as in the circuit (step)."""
    multi_event: bool = True
    """Fire one event per threshold crossed, not one per frame; needs a --timestamp-rule other than
    eq7."""
    noise: NoiseKind = "adaptive"
    """Background activity: adaptive, gaussian, random or none. Adaptive fires dark, resting pixels
    (Eq. 6); gaussian is noise on the brightness; random fires any pixel."""
    noise_rate_hz: float = 0.2
    """Noise events per pixel and second, where there is noise (λ1)."""
    noise_scale: float = 1.0
    """Sensor factor on the noise rate (in λ2). With a --sensor whose fill factor is published it is
    the DAVIS346's divided by it."""
    noise_intensity: float = 40.0
    """Pixels darker than this level of 0..255 are low-light (σ); with --noise adaptive."""
    noise_on_fraction: float = 0.5
    """Share of ON among noise events, 0..1; Gaussian noise decides polarity by itself."""
    timestamp_rule: TimestampRule = "linear"
    """Time of an event between two frames: larger change earlier (eq7), random, where a straight
    line crosses the threshold (linear), or at the end (end)."""

    def __post_init__(self) -> None:
        check_range("contrast_threshold", self.contrast_threshold, 1e-4, 10.0)
        check_range("balance", self.balance, 1e-6, 1e6)
        check_range("residual_decay_hz", self.residual_decay_hz, 0.0, 1e6)
        check_range("noise_rate_hz", self.noise_rate_hz, 0.0, 1e4)
        check_range("noise_scale", self.noise_scale, 0.0, 1e3)
        check_range("noise_intensity", self.noise_intensity, 0.0, 1e6)
        check_range("noise_on_fraction", self.noise_on_fraction, 0.0, 1.0)
        check_choices(self)
        if self.multi_event and self.timestamp_rule == "eq7":
            raise ConfigError(
                "timestamp_rule 'eq7' gives a pixel one time per frame, but multi_event lets it "
                "fire several times; use timestamp_rule 'linear', 'random' or 'end'"
            )

    @property
    def has_added_noise(self) -> bool:
        """Whether noise events are added to the others (Eq. 6), not only to the brightness."""
        return self.noise in ("adaptive", "random") and self.noise_rate_hz * self.noise_scale > 0

    @property
    def is_fusible(self) -> bool:
        """Whether a pair can be computed without drawing its frames; ablations are not."""
        is_usual = self.reset == "current" or self.multi_event
        return is_usual and self.cache != "none" and self.noise != "gaussian"

    def expected_noise(self, duration_s: float) -> float:
        """λ1 · λ2: noise events per pixel in a sub-interval of so many seconds."""
        return self.noise_rate_hz * (self.noise_scale * duration_s)


PRESETS: Mapping[str, TexventConfig] = {
    # Chosen by measurement against true and recorded events (docs/benchmark.md).
    "accurate": TexventConfig(),
    "paper": TexventConfig(
        balance=30.0,
        cache="local",
        reset="current",
        multi_event=False,
        residual_decay_hz=0.0,
        noise_rate_hz=0.1,
        noise_intensity=80.0,
        timestamp_rule="eq7",
    ),
}
"""Name → options."""
