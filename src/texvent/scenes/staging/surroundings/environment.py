"""Surroundings of each place and light, as functions of time."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import Illumination, SceneDescription, Surroundings
from texvent.scenes.models.materials import mix
from texvent.scenes.models.objects.patterns import FACING
from texvent.scenes.scene import (
    LAMP_COLUMNS,
    Colour,
    Environment,
    Float32Array,
    Float64Array,
    Ground,
    Texture,
)
from texvent.scenes.staging.surroundings.built_places import BUILT_GROUNDS
from texvent.scenes.staging.surroundings.ground_appearance import GroundAppearance, room
from texvent.scenes.staging.surroundings.lightning import STROKE_HZ, lightning_level
from texvent.scenes.staging.surroundings.road import RoadLine

FLICKER_DEPTH = 0.8
"""Share of the light that a flicker takes away at its darkest."""
ON_SHARE = {"strobe": 0.35, "switch": 0.5}
"""Wave of the light that goes on and off → share of a period that it is on."""
OFF_DEPTH = {"strobe": 0.96, "switch": 0.9}
"""The same → share of the light that is gone when it is off."""
_FLASH = np.array((0.42, 0.47, 0.60), dtype=np.float32)
"""Light of the brightest stroke of lightning."""
STROBE = 1.2
"""Light of a strobe's flash, as a share of that."""
TIMELAPSE = 60.0
"""How much faster the sky goes in a time lapse."""
_SUN_RAD_S = 2.0 * math.pi / 600.0
"""How fast the sun goes in a time lapse, per second of sky time."""


_SNOW: Colour = (0.78, 0.82, 0.88)
_SNOWED_OVER = (Ground.GRASS, Ground.ROAD, Ground.DIRT_ROAD, Ground.RIVER, Ground.LAKE)
"""Grounds whose grass is white when snow lies on it."""
_MEADOW: tuple[Colour, Colour] = ((0.055, 0.14, 0.022), (0.13, 0.21, 0.045))
_WATER: Colour = (0.016, 0.055, 0.065)
_OAK: tuple[Colour, Colour] = ((0.36, 0.20, 0.10), (0.46, 0.28, 0.15))
_ASPHALT: Colour = (0.04, 0.04, 0.043)

PLACES: dict[str, GroundAppearance] = {
    "road": GroundAppearance(Ground.ROAD, _MEADOW[0], _ASPHALT),
    "dirt road": GroundAppearance(Ground.DIRT_ROAD, (0.07, 0.12, 0.03), (0.34, 0.22, 0.12), 2.4),
    "city": GroundAppearance(Ground.CITY, (0.3, 0.3, 0.3), _ASPHALT, 4.5),
    "grass": GroundAppearance(Ground.GRASS, *_MEADOW),
    "savanna": GroundAppearance(Ground.GRASS, (0.30, 0.22, 0.075), (0.42, 0.33, 0.13)),
    "forest": GroundAppearance(
        Ground.GRASS, (0.085, 0.065, 0.028), (0.17, 0.095, 0.03), surface=Texture.LEAVES
    ),
    "gravel": GroundAppearance(
        Ground.PLAIN, (0.26, 0.25, 0.23), (0.36, 0.34, 0.30), surface=Texture.GRAVEL
    ),
    "soil": GroundAppearance(
        Ground.PLAIN, (0.20, 0.125, 0.07), (0.29, 0.20, 0.12), surface=Texture.SOIL
    ),
    "river": GroundAppearance(Ground.RIVER, _MEADOW[0], _WATER, 4.5),
    "lake": GroundAppearance(Ground.LAKE, _MEADOW[0], _WATER),
    "sea": GroundAppearance(Ground.SEA, (0.012, 0.07, 0.11), (0.03, 0.13, 0.16)),
    "underwater": GroundAppearance(Ground.UNDERWATER, (0.34, 0.31, 0.22), (0.5, 0.47, 0.36)),
    "sand": GroundAppearance(Ground.SAND, (0.56, 0.43, 0.25), (0.68, 0.55, 0.35)),
    "snow": GroundAppearance(Ground.SNOW, (0.66, 0.70, 0.75), (0.76, 0.79, 0.83)),
    "mountain": GroundAppearance(Ground.GRASS, (0.10, 0.13, 0.05), (0.22, 0.20, 0.12)),
    "indoor": room(Texture.BOARDS, _OAK, Texture.PLASTER, (0.75, 0.69, 0.61)),
    "living room": room(Texture.BOARDS, _OAK, Texture.WALLPAPER, (0.62, 0.60, 0.48)),
    "bedroom": room(
        Texture.CARPET,
        ((0.30, 0.27, 0.33), (0.42, 0.38, 0.42)),
        Texture.WALLPAPER,
        (0.55, 0.62, 0.70),
    ),
    "kitchen": room(
        Texture.TILES, ((0.62, 0.60, 0.55), (0.30, 0.29, 0.28)), Texture.TILES, (0.74, 0.74, 0.72)
    ),
    "office": room(
        Texture.CARPET,
        ((0.12, 0.14, 0.18), (0.20, 0.22, 0.26)),
        Texture.PLASTER,
        (0.72, 0.72, 0.70),
    ),
    "workshop": room(
        Texture.CONCRETE,
        ((0.30, 0.29, 0.28), (0.22, 0.21, 0.20)),
        Texture.BRICK,
        (0.36, 0.15, 0.10),
    ),
    "warehouse": room(
        Texture.CONCRETE,
        ((0.36, 0.36, 0.35), (0.27, 0.27, 0.26)),
        Texture.CONCRETE,
        (0.46, 0.45, 0.43),
    ),
    "gym": room(
        Texture.BOARDS,
        ((0.50, 0.33, 0.16), (0.58, 0.40, 0.21)),
        Texture.BRICK,
        (0.60, 0.57, 0.50),
    ),
    "sky": GroundAppearance(Ground.NONE, (0.3, 0.3, 0.3), (0.3, 0.3, 0.3)),
    "space": GroundAppearance(Ground.NONE, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    "construction site": GroundAppearance(
        Ground.SAND, (0.36, 0.27, 0.18), (0.44, 0.34, 0.23), surface=Texture.SOIL
    ),
    **BUILT_GROUNDS,
    "plain": GroundAppearance(Ground.PLAIN, (0.42, 0.42, 0.42), (0.48, 0.48, 0.48)),
}
"""Ground of every place the grammar knows."""


def is_room(place: str) -> bool:
    """Whether a place has walls and a ceiling."""
    return PLACES[place].ground is Ground.FLOOR


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
_WATER_COLOUR: Colour = (0.05, 0.28, 0.42)
_UNDERWATER_SIGHT_M = 16.0
_FOG_SIGHT = 3.0
"""In fog, sight (to 37 %) in camera distances."""


@dataclass(frozen=True)
class AnimatedEnvironment:
    """The surroundings as a function of time: all fixed, but for flicker, waves and clouds."""

    base: Environment
    flicker_hz: float | None
    wave: str = "sine"
    """As `Illumination.wave`."""
    has_lightning: bool = False
    time_scale: float = 1.0
    """How much faster than in life clouds, waves and the sun go."""

    def at(self, time_s: float) -> Environment:
        """The surroundings at that instant."""
        factor = np.float32(self.flicker(time_s))
        base = replace(
            self.base,
            time_s=self.time_scale * time_s,
            sun_colour=self.base.sun_colour * factor,
            ambient=self.base.ambient * factor,
        )
        if self.time_scale != 1.0:
            base = replace(base, sun_direction=_sun_at(base.sun_direction, base.time_s))
        level = lightning_level(time_s) if self.has_lightning else 0.0
        if self.wave == "strobe" and self.flicker(time_s) >= 1.0:
            return replace(base, ambient=base.ambient + np.float32(STROBE) * _FLASH)
        if level <= 0.0:
            return base
        flash = np.float32(level) * _FLASH
        return replace(
            base,
            ambient=base.ambient + flash,
            sky_top=base.sky_top + np.float32(0.5) * flash,
            sky_horizon=base.sky_horizon + flash,
        )

    @property
    def fastest_hz(self) -> float | None:
        """Highest frequency at which the light goes up and down, Hz; None = it is steady."""
        return STROKE_HZ if self.has_lightning else self.flicker_hz

    def flicker(self, time_s: float) -> float:
        """Share of full light at that instant: 1 at t = 0, period exactly 1 / flicker_hz."""
        if self.flicker_hz is None:
            return 1.0
        if self.wave != "sine":
            is_on = (self.flicker_hz * time_s) % 1.0 < ON_SHARE[self.wave]
            return 1.0 if is_on else 1.0 - OFF_DEPTH[self.wave]
        wave = math.cos(2.0 * math.pi * self.flicker_hz * time_s)
        return 1.0 - 0.5 * FLICKER_DEPTH * (1.0 - wave)


def _sun_at(direction: Float64Array, time_s: float) -> Float64Array:
    """The sun's direction [3] after so many seconds of sky time: it goes around, ever higher."""
    angle = _SUN_RAD_S * time_s
    cosine, sine = math.cos(angle), math.sin(angle)
    x, y, z = direction
    return np.array([cosine * x - sine * y, sine * x + cosine * y, z])


def choose_lighting(place: str, light: Illumination) -> Lighting:
    """The lighting of a place at that time of day."""
    kind = light.kind or "day"
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
    if light.shadows is not None:
        chosen = replace(chosen, shadows=light.shadows)
    return chosen


def build_environment(
    description: SceneDescription,
    *,
    place: str,
    road: RoadLine,
    distance_m: float,
    room_m: float,
) -> AnimatedEnvironment:
    """The surroundings of a scene.

    Args:
        description: what the prompt says of place, weather and light.
        place: key of `PLACES`.
        road: centre lines of the roads.
        distance_m: from the camera to what it looks at: fog is scaled to it.
        room_m: half the side of a room, m.
    """
    ground = PLACES[place]
    lighting, said = choose_lighting(place, description.light), description.surroundings
    colour, second = _ground_colours(ground, said)
    is_white = said.has_snow and ground.ground in _SNOWED_OVER
    is_backdrop = place == "plain" and said.sky is None
    has_lightning = any(effect.kind == "lightning" for effect in description.effects)
    sky_top, horizon, clouds = _choose_sky(description, lighting, has_lightning=has_lightning)
    if is_backdrop:
        # The same all around, without a horizon to speak of.
        sky_top = horizon = mix(colour, second, 0.5)
        if description.objects and all(one.noun in FACING for one in description.objects):
            ground = replace(ground, ground=Ground.NONE)
    fog_distance, fog_colour = _choose_fog(place, said.weather, horizon, distance_m)
    is_dim = said.weather in ("rain", "snow")
    sun_colour = mix(lighting.sun, (0.0, 0.0, 0.0), 0.4) if is_dim else lighting.sun
    base = Environment(
        ground=ground.ground,
        ground_colour=_array(colour),
        ground_second_colour=_array(second),
        road_angle=road.angle,
        road_half_width=ground.road_half_width,
        road_offset=np.array(road.offset, dtype=np.float64),
        sky_top=_array(sky_top),
        sky_horizon=_array(horizon),
        clouds=clouds,
        sun_direction=_unit(lighting.sun_direction),
        sun_colour=_array(sun_colour),
        ambient=_array(lighting.ambient),
        shadows=lighting.shadows,
        fog_distance=fog_distance,
        fog_colour=_array(fog_colour),
        exposure=lighting.exposure,
        lamps=np.zeros((0, LAMP_COLUMNS)),
        time_s=0.0,
        room_half_size=room_m,
        ground_surface=Texture.SNOW if is_white else ground.surface,
        has_stars=place != "plain",
        wall_surface=ground.walls,
        wall_colour=ground.wall_colour,
        road_curvature=road.curvature,
        road_crossings=np.array(road.crossings, dtype=np.float64).reshape(-1, 3),
    )
    return _animate(base, description, has_lightning=has_lightning)


def _animate(
    base: Environment, description: SceneDescription, *, has_lightning: bool
) -> AnimatedEnvironment:
    """The surroundings with the flicker, lightning and pace that the prompt asks for."""
    light = description.light
    return AnimatedEnvironment(
        base, light.flicker_hz, light.wave,
        has_lightning=has_lightning,
        time_scale=TIMELAPSE if description.is_timelapse else 1.0,
    )  # fmt: skip


def _choose_sky(
    description: SceneDescription, lighting: Lighting, *, has_lightning: bool
) -> tuple[Colour, Colour, float]:
    """Colours of the zenith and of the horizon, and the share of clouds."""
    said = description.surroundings
    top, horizon = lighting.sky_top, lighting.sky_horizon
    if said.sky is not None:
        top, horizon = said.sky.rgb, mix(said.sky.rgb, horizon, 0.5)
    is_backdrop = said.place == "plain" and said.sky is None
    usual = 0.0 if is_backdrop else lighting.clouds
    least = [usual if said.clouds is None else said.clouds]
    least += [0.5] * description.is_timelapse + [0.9] * has_lightning
    least += [0.8] * (said.weather in ("rain", "snow"))
    return top, horizon, max(least)


def _ground_colours(ground: GroundAppearance, said: Surroundings) -> tuple[Colour, Colour]:
    """Both colours of the ground, under snow or painted as the prompt says."""
    colour, second = ground.colour, ground.second_colour
    if said.has_snow and ground.ground in _SNOWED_OVER:
        colour = _SNOW
        second = _SNOW if ground.ground is Ground.GRASS else second
    if said.colour is not None:
        # Grass is darker than paint: blades shade one another.
        depth = 0.45 if ground.ground is Ground.GRASS else 0.8
        colour = mix((0.0, 0.0, 0.0), said.colour.rgb, depth)
        second = mix((0.0, 0.0, 0.0), said.colour.rgb, min(1.5 * depth, 1.0))
    return colour, second


def _choose_fog(
    place: str, weather: str | None, horizon: Colour, distance_m: float
) -> tuple[float, Colour]:
    if place == "underwater":
        return max(_UNDERWATER_SIGHT_M, 3.5 * distance_m), _WATER_COLOUR
    if weather == "fog":
        grey = sum(horizon) / 3.0
        return _FOG_SIGHT * distance_m, mix(horizon, (grey, grey, grey), 0.7)
    if weather in ("rain", "snow"):
        return 14.0 * distance_m, horizon
    return math.inf, horizon


def _array(colour: Colour) -> Float32Array:
    return np.array(colour, dtype=np.float32)


def _unit(direction: tuple[float, float, float]) -> Float64Array:
    unit: Float64Array = np.array(direction) / np.linalg.norm(direction)
    return unit
