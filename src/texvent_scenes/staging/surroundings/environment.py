"""Surroundings of each place and light as functions of time: ground, road, shore, rain, snow."""

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
    is_unlit_room,
    wave_level,
)
from texvent_scenes.staging.tracks.track import steady

_LEAST_TURN = 0.9
"""Least change of heading, radians, after which a road goes off there."""
_PAVEMENT_M, _VERGE_M = 1.4, 0.5
"""Distances from the edge of the road to pedestrians and to standing objects beside it."""
_KERB_M = 0.2
"""From the edge of the road to a vehicle that stands there."""
_ROADSIDE = 1.4
"""Distance of walkers from the middle of a road without pavement, in lanes."""
_USUAL_S = 2.0
_CROSSING_AHEAD_M = 7.0
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


_DRIVEN_M_S, _CAB_M, _LEVEL, _ALONG = 2.5, 3.5, 0.25, 0.45
"""Least speed of a camera that is driven, m/s; its greatest height, m; and slope of its view; sine
of the greatest angle of others to a road that they go along."""
_BACK = ("out", "backward")


@dataclass(frozen=True)
class RoadLine:
    """Centre lines of the roads of a scene; lengths in metres, angles in radians."""

    angle: float = 0.0
    """Direction at `offset`, from x towards y."""
    offset: tuple[float, float] = (0.0, 0.0)
    """A point (x, y) on the main road's centre line."""
    crossings: tuple[tuple[float, float, float], ...] = ()
    """Straight roads that cross the main one: a point (x, y) on the centre line, and direction."""

    def at(self, along_m: float) -> tuple[float, float, float]:
        """Point (x, y) and direction of the main road at that distance from `offset`."""
        x, y = self.offset
        x, y = x + along_m * math.cos(self.angle), y + along_m * math.sin(self.angle)
        return x, y, self.angle

    def across(self, spots: Float64Array) -> Float64Array:
        """[n] metres from the main road's line to ground points [n, 2], positive on its left."""
        x, y = (np.asarray(spots, dtype=np.float64) - self.offset).T
        return np.asarray(y * math.cos(self.angle) - x * math.sin(self.angle))

    def distance(self, spots: Float64Array) -> Float64Array:
        """[n] metres from each ground point [n, 2] to the nearest centre line."""
        lines = [self, *(RoadLine(angle, (x, y)) for x, y, angle in self.crossings)]
        return np.asarray(np.min([np.abs(line.across(spots)) for line in lines], axis=0))


def find_road(
    description: SceneDescription, place: PlaceModel, actors: Sequence[Actor], usual_y: float
) -> RoadLine:
    """The road along the path of the first object on the ground that moves, or at `usual_y`, m.

    A camera that is driven along it at a stated pose is that object; what the scene says of the
    road comes before all.
    """
    lane_m, said = 0.5 * place.road_m, description.place
    has_pavement = place.ground is Ground.CITY and all(
        one.placement != "lane" for one in description.objects
    )
    road = _road_below_camera(description, actors, lane_m)
    road = road or _road_below_flyers(description, actors)
    road = road or _straight_road(actors, usual_y, lane_m, has_pavement=has_pavement)
    if said.road_heading_deg is not None:
        road = replace(road, angle=math.radians(said.road_heading_deg), crossings=())
    if said.road_m is not None:
        road = replace(road, offset=said.road_m)
    elif said.crossing_m is not None:
        road = _moved_onto(road, said.crossing_m, place.road_m)
    if road.crossings and said.crossing_m is None:
        return road
    return with_crossing(road, said, _CROSSING_AHEAD_M)


def _moved_onto(road: RoadLine, point: tuple[float, float], half_m: float) -> RoadLine:
    """The road with its middle through a point that is on it anyway."""
    aside = float(road.across(np.array([point]))[0])
    if abs(aside) > half_m:
        return road
    x, y = road.offset
    place = (x - aside * math.sin(road.angle), y + aside * math.cos(road.angle))
    return replace(road, offset=place)


def _road_below_camera(
    description: SceneDescription, actors: Sequence[Actor], lane_m: float
) -> RoadLine | None:
    """The road in whose right lane a camera at a stated pose is driven; None: it is not driven."""
    camera = description.camera
    moves = [one for one in camera.moves if one.kind == "dolly" and one.direction not in _BACK]
    is_fast = any((one.speed_m_s or 0.0) >= _DRIVEN_M_S for one in moves)
    if camera.position_m is None or camera.look_at_m is None or not is_fast:
        return None
    ahead = np.subtract(camera.look_at_m, camera.position_m)
    if camera.position_m[2] > _CAB_M or abs(ahead[2]) > _LEVEL * math.hypot(*ahead[:2]):
        return None
    angle, (x, y, _) = math.atan2(ahead[1], ahead[0]), camera.position_m
    own = RoadLine(angle, (x - lane_m * math.sin(angle), y + lane_m * math.cos(angle)))
    drivers = [one for one in actors if one.noun.motion == "drive" and one.noun.habitat == "ground"]
    along = [one for one in drivers if abs(math.sin(one.track.at(0.0).yaw - angle)) < _ALONG
             and abs(float(own.across(one.middle(0.0)[None, :2])[0])) < 2.0 * lane_m]  # fmt: skip
    return own if along or not drivers else None


def with_crossing(road: RoadLine, said: Place, usual_m: float) -> RoadLine:
    """The road with the one that crosses it where the scene says, or so far along it, m."""
    if said.crossing_m is not None:
        east, north = np.subtract(said.crossing_m, road.offset)
        usual_m = float(east * math.cos(road.angle) + north * math.sin(road.angle))
    elif said.road != "crossing":
        return road
    x, y, angle = road.at(usual_m)
    return replace(road, crossings=((x, y, angle + 0.5 * math.pi),))


def list_flyers_above(description: SceneDescription, actors: Sequence[Actor]) -> list[Actor]:
    """Bodies in the air that are said to be above the road or the water of a place."""
    return [one for one in actors if one.noun.habitat == "air"
            and description.objects[one.object_index].placement == "lane"]  # fmt: skip


def _road_below_flyers(description: SceneDescription, actors: Sequence[Actor]) -> RoadLine | None:
    """The road along the way of what flies above it; None: something on the ground goes there."""
    flyers = list_flyers_above(description, actors)
    if not flyers or any(one.is_mover and one.noun.habitat == "ground" for one in actors):
        return None
    x, y, _ = flyers[0].middle(0.0)
    return RoadLine(flyers[0].track.at(0.0).yaw, (float(x), float(y)))


def _straight_road(
    actors: Sequence[Actor], usual_y: float, lane_m: float, *, has_pavement: bool
) -> RoadLine:
    grounded = [one for one in actors if one.noun.habitat == "ground"]
    # Ducks cross a road too.
    movers = [one for one in actors if one.is_mover and (one in grounded or one.goes_across)]
    drivers = [one for one in movers if one.noun.motion == "drive"]
    parked = [one for one in grounded if one.noun.motion == "drive" and one not in movers]
    if parked and not (drivers or has_pavement or any(one.goes_across for one in movers)):
        return _road_beside(parked, grounded, 2.0 * lane_m)
    if drivers or (movers and not movers[0].goes_across):
        return _road_of(drivers or movers, lane_m, has_pavement=has_pavement)
    if movers:
        crossing = [one for one in movers if one.goes_across]
        middle = crossing[len(crossing) // 2]
        x, y, _ = middle.middle(0.5 * _USUAL_S)
        return RoadLine(movers[0].track.at(0.0).yaw + 0.5 * math.pi, (float(x), float(y)))
    nouns = {one.noun.name for one in actors}
    if parked:
        return _road_beside(parked, grounded, 2.0 * lane_m)
    may_be_beside = has_pavement or nouns & nouns_with("beside a road")
    if nouns and may_be_beside and not nouns & nouns_with("on a road"):
        farthest = max(float(one.corners(0.0)[:, 1].max()) for one in actors)
        return RoadLine(offset=(0.0, farthest + 2.0 * lane_m + _VERGE_M))
    y = grounded[0].track.at(0.0).position[1] if grounded else usual_y
    return RoadLine(offset=(0.0, float(y)))


def _road_beside(parked: Sequence[Actor], actors: Sequence[Actor], half_m: float) -> RoadLine:
    """The road at whose edge vehicles stand, on the side where least of the others are on it."""
    y = float(parked[0].middle(0.0)[1])
    gap = max(half_m - 0.5 * max(one.model.width for one in parked) - _KERB_M, 0.0)
    others = [one.middle(0.0)[1] for one in actors if one.noun.motion != "drive"]
    ways = {sign: sum(abs(each - y - sign * gap) < half_m for each in others) for sign in (-1, 1)}
    return RoadLine(offset=(0.0, y + min(ways, key=lambda sign: ways[sign]) * gap))


def _road_of(movers: Sequence[Actor], lane_m: float, *, has_pavement: bool) -> RoadLine:
    """The road whose right lane, or whose edge, the first mover keeps to, also where it turns."""
    first = movers[0]
    headings = [one.track.at(0.0).yaw - first.track.at(0.0).yaw for one in movers]
    has_oncoming = any(math.cos(turn) < -0.9 for turn in headings)
    is_alone = (len(movers) == 1 or has_oncoming) and lane_m > 0.6 * first.model.width
    lane = lane_m if is_alone else 0.0
    if first.noun.motion != "drive":
        lane = 2.0 * lane_m + _PAVEMENT_M if has_pavement else _ROADSIDE * lane_m

    def centre_line(time_s: float) -> tuple[float, float, float]:
        state = first.track.at(time_s)
        x, y, _ = state.position
        # Traffic keeps to the right: the centre line is on its left.
        return x - lane * math.sin(state.yaw), y + lane * math.cos(state.yaw), state.yaw

    x, y, yaw = centre_line(0.0)
    crossings: list[tuple[float, float, float]] = []
    if not first.track.terms:
        ends = (0.5 * first.track.duration_s, first.track.duration_s)
        crossings = [
            line
            for line in map(centre_line, ends)
            if abs(math.remainder(line[2] - yaw, math.pi)) > _LEAST_TURN
        ]
    return RoadLine(yaw % math.pi if lane == 0.0 else yaw, (x, y), crossings=tuple(crossings[:1]))


def lay_across(actors: Sequence[Actor], road: RoadLine) -> list[Actor]:
    """The actors, with what is painted across a road turned to it."""

    def laid(one: Actor) -> Actor:
        x, y, z = one.track.at(0.0).position
        aside = float(road.across(np.array([[x, y]]))[0])
        place = (x + aside * math.sin(road.angle), y - aside * math.cos(road.angle), z)
        return replace(one, track=steady(place, road.angle + 0.5 * math.pi))

    painted = nouns_with("across a road")
    return [laid(one) if one.noun.name in painted else one for one in actors]


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

    It runs through objects that float or swim, or are `above` the water, and behind those on land.
    """
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
        corners = np.vstack([one.corners(time) for one in actors for time in (0.0, _USUAL_S)])
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
_WATER_COLOUR: Colour = (0.05, 0.28, 0.42)
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
_FOG_SIGHT, _HAZE_SIGHT = 3.0, 9.0
"""In fog and in haze, sight (to 37 %) in camera distances."""


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
    fog_distance, fog_colour = _choose_fog(place, said.weather, horizon, distance_m)
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
        road_crossings=np.array(road.crossings, dtype=np.float64).reshape(-1, 3),
    )
    return AnimatedEnvironment(base, description.light.flicker_hz, description.light.wave)


def _ground_under(description: SceneDescription, place: PlaceModel) -> Ground:
    """The ground; none under flat patterns before a backdrop."""
    nouns = {one.noun for one in description.objects}
    is_flat = bool(nouns) and nouns <= nouns_with("flat pattern")
    is_bare = place.is_backdrop and description.place.sky is None
    return Ground.NONE if is_flat and is_bare else place.ground


def _sky_colours(place: PlaceModel, lighting: Lighting, said: Place) -> tuple[Colour, Colour]:
    """Colours of the zenith and of the horizon: of a backdrop the same all around."""
    sky = rgb_of(said.sky)
    if sky is not None:
        return sky, mix(sky, lighting.sky_horizon, 0.5)
    average = mix(*_ground_colours(place, said), 0.5)
    return (average, average) if place.is_backdrop else (lighting.sky_top, lighting.sky_horizon)


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
        colour = mix(_BLACK, paint, depth)
        second = mix(_BLACK, paint, min(1.5 * depth, 1.0))
    return colour, second


def _choose_fog(
    place: PlaceModel, weather: str | None, horizon: Colour, distance_m: float
) -> tuple[float, Colour]:
    """Sight to 37 %, m, and the colour that all fades into."""
    if place.ground is Ground.UNDERWATER:
        return max(_UNDERWATER_SIGHT_M, 3.5 * distance_m), _WATER_COLOUR
    if weather == "fog":
        grey = sum(horizon) / 3.0
        return _FOG_SIGHT * distance_m, mix(horizon, (grey, grey, grey), 0.7)
    if weather == "haze":
        return _HAZE_SIGHT * distance_m, horizon
    if weather in ("rain", "snow"):
        return 14.0 * distance_m, horizon
    return math.inf, horizon


def _array(colour: Colour) -> Float32Array:
    return np.array(colour, dtype=np.float32)


def _unit(direction: tuple[float, float, float]) -> Float64Array:
    unit: Float64Array = np.array(direction) / np.linalg.norm(direction)
    return unit
