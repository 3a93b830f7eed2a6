"""Options of DVS-Voltmeter's pixel model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from texvent.config import check_choices, check_range


@dataclass(frozen=True, kw_only=True)
class VoltmeterConfig:
    """Constants of the DVS-Voltmeter pixel model, for intensities 0..255 and times in µs.

    The defaults are the DAVIS346's. Voltage is measured in thresholds.

    Raises:
        ConfigError: a constant is out of range.
    """

    k1: float = 5.265
    """Gain: events per unit of relative change of light, ΔL / (L + k2)."""
    k2: float = 20.0
    """Dark offset of the light, in levels of 0..255."""
    k3: float = 1e-4
    """Photon noise: its share of the diffusion is k3 √L / (L + k2), per √µs."""
    k4: float = 1e-7
    """Leakage: constant drift, thresholds per µs."""
    k5: float = 5e-9
    """Parasitic photocurrent: drift per level of light, thresholds per µs."""
    k6: float = 1e-5
    """Leakage noise: constant diffusion, per √µs."""
    start_voltage: Literal["random", "zero"] = "random"
    """Voltages at the first frame: anywhere up to the next leak event (random), or all zero (zero),
    which makes equal pixels leak in unison."""

    def __post_init__(self) -> None:
        check_range("k1", self.k1, 1e-3, 1e3)
        check_range("k2", self.k2, 0.1, 1e6)
        check_range("k3", self.k3, 0.0, 0.1)
        check_range("k4", self.k4, -0.01, 0.01)
        check_range("k5", self.k5, -1e-4, 1e-4)
        check_range("k6", self.k6, 0.0, 0.1)
        check_choices(self)


PRESETS: Mapping[str, VoltmeterConfig] = {
    "davis346": VoltmeterConfig(),
    "davis240": VoltmeterConfig(k1=4.424, k2=23.0, k3=2e-4, k5=5e-8),
    "peer-common": VoltmeterConfig(start_voltage="zero"),
}
"""Name → options."""
