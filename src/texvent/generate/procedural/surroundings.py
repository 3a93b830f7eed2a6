"""The surroundings and the materials as the kernels read them: plain numbers and arrays."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from texvent.generate.procedural.primitives import Environment, Float64Array, Primitives

NIGHT_SKY = 0.06
"""Stars show where the sky at the zenith is darker than this (linear luma)."""
SUN_RADIUS = 0.022
"""Angular radius of the sun or moon, radians: about five times life, as pictures show it."""


class Materials(NamedTuple):
    """What shapes are made of, over n shapes; colours are linear RGB."""

    colour: Float64Array
    second_colour: Float64Array
    texture: Float64Array
    """[n, 3]: `Texture`, repeats per local unit, emission."""


class Surroundings(NamedTuple):
    """`Environment` for the kernels; vectors are tuples, colours linear RGB."""

    ground: int
    colour: tuple[float, float, float]
    second_colour: tuple[float, float, float]
    road: tuple[float, float, float, float, float]
    """Cosine and sine of its direction, half width, and a point (x, y) on it; metres."""
    sky_top: tuple[float, float, float]
    sky_horizon: tuple[float, float, float]
    clouds: float
    stars: float
    """0 by day .. 1 at night."""
    sun: tuple[float, float, float]
    sun_colour: tuple[float, float, float]
    sun_radius: float
    ambient: tuple[float, float, float]
    shadows: bool
    fog: float
    """1 / fog distance, per metre; 0 = clear."""
    fog_colour: tuple[float, float, float]
    exposure: float
    lamps: Float64Array
    """[m, 7] as in `Environment`."""
    room: float
    """Half the side of the room, metres; 0 = outdoors."""
    time: float


def _triple(values: object) -> tuple[float, float, float]:
    x, y, z = np.asarray(values, dtype=np.float64)
    return float(x), float(y), float(z)


def describe_materials(primitives: Primitives) -> Materials:
    """The materials of all shapes."""
    texture = np.stack([primitives.texture, primitives.texture_scale, primitives.emission], axis=1)
    return Materials(
        primitives.colour.astype(np.float64),
        primitives.second_colour.astype(np.float64),
        texture.astype(np.float64),
    )


def describe_surroundings(environment: Environment, *, shadows: bool) -> Surroundings:
    """The surroundings; `shadows` False turns shadows off whatever the scene says."""
    sun = np.asarray(environment.sun_direction, dtype=np.float64)
    red, green, blue = _triple(environment.sky_top)
    luma = 0.2126 * red + 0.7152 * green + 0.0722 * blue
    angle = float(environment.road_angle)
    return Surroundings(
        ground=int(environment.ground),
        colour=_triple(environment.ground_colour),
        second_colour=_triple(environment.ground_second_colour),
        road=(
            math.cos(angle),
            math.sin(angle),
            float(environment.road_half_width),
            float(environment.road_offset[0]),
            float(environment.road_offset[1]),
        ),
        sky_top=_triple(environment.sky_top),
        sky_horizon=_triple(environment.sky_horizon),
        clouds=float(environment.clouds),
        stars=float(np.clip(1.5 * (1.0 - luma / NIGHT_SKY), 0.0, 1.0)),
        sun=_triple(sun / np.linalg.norm(sun)),
        sun_colour=_triple(environment.sun_colour),
        sun_radius=SUN_RADIUS,
        ambient=_triple(environment.ambient),
        shadows=bool(environment.shadows) and shadows,
        fog=1.0 / float(environment.fog_distance),
        fog_colour=_triple(environment.fog_colour),
        exposure=float(environment.exposure),
        lamps=np.ascontiguousarray(np.asarray(environment.lamps, dtype=np.float64).reshape(-1, 7)),
        room=float(environment.room_half_size),
        time=float(environment.time_s),
    )
