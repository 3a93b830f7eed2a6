"""Bias currents of DAVIS sensors, and the thresholds that follow from them."""

from __future__ import annotations

import math
import re

from texvent.errors import ConfigError, shown
from texvent.simulate.random.mismatch import LOWEST_THRESHOLD

CURRENT_NAMES = ("diff", "on", "off", "refr", "pr", "sf")
"""DiffBn, OnBn, OffBn, RefrBp, PrBp and PrSFBp of libcaer and jAER."""
COARSE_PA = (11, 94, 756, 6054, 48_437, 387_500, 3_100_000, 24_800_000)
"""Current of each coarse value at the largest fine value, pA (libcaer, davis.c)."""
FINEST = 255
UNITS_PA = {"pa": 1.0, "na": 1e3, "ua": 1e6, "µa": 1e6}
KAPPA_N = KAPPA_P = 0.7
"""Back-gate coefficients of the transistors."""
CAPACITANCE_RATIO = 20.0
"""C1 / C2: gain of the change amplifier."""
PER_LOG_CURRENT = KAPPA_N / (KAPPA_P * KAPPA_P) / CAPACITANCE_RATIO
"""Threshold per log unit of the ratio of two currents, 1 / 14."""
REFRACTORY_CHARGE_FC = 20.0 * 0.8
"""Charge that ends the refractory period, 20 fF times 0.8 V, fC; jAER calls it a guess."""


def parse_current(camera: str, name: str, value: str) -> float:
    """A bias current, pA, from `COARSE/FINE` as in libcaer, DV and jAER, or from `2.5nA`.

    Raises:
        ConfigError: it is neither, or out of range.
    """
    pair = re.fullmatch(r"(\d)/(\d{1,3})", value)
    if pair and int(pair[1]) < len(COARSE_PA) and 1 <= int(pair[2]) <= FINEST:
        return COARSE_PA[int(pair[1])] * int(pair[2]) / FINEST
    current = re.fullmatch(r"(\d{1,9}(?:\.\d{1,9})?)\s*([pnuµ]a)", value.lower())
    if current and 1.0 <= float(current[1]) * UNITS_PA[current[2]] <= COARSE_PA[-1]:
        return float(current[1]) * UNITS_PA[current[2]]
    raise ConfigError(
        f"bias: {name} of {camera} is {shown(value)}; it must be COARSE/FINE, 0/1..7/255, or a "
        "current, 1pA..24.8uA"
    )


def threshold(camera: str, larger: tuple[str, float], smaller: tuple[str, float]) -> float:
    """Threshold that follows from the ratio of two currents, log units.

    `θ = κn / κp² · C2 / C1 · ln(I_larger / I_smaller)`: larger is ON over the amplifier's current,
    or the amplifier's over OFF.

    Args:
        camera: for messages.
        larger: name and current.
        smaller: name and current.

    Source: Nozaki and Delbruck, "Temperature and parasitic photocurrent effects in dynamic vision
        sensors", IEEE Trans. Electron Devices 64 (2017); κ = 0.7 and C1 / C2 = 20 as in jAER,
        `DavisConfig.java`. It holds below threshold; neither mismatch nor temperature is in it.

    Raises:
        ConfigError: the threshold is below the least one of the model.

    Example:
        >>> round(threshold("davis346", ("on", 387_500.0), ("diff", 7_408.0)), 3)
        0.283
    """
    value = PER_LOG_CURRENT * math.log(larger[1] / smaller[1])
    if value < LOWEST_THRESHOLD:
        raise ConfigError(
            f"bias: {larger[0]} of {camera} is {larger[1]:g} pA and {smaller[0]} {smaller[1]:g} "
            f"pA, a threshold of {value:.3f}; it must be at least {LOWEST_THRESHOLD}"
        )
    return value


def refractory_us(current_pa: float) -> int:
    """Refractory period of a current, µs, rounded: charge over current.

    Source: jAER, `DavisConfig.java: getRefractoryPeriodS`, which guesses the charge: trust its
        order of magnitude, and the ratio of two periods.

    Example:
        >>> refractory_us(4748.7), refractory_us(47.5)
        (3, 337)
    """
    return round(REFRACTORY_CHARGE_FC / current_pa * 1e3)
