"""Surroundings of each place and light as functions of time, with rain and snow."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.colours import rgb_of
from texvent.scenes.description import SceneDescription, Surroundings
from texvent.scenes.models.materials import mix
from texvent.scenes.models.places import Place
from texvent.scenes.models.tables import nouns_with
from texvent.scenes.scene import (
    LAMP_COLUMNS,
    Colour,
    Environment,
    Float32Array,
    Float64Array,
    Ground,
    Texture,
)
from texvent.scenes.staging.surroundings.lighting import (
    DEPTHS,
    Lighting,
    choose_lighting,
    towards_light,
    wave_level,
)
from texvent.scenes.staging.surroundings.road import RoadLine

TIMELAPSE = 60.0
"""How much faster the sky goes in a time lapse."""
NO_ROOM_M = 9.0
"""Half the side of a room where there is none, m; nothing shows it."""
_BLACK: Colour = (0.0, 0.0, 0.0)
SNOW: Colour = (0.78, 0.82, 0.88)
_SNOWED_OVER = (
    Ground.GRASS, Ground.ROAD, Ground.DIRT_ROAD, Ground.RIVER, Ground.LAKE, Ground.CITY,
    Ground.PLAIN, Ground.SAND,
)  # fmt: skip
"""Grounds whose grass or paving is white when snow lies on it."""
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
    time_scale: float = 1.0
    """How much faster than in life clouds and waves go."""

    def at(self, time_s: float) -> Environment:
        """The surroundings at that instant."""
        factor = np.float32(self.flicker(time_s))
        return replace(
            self.base,
            time_s=self.time_scale * time_s,
            sun_colour=self.base.sun_colour * factor,
            ambient=self.base.ambient * factor,
        )

    def flicker(self, time_s: float) -> float:
        """Share of full light at that instant: 1 at t = 0, period exactly 1 / flicker_hz."""
        if self.flicker_hz is None:
            return 1.0
        level = wave_level(self.wave, self.flicker_hz * time_s)
        return 1.0 - DEPTHS[self.wave] * (1.0 - level)


def build_environment(
    description: SceneDescription,
    *,
    place: Place,
    road: RoadLine,
    distance_m: float,
    room_m: float,
    looking: Float64Array,
) -> AnimatedEnvironment:
    """The surroundings of a scene.

    Fog is scaled to the distance of the camera from what it looks at; `room_m` is half the side of
    the room, where the place is one; `looking` is the unit vector [3] that the camera looks along.
    """
    lighting, said = choose_lighting(place, description.light), description.surroundings
    colour, second = _ground_colours(place, said)
    sky_top, horizon = _sky_colours(place, lighting, said)
    fog_distance, fog_colour = _choose_fog(place, said.weather, horizon, distance_m)
    is_white = said.has_snow and place.ground in _SNOWED_OVER
    is_dim = said.weather in ("rain", "snow")
    base = Environment(
        ground=_ground_under(description, place),
        ground_colour=_array(colour),
        ground_second_colour=_array(second),
        road_angle=road.angle,
        road_half_width=place.road_m,
        road_offset=np.array(road.offset, dtype=np.float64),
        sky_top=_array(sky_top),
        sky_horizon=_array(horizon),
        clouds=_cloud_share(description, place, lighting),
        wave_height=said.wave_height,
        sun_direction=towards_light(_unit(lighting.sun_direction), looking, description.light),
        sun_colour=_array(mix(lighting.sun, _BLACK, 0.4 if is_dim else 0.0)),
        ambient=_array(lighting.ambient),
        shadows=lighting.shadows,
        fog_distance=fog_distance,
        fog_colour=_array(fog_colour),
        exposure=lighting.exposure,
        lamps=np.zeros((0, LAMP_COLUMNS)),
        time_s=0.0,
        room_half_size=room_m if place.is_room else NO_ROOM_M,
        ground_surface=Texture.SNOW if is_white else place.surface,
        has_stars=not place.is_backdrop,
        wall_surface=place.walls,
        wall_colour=place.wall_colour,
        road_curvature=road.curvature,
        road_crossings=np.array(road.crossings, dtype=np.float64).reshape(-1, 3),
    )
    return AnimatedEnvironment(
        base, description.light.flicker_hz, description.light.wave,
        TIMELAPSE if description.is_timelapse else 1.0,
    )  # fmt: skip


def _ground_under(description: SceneDescription, place: Place) -> Ground:
    """The ground; none under flat patterns before a backdrop."""
    nouns = {one.noun for one in description.objects}
    is_flat = bool(nouns) and nouns <= nouns_with("flat pattern")
    is_bare = place.is_backdrop and description.surroundings.sky is None
    return Ground.NONE if is_flat and is_bare else place.ground


def _sky_colours(place: Place, lighting: Lighting, said: Surroundings) -> tuple[Colour, Colour]:
    """Colours of the zenith and of the horizon: of a backdrop the same all around."""
    sky = rgb_of(said.sky)
    if sky is not None:
        return sky, mix(sky, lighting.sky_horizon, 0.5)
    average = mix(*_ground_colours(place, said), 0.5)
    return (average, average) if place.is_backdrop else (lighting.sky_top, lighting.sky_horizon)


def _cloud_share(description: SceneDescription, place: Place, lighting: Lighting) -> float:
    """Share of the sky that clouds cover."""
    said = description.surroundings
    usual = 0.0 if place.is_backdrop and said.sky is None else lighting.clouds
    least = [usual if said.clouds is None else said.clouds]
    least += [0.5] * description.is_timelapse
    least += [0.8] * (said.weather in ("rain", "snow"))
    return max(least)


def _ground_colours(place: Place, said: Surroundings) -> tuple[Colour, Colour]:
    """Both colours of the ground, under snow or painted as the scene says."""
    colour, second = place.colours
    if said.has_snow and place.ground in _SNOWED_OVER:
        colour = SNOW
        second = SNOW if place.ground is Ground.GRASS else second
    paint = rgb_of(said.colour)
    if paint is not None:
        # Grass is darker than paint: blades shade one another.
        depth = 0.45 if place.ground is Ground.GRASS else 0.8
        colour = mix(_BLACK, paint, depth)
        second = mix(_BLACK, paint, min(1.5 * depth, 1.0))
    return colour, second


def _choose_fog(
    place: Place, weather: str | None, horizon: Colour, distance_m: float
) -> tuple[float, Colour]:
    """Sight to 37 %, m, and the colour that all fades into."""
    if place.ground is Ground.UNDERWATER:
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
