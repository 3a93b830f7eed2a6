"""Usual light of each place and time of day."""

from __future__ import annotations

from dataclasses import dataclass, replace

from texvent.scenes.scene import Colour
from texvent.scenes.staging.surroundings.places import is_room


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

_INDOOR_DAY = Lighting(
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


def usual_lighting(place: str, kind: str) -> Lighting:
    """The lighting of a place at a time of day, or under another light of `LIGHTINGS`."""
    if place == "underwater":
        chosen = _UNDERWATER
        if kind in ("night", "moonlight", "dusk"):
            chosen = replace(chosen, sun=(0.14, 0.22, 0.26), ambient=(0.05, 0.11, 0.16))
    elif place == "space":
        chosen = _SPACE
    elif is_room(place) and kind in ("day", "sunny", "overcast", "dawn", "dusk"):
        chosen = _INDOOR_DAY
    elif place == "sky" and kind == "night":
        chosen = LIGHTINGS["moonlight"]  # no lamps up there: without a moon one sees nothing
    else:
        chosen = LIGHTINGS[kind]
    if place == "snow":
        chosen = replace(chosen, lamps=0.3 * chosen.lamps)
    return chosen
