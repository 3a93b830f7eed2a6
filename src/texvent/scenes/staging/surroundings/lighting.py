"""Light of a place at its time of day, as a scene says otherwise, and its modulation over time."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.colours import TINTS, find_colour
from texvent.scenes.description import Illumination
from texvent.scenes.models.materials import mix
from texvent.scenes.models.places import Place
from texvent.scenes.scene import LAMP_COLUMNS, Colour, Float64Array, Ground

_WHITE: Colour = (1.0, 1.0, 1.0)
_BRIGHT, _DIM, _DIM_LAMPS = 1.35, 0.22, 0.35
"""Factors on exposure, and strength of lamps in dim light."""
_BACKLIT = 1.25
"""Exposure where things are lit from behind."""
_GREYED = 0.6
"""How much of a sky's own blue light of another colour takes away."""
_COLOURED = 1.35
"""Exposure of light of a named colour, which lacks the others."""
_PURE = 0.85
"""How much of a named colour is in light of that colour."""
_ELEVATIONS_DEG = {"left": 32.0, "right": 32.0, "back": 24.0, "front": 32.0, "above": 80.0}
"""Direction of light → height of the sun above the horizon."""
_BEARINGS_DEG = {"left": 90.0, "right": -90.0, "back": 12.0, "front": 165.0, "above": 0.0}
"""The same → bearing of the sun, from where the camera looks towards its left."""


_WARM: Colour = (1.0, 0.72, 0.40)
_LAMP_OFFSET = np.array([-0.25, -0.25, 0.55])
"""From what the camera looks at to a lamp out of sight, in distances of the camera."""
_TINTS: dict[str, Colour] = {
    "warm": (1.24, 0.92, 0.54),
    "golden": (1.28, 0.90, 0.40),
    "cold": (0.64, 0.93, 1.30),
}
"""Tint → factors on red, green and blue of linear light."""


@dataclass(frozen=True)
class Lighting:
    """Direct and ambient light, sky, and exposure."""

    sun_direction: tuple[float, float, float]
    sun: Colour
    ambient: Colour
    sky_top: Colour
    sky_horizon: Colour
    clouds: float
    exposure: float = 1.0
    shadows: bool = True
    lamps: float = 0.0
    """Strength of artificial light where a place has lamps, 0..1."""


_DAY = Lighting(
    (-0.45, -0.55, 0.70), (1.0, 0.94, 0.82), (0.30, 0.34, 0.41), (0.10, 0.28, 0.72),
    (0.55, 0.71, 0.88), 0.22,
)  # fmt: skip
LIGHTINGS: dict[str, Lighting] = {
    "day": _DAY,
    "sunny": replace(_DAY, sun=(1.18, 1.08, 0.88), clouds=0.08, ambient=(0.27, 0.31, 0.38)),
    "overcast": Lighting(
        (-0.3, -0.4, 0.86), (0.22, 0.22, 0.22), (0.56, 0.58, 0.61), (0.42, 0.46, 0.52),
        (0.60, 0.63, 0.66), 0.85, shadows=False,
    ),
    "dusk": Lighting(
        (0.80, -0.42, 0.26), (1.10, 0.53, 0.22), (0.27, 0.23, 0.30), (0.045, 0.06, 0.20),
        (0.62, 0.27, 0.105), 0.34, 1.75, lamps=0.5,
    ),
    "dawn": Lighting(
        (-0.80, -0.42, 0.28), (1.0, 0.62, 0.42), (0.26, 0.25, 0.33), (0.20, 0.30, 0.62),
        (0.98, 0.66, 0.52), 0.30, 1.05,
    ),
    "night": Lighting(
        (-0.45, -0.50, 0.74), (0.055, 0.07, 0.11), (0.030, 0.038, 0.068), (0.004, 0.006, 0.020),
        (0.016, 0.020, 0.042), 0.0, 2.1, lamps=1.0,
    ),
    "moonlight": Lighting(
        (-0.45, -0.50, 0.74), (0.15, 0.18, 0.25), (0.040, 0.050, 0.085), (0.005, 0.008, 0.026),
        (0.022, 0.028, 0.060), 0.0, 1.6, lamps=0.4,
    ),
    "lamp": Lighting(
        (-0.45, -0.50, 0.74), (0.03, 0.03, 0.035), (0.05, 0.045, 0.04), (0.004, 0.006, 0.02),
        (0.016, 0.02, 0.04), 0.0, 1.5, lamps=1.0,
    ),
}  # fmt: skip
"""Lighting of every light the grammar knows."""

_ROOM = Lighting(
    (-0.35, -0.45, 0.82), (0.55, 0.53, 0.48), (0.46, 0.45, 0.43), (0.8, 0.8, 0.8),
    (0.8, 0.8, 0.8), 0.0,
)  # fmt: skip
_UNDERWATER = Lighting(
    (0.12, -0.30, 0.95), (0.55, 0.78, 0.80), (0.14, 0.30, 0.38), (0.10, 0.42, 0.55),
    (0.03, 0.19, 0.30), 0.0, 1.1,
)  # fmt: skip
_SPACE = Lighting(
    (-0.75, -0.55, 0.35), (1.3, 1.25, 1.15), (0.05, 0.055, 0.07), (0.0, 0.0, 0.003),
    (0.0, 0.0, 0.003), 0.0,
)  # fmt: skip
_DAYLIGHTS = {"room": _ROOM, "underwater": _UNDERWATER, "space": _SPACE}
"""Daylight of places that are not in the open air."""
_DARK = ("night", "moonlight", "lamp")


def usual_lighting(place: Place, kind: str) -> Lighting:
    """The lighting of a place at a time of day, or under another light of `LIGHTINGS`."""
    if place.light == "underwater":
        return _UNDERWATER
    if place.light == "space" or (place.light and kind not in _DARK):
        return _DAYLIGHTS[place.light]
    if place.ground is Ground.NONE and kind == "night":
        return LIGHTINGS["moonlight"]  # no lamps up there: without a moon one sees nothing
    chosen = LIGHTINGS[kind]
    return replace(chosen, lamps=0.3 * chosen.lamps) if place.ground is Ground.SNOW else chosen


def choose_lighting(place: Place, light: Illumination) -> Lighting:
    """The lighting of a place at that time of day, as its words say but for its direction."""
    lighting = usual_lighting(place, light.kind or "day")
    if light.shadows is not None:
        lighting = replace(lighting, shadows=light.shadows)
    lighting = _brighten(lighting, light.brightness)
    if light.direction == "back":
        lighting = replace(lighting, exposure=_BACKLIT * lighting.exposure)
    tint = tint_of(light)
    if tint is None:
        return lighting
    is_white = light.tint in _TINTS
    return replace(
        lighting,
        sun=_times(lighting.sun, tint),
        ambient=_times(lighting.ambient, tint),
        sky_top=_times(_greyed(lighting.sky_top), tint),
        sky_horizon=_times(_greyed(lighting.sky_horizon), tint),
        exposure=lighting.exposure * (1.0 if is_white else _COLOURED),
    )


def tint_of(light: Illumination) -> Colour | None:
    """Factors on red, green and blue that give light the colour that is said; None = none is."""
    if light.tint is None:
        return None
    if light.tint in _TINTS:
        return _TINTS[light.tint]
    red, green, blue = find_colour(light.tint, TINTS)
    most = max(red, green, blue, 1e-9)
    return mix(_WHITE, (red / most, green / most, blue / most), _PURE)


def _brighten(lighting: Lighting, brightness: str | None) -> Lighting:
    """Brighter or dimmer."""
    if brightness == "bright":
        return replace(lighting, exposure=_BRIGHT * lighting.exposure)
    if brightness == "dim" and lighting.lamps == 0.0:  # lamps that are on are dim enough
        return replace(lighting, exposure=_DIM * lighting.exposure, lamps=_DIM_LAMPS)
    return lighting


def towards_light(usual: Float64Array, looking: Float64Array, light: Illumination) -> Float64Array:
    """Unit vector [3] towards the sun, or a lamp out of sight, where words say where it is.

    `looking` is the unit vector [3] that the camera looks along.
    """
    if light.direction is None:
        return usual
    elevation = math.radians(_ELEVATIONS_DEG[light.direction])
    bearing = math.atan2(looking[1], looking[0]) + math.radians(_BEARINGS_DEG[light.direction])
    flat = math.cos(elevation)
    return np.array([flat * math.cos(bearing), flat * math.sin(bearing), math.sin(elevation)])


def hidden_lamp(
    target: Float64Array,
    reach_m: float,
    strength: float,
    light: Illumination,
    looking: Float64Array,
) -> Float64Array:
    """[15] a lamp out of sight, as in `Environment.lamps`, that lights the ground below it.

    It is warm where it has no colour, and stands off the target [3] by shares of `reach_m`.
    """
    row, offset = np.zeros(LAMP_COLUMNS), _LAMP_OFFSET
    if light.direction is not None:
        far = float(np.linalg.norm(offset))
        offset = far * towards_light(offset / far, looking, light)
    row[:3] = target + reach_m * offset
    height = max(float(row[2]), 0.7)
    row[3:6] = 1.1 * strength * height**2 * np.array(tint_of(light) or _WARM)
    row[6], row[10], row[11], row[12] = 5.0 * height, -2.0, -2.0, 0.3
    return row


def _greyed(sky: Colour) -> Colour:
    grey = 0.30 * sky[0] + 0.59 * sky[1] + 0.11 * sky[2]
    return mix(sky, (grey, grey, grey), _GREYED)


def _times(colour: Colour, factors: Colour) -> Colour:
    return colour[0] * factors[0], colour[1] * factors[1], colour[2] * factors[2]


ON_SHARES = {"square": 0.5, "switch": 0.5, "strobe": 0.35}
"""Wave that goes on and off → share of a period that it is on."""
DEPTHS = {"sine": 0.8, "switch": 0.9, "strobe": 0.96}
"""Wave of the light of a place → share of it that is gone at its darkest."""
FLAME_SHARES = ((1.0, 0.13), (1.83, 0.09), (3.17, 0.06))
"""Sines that make a flame flicker: multiple of its frequency, and amplitude."""


def wave_level(wave: str, cycles: float, *, phase: float = 0.0) -> float:
    """Share of full light after so many periods since t = 0; 1 at their beginning.

    `phase`, 0..1, is that of a flame.
    """
    turn = 2.0 * math.pi
    if wave in ON_SHARES:
        return float(cycles % 1.0 < ON_SHARES[wave])
    if wave == "flame":
        return 1.0 + sum(
            share * math.sin(turn * (multiple * cycles + phase * (1.0 + multiple)))
            for multiple, share in FLAME_SHARES
        )
    return 0.5 + 0.5 * math.cos(turn * cycles)
