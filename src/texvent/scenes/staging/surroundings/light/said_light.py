"""How words change the light of a place: its colour, hardness, brightness and direction."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.description import Illumination
from texvent.scenes.models.materials import mix
from texvent.scenes.scene import Colour, Float64Array
from texvent.scenes.staging.surroundings.light.lighting import Lighting, usual_lighting

_WHITE: Colour = (1.0, 1.0, 1.0)
_SOFT_SUN, _SOFT_SIDE_SUN = 0.45, 0.8
"""Share of direct light that is left where light is soft, and where it is said where it comes from;
the rest comes from all around."""
_HARD_SUN, _HARD_AMBIENT = 1.4, 0.5
_BRIGHT, _GLOOMY, _DIM = 1.35, 0.5, 0.22
"""Factors on light."""
_DIM_LAMPS = 0.35
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
_LOW_DEG = 14.0
_BEARINGS_DEG = {"left": 90.0, "right": -90.0, "back": 12.0, "front": 165.0, "above": 0.0}
"""The same → bearing of the sun, from where the camera looks towards its left."""


_TINTS: dict[str, Colour] = {
    "warm": (1.24, 0.92, 0.54),
    "golden": (1.28, 0.90, 0.40),
    "cold": (0.64, 0.93, 1.30),
}
"""Tint → factors on red, green and blue of linear light."""


def choose_lighting(place: str, light: Illumination) -> Lighting:
    """The lighting of a place at that time of day, as its words say but for its direction."""
    lighting = usual_lighting(place, light.kind or "day")
    if light.shadows is not None:
        lighting = replace(lighting, shadows=light.shadows)
    lighting = _illuminate(lighting, light)
    if light.direction == "back":
        lighting = replace(lighting, exposure=_BACKLIT * lighting.exposure)
    tint = tint_of(light)
    if tint is None:
        return lighting
    is_white = light.tint is not None and light.tint.name in _TINTS
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
    if light.tint.name in _TINTS:
        return _TINTS[light.tint.name]
    red, green, blue = light.tint.rgb
    most = max(red, green, blue, 1e-9)
    return mix(_WHITE, (red / most, green / most, blue / most), _PURE)


def _illuminate(lighting: Lighting, light: Illumination) -> Lighting:
    """Harder or softer, brighter or dimmer."""
    if light.hardness == "soft":
        left = _SOFT_SUN if light.direction is None else _SOFT_SIDE_SUN
        spread = 0.6 * (1.0 - left)
        lighting = replace(
            lighting,
            sun=_times(lighting.sun, (left,) * 3),
            ambient=_plus(lighting.ambient, _times(lighting.sun, (spread,) * 3)),
            shadows=False,
        )
    elif light.hardness == "hard":
        lighting = replace(
            lighting,
            sun=_times(lighting.sun, (_HARD_SUN,) * 3),
            ambient=_times(lighting.ambient, (_HARD_AMBIENT,) * 3),
            shadows=True,
        )
    if light.brightness == "bright":
        lighting = replace(lighting, exposure=_BRIGHT * lighting.exposure)
    elif light.brightness == "gloomy":
        lighting = replace(lighting, exposure=_GLOOMY * lighting.exposure)
    elif light.brightness == "dim" and lighting.lamps <= 0.0:
        lighting = replace(lighting, exposure=_DIM * lighting.exposure, lamps=_DIM_LAMPS)
    return lighting


def towards_light(usual: Float64Array, looking: Float64Array, light: Illumination) -> Float64Array:
    """Unit vector [3] towards the sun, or a lamp out of sight, where words say where it is.

    Args:
        usual: [3] unit vector towards it where nothing is said.
        looking: [3] unit vector that the camera looks along.
        light: what is said.
    """
    if light.direction is None and not light.is_low:
        return usual
    elevation, bearing = math.radians(_LOW_DEG), math.atan2(usual[1], usual[0])
    if light.direction is not None:
        bearing = math.atan2(looking[1], looking[0])
        bearing += math.radians(_BEARINGS_DEG[light.direction])
        if not light.is_low:
            elevation = math.radians(_ELEVATIONS_DEG[light.direction])
    flat = math.cos(elevation)
    return np.array([flat * math.cos(bearing), flat * math.sin(bearing), math.sin(elevation)])


def _greyed(sky: Colour) -> Colour:
    grey = 0.30 * sky[0] + 0.59 * sky[1] + 0.11 * sky[2]
    return mix(sky, (grey, grey, grey), _GREYED)


def _times(colour: Colour, factors: Colour) -> Colour:
    return colour[0] * factors[0], colour[1] * factors[1], colour[2] * factors[2]


def _plus(first: Colour, second: Colour) -> Colour:
    return first[0] + second[0], first[1] + second[1], first[2] + second[2]
