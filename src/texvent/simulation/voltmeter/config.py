"""Options of the DVS-Voltmeter pixel model, and its presets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, NamedTuple

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError, shown


class Constants(NamedTuple):
    """Constants of drift and diffusion: intensities 0..255, times in µs, voltages in thresholds."""

    k1: float
    """Gain: events per unit of relative change of light, ΔL / (L + k2)."""
    k2: float
    """Dark offset of the light, in levels of 0..255."""
    k3: float
    """Photon noise: its share of the diffusion is k3 √L / (L + k2), per √µs."""
    k4: float
    """Leakage: constant drift, thresholds per µs."""
    k5: float
    """Parasitic photocurrent: drift per level of light, thresholds per µs."""
    k6: float
    """Leakage noise: constant diffusion, per √µs."""

    def __str__(self) -> str:
        return " ".join(map(repr, self))


RANGES = {
    "k1": (1e-3, 1e3),
    "k2": (0.1, 1e6),
    "k3": (0.0, 0.1),
    "k4": (-0.01, 0.01),
    "k5": (-1e-4, 1e-4),
    "k6": (0.0, 0.1),
}
"""Lowest and highest value of every constant."""


def parse_constants(text: str) -> Constants:
    """The constants that a text such as "5.265 20 1e-4 1e-7 5e-9 1e-5" holds.

    Raises:
        ConfigError: it is no list of six numbers, or one is out of range.
    """
    try:
        constants = Constants(*map(float, text.replace(",", " ").split()))
    except (ValueError, TypeError):
        raise ConfigError(
            f"constants is {shown(text)}; it must be the six numbers k1 to k6, such as "
            f"'{VoltmeterConfig.constants}'"
        ) from None
    for name, (low, high) in RANGES.items():
        check_range(name, getattr(constants, name), low, high)
    return constants


@dataclass(frozen=True, kw_only=True)
class VoltmeterConfig:
    """Options of the DVS-Voltmeter pixel model; the default constants are the DAVIS346's.

    Raises:
        ConfigError: a constant is out of range.

    Example:
        >>> from texvent.pixel_models import VoltmeterConfig
        >>> VoltmeterConfig(constants="5.265 20 0 0 0 0").k.k1
        5.265
    """

    constants: str = "5.265 20 1e-4 1e-7 5e-9 1e-5"
    """k1 to k6 of the publication: gain, dark offset, photon noise, leakage, parasitic
    photocurrent, leakage noise."""
    initial_phase: Literal["random", "zero"] = "random"
    """Voltages at the first frame: anywhere up to the next leak event (random), or all zero (zero),
    which makes equal pixels leak in unison."""

    def __post_init__(self) -> None:
        parse_constants(self.constants)
        check_choices(self)

    @property
    def k(self) -> Constants:
        """The constants as numbers."""
        return parse_constants(self.constants)


PRESETS: Mapping[str, VoltmeterConfig] = {
    "davis346": VoltmeterConfig(),
    "davis240": VoltmeterConfig(constants="4.424 23 2e-4 1e-7 5e-8 1e-5"),
    "peer-common": VoltmeterConfig(initial_phase="zero"),
}
"""Name → options."""
