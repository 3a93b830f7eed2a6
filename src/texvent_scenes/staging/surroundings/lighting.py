"""Light of a place at its time of day, and its modulation over time."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from texvent_scenes.models.places import PlaceModel
from texvent_scenes.rendered_scene import LAMP_RECORD, Colour, Float64Array, Ground
from texvent_scenes.spec.scene import Light, Scene

_WARM: Colour = (1.0, 0.72, 0.40)
_LAMP_OFFSET = np.array([-0.25, -0.25, 0.55])
"""From what the camera looks at to a lamp out of sight, in distances of the camera."""
_LAMP_LIGHT = 0.5
"""Light of that lamp on the ground below it: less than that of the sun."""


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
    water: Colour = (0.05, 0.28, 0.42)
    """Colour that all fades into under water."""


_DAY = Lighting(
    (-0.45, -0.55, 0.70), (1.0, 0.94, 0.82), (0.30, 0.34, 0.41), (0.10, 0.28, 0.72),
    (0.55, 0.71, 0.88), 0.42,
)  # fmt: skip
LIGHTINGS: dict[str, Lighting] = {
    "day": _DAY,
    "sunny": replace(_DAY, sun=(1.18, 1.08, 0.88), clouds=0.3, ambient=(0.27, 0.31, 0.38)),
    "overcast": Lighting(
        (-0.3, -0.4, 0.86), (0.22, 0.22, 0.22), (0.56, 0.58, 0.61), (0.42, 0.46, 0.52),
        (0.60, 0.63, 0.66), 0.85, shadows=False,
    ),
    "stormy": Lighting(
        (-0.3, -0.4, 0.86), (0.09, 0.09, 0.10), (0.27, 0.29, 0.32), (0.07, 0.08, 0.10),
        (0.15, 0.165, 0.19), 0.95, shadows=False,
    ),
    "morning": Lighting(
        (-0.82, -0.42, 0.33), (1.55, 1.10, 0.70), (0.29, 0.30, 0.36), (0.13, 0.29, 0.66),
        (0.92, 0.78, 0.62), 0.35,
    ),
    "afternoon": Lighting(
        (0.82, -0.42, 0.33), (1.70, 1.08, 0.58), (0.30, 0.29, 0.33), (0.11, 0.24, 0.58),
        (0.95, 0.74, 0.46), 0.35,
    ),
    "dusk": Lighting(
        (0.80, -0.42, 0.26), (1.10, 0.53, 0.22), (0.27, 0.23, 0.30), (0.045, 0.06, 0.20),
        (0.62, 0.27, 0.105), 0.34, 1.15, lamps=0.5,
    ),
    "dawn": Lighting(
        (-0.80, -0.42, 0.28), (1.0, 0.62, 0.42), (0.26, 0.25, 0.33), (0.20, 0.30, 0.62),
        (0.98, 0.66, 0.52), 0.30, 1.05,
    ),
    "night": Lighting(
        (-0.45, -0.50, 0.74), (0.055, 0.07, 0.11), (0.030, 0.038, 0.068), (0.004, 0.006, 0.020),
        (0.016, 0.020, 0.042), 0.0, 1.3, lamps=1.0,
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
_FRESH_WATER = replace(
    _UNDERWATER, sun=(0.60, 0.74, 0.52), ambient=(0.20, 0.29, 0.21), sky_top=(0.17, 0.34, 0.23),
    sky_horizon=(0.07, 0.17, 0.11), water=(0.10, 0.24, 0.14),
)  # fmt: skip
_SPACE = Lighting(
    (-0.75, -0.55, 0.35), (1.3, 1.25, 1.15), (0.05, 0.055, 0.07), (0.0, 0.0, 0.003),
    (0.0, 0.0, 0.003), 0.0,
)  # fmt: skip
_WATERS = {"underwater": _UNDERWATER, "fresh water": _FRESH_WATER}
_DAYLIGHTS = {"room": _ROOM, **_WATERS, "space": _SPACE}
"""Daylight of places that are not in the open air."""
DARK = ("night", "moonlight", "lamp")
"""Kinds of light by which a sky is dark."""


_THROUGH_WATER = 0.12
"""Share of daylight under water that the sky of a night sends there."""
_THROUGH_WINDOWS = 0.2
"""Share of the light of a night sky that is left in a room without lamps."""


def is_unlit_room(place: PlaceModel, scene: Scene) -> bool:
    """Whether a room at night has no light of its own; those of sentences have it on."""
    is_night = scene.light.kind in ("night", "moonlight")
    return place.is_room and is_night and not scene.place.is_lit


def choose_lighting(place: PlaceModel, light: Light, *, is_unlit: bool = False) -> Lighting:
    """The lighting of a place at a time of day, or under another light of `LIGHTINGS`.

    `is_unlit` is as of `is_unlit_room`.
    """
    kind = light.kind or "day"
    if is_unlit:
        chosen = LIGHTINGS[kind]
        red, green, blue = (_THROUGH_WINDOWS * one for one in chosen.ambient)
        return replace(chosen, sun=(0.0, 0.0, 0.0), ambient=(red, green, blue), shadows=False)
    if (water := _WATERS.get(place.light)) is not None:
        return _dimmed(water, _THROUGH_WATER) if kind in DARK else water
    if place.light == "space" or (place.light and kind not in DARK):
        return _DAYLIGHTS[place.light]
    if place.ground is Ground.NONE and kind == "night":
        return LIGHTINGS["moonlight"]  # no lamps up there: without a moon one sees nothing
    chosen = LIGHTINGS[kind]
    return replace(chosen, lamps=0.3 * chosen.lamps) if place.ground is Ground.SNOW else chosen


def _dimmed(lighting: Lighting, share: float) -> Lighting:
    """The lighting with that share of its light."""
    names = ("sun", "ambient", "sky_top", "sky_horizon", "water")
    dimmer: dict[str, Any] = {
        name: tuple(share * one for one in getattr(lighting, name)) for name in names
    }
    return replace(lighting, **dimmer)


def daylight_share(lighting: Lighting) -> Colour:
    """Light on level ground as a share, per channel, of that by day."""
    now, day = (_on_level_ground(one) for one in (lighting, _DAY))
    red, green, blue = (one / usual for one, usual in zip(now, day, strict=True))
    return red, green, blue


def _on_level_ground(lighting: Lighting) -> Colour:
    """Light of sun and sky on level ground."""
    height = lighting.sun_direction[2] / math.hypot(*lighting.sun_direction)
    red, green, blue = (
        height * sun + sky for sun, sky in zip(lighting.sun, lighting.ambient, strict=True)
    )
    return red, green, blue


def hidden_lamp(target: Float64Array, reach_m: float, strength: float) -> NDArray[Any]:
    """[1] `LAMP_RECORD`: a lamp out of sight that lights the ground below it.

    It stands off the target [3] by shares of `reach_m`.
    """
    place = target + reach_m * _LAMP_OFFSET
    height = max(float(place[2]), 0.7)
    return point_lamp(
        place, _LAMP_LIGHT * strength * height**2 * np.array(_WARM), 5.0 * height, 0.3
    )


def point_lamp(place: ArrayLike, light: ArrayLike, reach_m: float, radius_m: float) -> NDArray[Any]:
    """[1] `LAMP_RECORD`: a lamp that shines to all sides, without shadows or glow."""
    lamp = np.zeros(1, LAMP_RECORD)
    lamp["place"], lamp["light"], lamp["reach"] = place, light, reach_m
    lamp["full"], lamp["dark"], lamp["radius"] = -2.0, -2.0, radius_m
    return lamp


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
