"""Roads: where one lies, its lanes, pavements and crossings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.camera import PosedCamera, project
from texvent.sensor import SensorSize
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.places import PlaceModel
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import (
    Float64Array,
    Ground,
)
from texvent_scenes.spec.scene import Place
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.tracks.track import steady

_LEAST_TURN = 0.9
"""Least change of heading, radians, after which a road goes off there."""
_PAVEMENT_M, _VERGE_M = 1.4, 0.5
"""Distances from the edge of the road to pedestrians and to standing objects beside it."""
_KERB_M = 0.2
"""From the edge of the road to a vehicle that stands there."""
_ROADSIDE = 1.4
"""Distance of walkers from the middle of a road without pavement, in lanes."""
USUAL_S = 2.0
"""End of a usual clip, s, at which moving bodies are looked at again."""
_CROSSING_AHEAD_M = 7.0
"""Distance of a crossing from the camera, m."""
_CROSSED_M, _FARTHEST_M = 5.0, 40.0
"""Reach of a crossing, m, and the farthest along the road at which it is put into the image."""
_ENDS = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0))
"""Sides of a crossing, of which most are to be seen."""
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


def show_crossing(
    road: RoadLine, said: Place, cameras: Sequence[PosedCamera], size: SensorSize,
    bodies: Float64Array, half_m: float,
) -> RoadLine:  # fmt: skip
    """The road with a crossing whose place is open where most of it is seen.

    Args:
        road: the road.
        said: what is said of the place.
        cameras: at some instants.
        size: of the image, pixels.
        bodies: [n, 2] what stands where no road should cross, m.
        half_m: half the width of the road, m.
    """
    usual = with_crossing(replace(road, crossings=()), said, _CROSSING_AHEAD_M)
    if said.road != "crossing" or said.crossing_m is not None or road.crossings != usual.crossings:
        return road

    def rank(along_m: float) -> tuple[int, int, float]:
        x, y, _ = road.at(along_m)
        points = np.array([x, y, 0.0]) + _CROSSED_M * np.array(_ENDS)
        seen = [project(one, size, points) for one in cameras]
        edge = [size.width, size.height]
        inside = [((one[:, :2] >= 0.0) & (one[:, :2] < edge)).all(axis=1) for one in seen]
        most = max(int((a & (b[:, 2] > 0.0)).sum()) for a, b in zip(inside, seen, strict=True))
        other = RoadLine(road.angle + 0.5 * math.pi, (x, y))
        blocked = int((np.abs(other.across(bodies)) < half_m).sum()) if len(bodies) else 0
        return -min(most, len(_ENDS) - 1), blocked, abs(along_m - _CROSSING_AHEAD_M)

    best = min(np.arange(-_FARTHEST_M, _FARTHEST_M + 1.0), key=rank)
    return with_crossing(replace(road, crossings=()), said, float(best))


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
        x, y, _ = middle.middle(0.5 * USUAL_S)
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
