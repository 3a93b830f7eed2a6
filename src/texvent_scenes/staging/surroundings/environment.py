"""Surroundings of each place and light as functions of time: ground, shore, sky, fog."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent_scenes.colours import rgb_of
from texvent_scenes.defaults import NO_PLACE
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.materials import mix
from texvent_scenes.models.nouns import AFLOAT
from texvent_scenes.models.places import PlaceModel
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import (
    LAMP_RECORD,
    Colour,
    Environment,
    Float32Array,
    Float64Array,
    Ground,
    Texture,
)
from texvent_scenes.spec.scene import Place
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.camera.camera_track import CameraTrack
from texvent_scenes.staging.surroundings.lighting import (
    DEPTHS,
    Lighting,
    choose_lighting,
    daylight_share,
    is_unlit_room,
    wave_level,
)
from texvent_scenes.staging.surroundings.road_line import USUAL_S, RoadLine

_AFLOAT, _UNDER_M = ("swim", "surf", "float"), 0.02
"""Motions of people and things in water, or on it."""
_CALM_M = 3.0
"""Distance of the camera below which usual waves are lower, as it is shorter."""
_BANK, _LEAST_BANK_M, _STRAND_M = 0.22, 1.0, 6.0
"""Land between what the camera looks at and the water: a share of the camera's distance, and m, on
a beach too."""
_NEARER, _LEAST_NEARER_M = 0.45, 2.5
"""Distance of a lake's shore before things afloat, as a share of the camera's distance, and m: it
is no straight line."""


def is_afloat(actor: Actor) -> bool:
    """Whether it is in water or on it, by itself; a boat that lies is ashore."""
    doing = actor.track.at(0.0).activity
    is_of_water = actor.noun.habitat == "water" and actor.track.anchor is None
    is_in = (is_of_water and not lies_ashore(actor.noun, doing)) or doing in _AFLOAT
    return is_in or actor.track.at(actor.track.duration_s).position[2] < -_UNDER_M


def lies_ashore(noun: Noun, doing: str) -> bool:
    """Whether what floats lies on land."""
    return doing == "lie" and noun.name in AFLOAT


def water_line(
    place: PlaceModel, actors: Sequence[Actor], path: CameraTrack, above: Sequence[Actor] = ()
) -> RoadLine:
    """The middle of a river, or the shore of a lake with the water on its left.

    It runs through objects that float or swim, or are `above` the water, and behind those on land;
    a river under a bridge, where nobody stands in its way.
    """
    bridged = _run_under_bridge(place, actors)
    if bridged is not None:
        return bridged
    forward = path.at(0.0).rotation[2, :2]
    angle = math.atan2(float(forward[1]), float(forward[0])) - 0.5 * math.pi
    x, y = float(path.framing.target[0]), float(path.framing.target[1])
    half = place.road_m if place.ground is Ground.RIVER else 0.0
    is_free = not any(one.noun.habitat in ("ground", "fixed") for one in actors)
    flying = {one.instance for one in above} if is_free else set()  # no tree stands in water
    swimmers = [one for one in actors if is_afloat(one) or one.instance in flying]
    on_land = [one for one in actors if one.track.anchor is None and one not in swimmers
               and (one.noun.habitat == "ground" or one.noun.name in AFLOAT)]  # fmt: skip
    bank_m = _STRAND_M if place.surface is Texture.SAND else _LEAST_BANK_M
    gap = half + _BANK * path.framing.distance_m + bank_m
    if not actors:
        gap = half
    elif swimmers and place.ground is Ground.RIVER:
        gap, state = 0.0, swimmers[0].track.at(0.0)
        angle = state.yaw if swimmers[0].is_mover else angle
        x, y = float(state.position[0]), float(state.position[1])
    elif not swimmers:
        away = np.array([-math.sin(angle), math.cos(angle)])
        corners = np.vstack([one.corners(time) for one in actors for time in (0.0, USUAL_S)])
        gap = max(gap, float(((corners[:, :2] - (x, y)) @ away).max()) + half + bank_m)
    else:
        gap = -max(_NEARER * path.framing.distance_m, _LEAST_NEARER_M)
        away = np.array([-math.sin(angle), math.cos(angle)])
        ways = [
            [(one.middle(0.0)[:2] - (x, y)) @ away for one in each] for each in (on_land, swimmers)
        ]
        if on_land and max(ways[0]) < min(ways[1]):  # between both
            gap = 0.5 * float(max(ways[0]) + min(ways[1]))
    return RoadLine(angle, (x - gap * math.sin(angle), y + gap * math.cos(angle)))


def _run_under_bridge(place: PlaceModel, actors: Sequence[Actor]) -> RoadLine | None:
    """The middle of a river that runs under the only bridge; None: there is none, or no room."""
    bridges = [one for one in actors if one.noun.name in nouns_with("has approaches")]
    if len(bridges) != 1 or place.ground is not Ground.RIVER or any(map(is_afloat, actors)):
        return None
    (bridge,) = bridges
    x, y, _ = map(float, bridge.middle(0.0))
    line = RoadLine(bridge.track.at(0.0).yaw + 0.5 * math.pi, (x, y))
    corners = [one.corners(time) for one in actors if one is not bridge for time in (0.0, USUAL_S)]
    low = np.vstack([each for each in corners if each[:, 2].min() < _LOW_M] or [np.zeros((0, 3))])
    is_met = np.abs(line.across(low[:, :2])) < place.road_m + _LEAST_BANK_M
    return None if is_met.any() else line


_LOW_M = 0.3
"""Height of a foot below which a body is on the ground, not on a bridge."""
NO_ROOM_M = 9.0
"""Half the side of a room where there is none, m; nothing shows it."""
_BLACK: Colour = (0.0, 0.0, 0.0)
SNOW: Colour = (0.78, 0.82, 0.88)
_SNOWED_OVER = (
    Ground.GRASS, Ground.ROAD, Ground.DIRT_ROAD, Ground.RIVER, Ground.LAKE, Ground.CITY,
    Ground.PLAIN, Ground.SAND,
)  # fmt: skip
"""Grounds whose grass or paving is white when snow lies on it."""
_SNOW_SHARES = {Ground.GRASS: 1.0, Ground.CITY: 0.5}
"""Share of white in the second colour of grounds under snow: of blades, of a street."""
_DARKER, _LEAST_CONTRAST = 0.1, 1.0
"""Dark backdrop as a multiple of the usual one; difference in log brightness from the objects that
keeps the usual one: edges cross a threshold of 0.25 four times."""
_STORM_CLOUDS, _STARLESS = 0.95, 0.5
"""Cloud cover of a thunderstorm; that from which on no stars are seen."""
_LUMA = np.array([0.2126, 0.7152, 0.0722])
"""Luma weights of linear RGB, Rec. 709."""
_UNDERWATER_SIGHT_M = 16.0
_WET = 0.85
"""Share of rain water on roads while it rains, and after it."""
_FOG_SIGHT, _HAZE_SIGHT, _THICK_SIGHT = 3.0, 9.0, 12.0
"""In fog, in haze and in heavy snow, sight (to 37 %) in camera distances."""


@dataclass(frozen=True)
class AnimatedEnvironment:
    """The surroundings as a function of time: all fixed, but for flicker, waves and clouds."""

    base: Environment
    flicker_hz: float | None
    wave: str = "sine"
    """As `Light.wave`."""

    def at(self, time_s: float) -> Environment:
        """The surroundings at that instant."""
        factor = np.float32(self.flicker(time_s))
        return replace(
            self.base,
            time_s=time_s,
            sun_colour=self.base.sun_colour * factor,
            ambient=self.base.ambient * factor,
        )

    def flicker(self, time_s: float) -> float:
        """Share of full light at that instant: 1 at t = 0, period exactly 1 / flicker_hz."""
        if self.flicker_hz is None:
            return 1.0
        level = wave_level(self.wave, self.flicker_hz * time_s)
        return 1.0 - DEPTHS[self.wave] * (1.0 - level)


def contrasting(
    place: PlaceModel, description: SceneDescription, actors: Sequence[Actor]
) -> PlaceModel:
    """The place, dark where it is an open backdrop too near in brightness to an object."""
    is_open = any(one.startswith(NO_PLACE) for one in description.notes)
    if not (is_open and place.is_backdrop and actors) or description.place.colour:
        return place
    first, second = place.colours
    dark = (mix(_BLACK, first, _DARKER), mix(_BLACK, second, _DARKER))
    lumas = [np.array([part.colour for part in one.place(0.0).parts]) @ _LUMA for one in actors]

    def contrast(colours: tuple[Colour, Colour]) -> float:
        ground = float(np.array(mix(*colours, 0.5)) @ _LUMA)
        return min(float(np.abs(np.log((one + 0.01) / ground)).mean()) for one in lumas)

    usual = contrast(place.colours)
    is_lost = usual < min(_LEAST_CONTRAST, contrast(dark))
    return replace(place, colours=dark) if is_lost else place


def build_environment(
    description: SceneDescription,
    *,
    place: PlaceModel,
    road: RoadLine,
    distance_m: float,
    room_m: float,
    corridor_m: float | None = None,
) -> AnimatedEnvironment:
    """The surroundings of a scene.

    Fog is scaled to the distance of the camera from what it looks at; `room_m` is half the side of
    the room, where the place is one; half the length of a corridor, of which `corridor_m` is half
    the width.
    """
    is_unlit, said = is_unlit_room(place, description), description.place
    lighting = choose_lighting(place, description.light, is_unlit=is_unlit)
    colour, second = _ground_colours(place, said)
    sky_top, horizon = _sky_colours(place, lighting, said)
    fog_distance, fog_colour = _choose_fog(place, lighting, said, horizon, distance_m)
    is_white = said.has_snow and place.ground in _SNOWED_OVER
    is_dim, is_usual = said.weather in ("rain", "snow"), said.wave_height == Place.wave_height
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
        wetness=_WET if said.weather == "rain" or said.is_wet else 0.0,
        wave_height=said.wave_height * (min(distance_m / _CALM_M, 1.0) if is_usual else 1.0),
        sun_direction=_unit(lighting.sun_direction),
        sun_colour=_array(mix(lighting.sun, _BLACK, 0.4 if is_dim else 0.0)),
        ambient=_array(lighting.ambient),
        shadows=lighting.shadows,
        fog_distance=fog_distance,
        fog_colour=_array(fog_colour),
        exposure=lighting.exposure,
        lamps=np.zeros(0, LAMP_RECORD),
        time_s=0.0,
        room_half_size=room_m if place.is_room else NO_ROOM_M,
        corridor_half_width=corridor_m,
        ground_surface=Texture.SNOW if is_white else place.surface,
        has_stars=not (place.is_backdrop or said.weather or _is_storm(description))
        and (said.clouds or 0.0) < _STARLESS,
        wall_surface=place.walls,
        wall_colour=place.wall_colour,
        has_ceiling_panels=place.has_ceiling_panels,
        is_hall=place.hall_m > 0.0,
        road_crossings=np.array(road.crossings, dtype=np.float64).reshape(-1, 3),
    )
    return AnimatedEnvironment(base, description.light.flicker_hz, description.light.wave)


def _ground_under(description: SceneDescription, place: PlaceModel) -> Ground:
    """The ground; none under flat patterns before a backdrop."""
    nouns = {one.noun for one in description.objects}
    is_flat = bool(nouns) and nouns <= nouns_with("flat pattern")
    is_bare = place.is_backdrop and description.place.sky is None
    return Ground.NONE if is_flat and is_bare else place.ground


_BLACK_SKY = 0.03
"""Greatest channel of a sky that is black down to its horizon."""


def _sky_colours(place: PlaceModel, lighting: Lighting, said: Place) -> tuple[Colour, Colour]:
    """Colours of the zenith and of the horizon: of a backdrop those of ground in that light."""
    sky = rgb_of(said.sky)
    if sky is not None:
        haze = 0.5 if max(sky) > _BLACK_SKY else 0.05  # a black sky has no air
        return sky, mix(sky, lighting.sky_horizon, haze)
    if _is_thick(said):  # of the sky only the nearest flakes are seen
        grey = sum(lighting.sky_horizon) / 3.0
        return (grey, grey, grey), (grey, grey, grey)
    if not place.is_backdrop:
        return lighting.sky_top, lighting.sky_horizon
    average = mix(*_ground_colours(place, said), 0.5)
    red, green, blue = (
        min(own * share, 1.0) for own, share in zip(average, daylight_share(lighting), strict=True)
    )
    return (red, green, blue), (red, green, blue)


def _cloud_share(description: SceneDescription, place: PlaceModel, lighting: Lighting) -> float:
    """Share of the sky that clouds cover."""
    said = description.place
    usual = 0.0 if place.is_backdrop and said.sky is None else lighting.clouds
    least = [usual if said.clouds is None else said.clouds]
    least += [0.8] * (said.weather in ("rain", "snow"))
    least += [_STORM_CLOUDS] * _is_storm(description)
    return max(least)


def _is_storm(description: SceneDescription) -> bool:
    """Whether something of the scene comes out of clouds, as lightning does."""
    return any(one.noun in nouns_with("out of clouds") for one in description.objects)


def _ground_colours(place: PlaceModel, said: Place) -> tuple[Colour, Colour]:
    """Both colours of the ground, under snow or painted as the scene says."""
    colour, second = place.colours
    if said.has_snow and place.ground in _SNOWED_OVER:
        colour = SNOW
        share = _SNOW_SHARES.get(place.ground, 0.0)
        second = mix(second, SNOW, share)
    paint = rgb_of(said.colour)
    if paint is not None:
        # Grass is darker than paint: blades shade one another.
        depth = 0.45 if place.ground is Ground.GRASS else 0.8
        lighter = 1.0 if place.is_backdrop else 1.5  # which is even
        colour = mix(_BLACK, paint, depth)
        second = mix(_BLACK, paint, min(lighter * depth, 1.0))
    return colour, second


def _choose_fog(
    place: PlaceModel, lighting: Lighting, said: Place, horizon: Colour, distance_m: float
) -> tuple[float, Colour]:
    """Sight to 37 %, m, and the colour that all fades into."""
    if place.ground is Ground.UNDERWATER:
        return max(_UNDERWATER_SIGHT_M, 3.5 * distance_m), lighting.water
    weather, amount = said.weather, said.weather_amount
    if weather == "fog":
        grey = sum(horizon) / 3.0
        return _FOG_SIGHT * distance_m / amount, mix(horizon, (grey, grey, grey), 0.7)
    if weather == "haze":
        return _HAZE_SIGHT * distance_m / amount, horizon
    if _is_thick(said):
        return _THICK_SIGHT * distance_m / amount, horizon
    if weather in ("rain", "snow"):
        return 14.0 * distance_m / math.sqrt(amount), horizon  # drops and flakes hide the rest
    return math.inf, horizon


def _is_thick(said: Place) -> bool:
    """Whether snow falls so thickly that it hides the sky and what is far."""
    return said.weather == "snow" and said.weather_amount > Place.weather_amount


def _array(colour: Colour) -> Float32Array:
    return np.array(colour, dtype=np.float32)


def _unit(direction: tuple[float, float, float]) -> Float64Array:
    unit: Float64Array = np.array(direction) / np.linalg.norm(direction)
    return unit
