"""Lamps that a scene puts at positions of its own, beside those of its objects."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from texvent.scenes.colours import rgb_of
from texvent.scenes.description import SceneLamp
from texvent.scenes.scene import LAMP_COLUMNS, Float64Array
from texvent.scenes.staging.surroundings.environment import ON_SHARE

RADIUS_M = 0.03
FAINTEST = 0.004
"""A lamp's light ends where it is this."""


def scene_lamp_rows(lamps: Sequence[SceneLamp], time_s: float) -> Float64Array:
    """[m, 15] the lamps at an instant, as in `Environment.lamps`."""
    rows = np.zeros((len(lamps), LAMP_COLUMNS))
    for row, lamp in zip(rows, lamps, strict=True):
        light = lamp.strength * np.array(rgb_of(lamp.colour or "#ffffff", "light"))
        row[:3] = lamp.position_m
        row[3:6] = light * level_at(lamp, time_s)
        row[6] = math.sqrt(max(light.max(), 1e-9) / FAINTEST)
        row[10] = row[11] = -2.0
        row[12] = RADIUS_M
        row[13] = float(lamp.has_shadows)
    return rows


def level_at(lamp: SceneLamp, time_s: float) -> float:
    """Share of a lamp's light at an instant: 1 at t = 0, period exactly 1 / frequency_hz."""
    if lamp.frequency_hz is None:
        return 1.0
    if lamp.wave == "sine":
        return 0.5 + 0.5 * math.cos(2.0 * math.pi * lamp.frequency_hz * time_s)
    return float((lamp.frequency_hz * time_s) % 1.0 < ON_SHARE[lamp.wave])


def fastest_hz(lamps: Sequence[SceneLamp]) -> float | None:
    """Highest frequency of modulation, Hz; None = all lamps are steady."""
    return max((one.frequency_hz for one in lamps if one.frequency_hz is not None), default=None)
