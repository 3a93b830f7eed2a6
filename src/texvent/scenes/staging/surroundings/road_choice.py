"""Where the road runs: along the way of what drives on it, with a crossing where that turns."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.places import Place
from texvent.scenes.models.traits import nouns_with
from texvent.scenes.scene import Ground
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.placement.lanes import FEWEST, find_lanes
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.trajectories.phases import ROAD_BEND_PER_M
from texvent.scenes.staging.trajectories.steered_path import SteeredPath
from texvent.scenes.staging.trajectories.trajectory import Stationary

_LEAST_TURN = 0.9
"""Least change of heading, radians, after which a road goes off there."""
_PAVEMENT_M = 1.4
"""From the edge of the road to who walks beside it."""
_VERGE_M = 0.5
"""From the edge of the road to what stands beside it."""
_ROADSIDE = 1.4
"""Where one walks on a road without pavement, in lanes from its middle."""
_USUAL_S = 2.0
_CROSSING_AHEAD_M = 7.0
_STRIPES_AHEAD_M = 0.6
"""Between a vehicle and what lies across the road before it."""


def find_road(
    description: SceneDescription, place: Place, actors: Sequence[Actor], usual_y: float
) -> RoadLine:
    """The road along the path of the first object on the ground that moves.

    Args:
        description: the shape of its road: curved, or with a crossing.
        place: its road's width, and whether it has pavements.
        actors: the objects of the scene.
        usual_y: where it runs if nothing stands on the ground, m.
    """
    shape, lane_m = description.surroundings.road, 0.5 * place.road_m
    has_pavement = place.ground is Ground.CITY and all(
        one.side != "lane" for one in description.objects
    )
    road = _straight_road(actors, usual_y, lane_m, has_pavement=has_pavement)
    if shape == "curved" and not road.crossings:
        return replace(road, curvature=_bend_of(actors, lane_m))
    if shape == "crossing" and not road.crossings:
        x, y, angle = road.at(_CROSSING_AHEAD_M)
        return replace(road, crossings=((x, y, angle + 0.5 * math.pi),))
    return road


def _straight_road(
    actors: Sequence[Actor], usual_y: float, lane_m: float, *, has_pavement: bool
) -> RoadLine:
    grounded = [actor for actor in actors if actor.noun.habitat == "ground"]
    # Ducks cross a road too.
    movers = [one for one in actors if one.is_mover and (one in grounded or one.goes_across)]
    movers = [one for one in movers if one.noun.habitat != "air"]
    drivers = [actor for actor in movers if actor.noun.motion == "drive"]
    lanes = find_lanes(actors)
    if all(lanes) and sum(map(len, lanes)) >= FEWEST:
        sides = [lane[0].trajectory.at(0.0).position[1] for lane in lanes]
        return RoadLine(offset=(0.0, 0.5 * float(sides[0] + sides[1])))
    if drivers:
        return _road_of(drivers, lane_m)
    if movers and movers[0].goes_across:
        crossing = [one for one in movers if one.goes_across]
        # Of ducks in a row the middle one is on the road at mid clip.
        middle = crossing[0 if movers[0] in grounded else len(crossing) // 2]
        x, y, _ = middle.middle(0.5 * _USUAL_S)
        return RoadLine(movers[0].trajectory.at(0.0).yaw + 0.5 * math.pi, (float(x), float(y)))
    if movers:
        return _road_of(movers, lane_m, has_pavement=has_pavement)
    if _are_beside(actors, has_pavement=has_pavement):
        farthest = max(float(one.corners(0.0)[:, 1].max()) for one in actors)
        return RoadLine(offset=(0.0, farthest + 2.0 * lane_m + _VERGE_M))
    if grounded:
        return RoadLine(offset=(0.0, grounded[0].trajectory.at(0.0).position[1]))
    return RoadLine(offset=(0.0, usual_y))


def _are_beside(actors: Sequence[Actor], *, has_pavement: bool) -> bool:
    """Whether all stand beside the road: none is a vehicle or lies on it."""
    nouns = {actor.noun.name for actor in actors}
    if not actors or nouns & nouns_with("on a road"):
        return False
    if has_pavement and all(actor.noun.motion != "drive" for actor in actors):
        return True
    others = [one for one in actors if one.noun.habitat != "fixed"]
    is_quiet = all(one.noun.name in PERSON_NOUNS and not one.is_mover for one in others)
    return is_quiet and bool(nouns & nouns_with("beside a road"))


def _road_of(movers: Sequence[Actor], lane_m: float, *, has_pavement: bool = False) -> RoadLine:
    first = movers[0]
    state = first.trajectory.at(0.0)
    x, y, _ = state.position
    lane = _lane_of(movers, lane_m)
    if first.noun.motion != "drive":
        lane = 2.0 * lane_m + _PAVEMENT_M if has_pavement else _ROADSIDE * lane_m
    # Traffic keeps to the right: the centre line is on its left.
    offset = (x - lane * math.sin(state.yaw), y + lane * math.cos(state.yaw))
    crossings: list[tuple[float, float, float]] = []
    if isinstance(first.trajectory, SteeredPath):
        for time in (0.5 * first.trajectory.duration_s, first.trajectory.duration_s):
            later = first.trajectory.at(time)
            turned = math.remainder(later.yaw - state.yaw, math.pi)
            if abs(turned) > _LEAST_TURN and not crossings:
                cx, cy, _ = later.position
                crossings.append(
                    (cx - lane * math.sin(later.yaw), cy + lane * math.cos(later.yaw), later.yaw)
                )
    angle = state.yaw % math.pi if lane == 0.0 else state.yaw
    return RoadLine(angle, offset, crossings=tuple(crossings))


def _bend_of(actors: Sequence[Actor], lane_m: float) -> float:
    """Curvature of the road on which the first mover drives, 1/m."""
    movers = [a for a in actors if a.is_mover and a.noun.habitat == "ground"]
    path = movers[0].trajectory if movers else None
    if not isinstance(path, SteeredPath) or not path.initial_turn_rad_s:
        return ROAD_BEND_PER_M
    lane = _lane_of(movers, lane_m)
    return 1.0 / (path.initial_speed_m_s / path.initial_turn_rad_s - lane)


def _lane_of(movers: Sequence[Actor], lane_m: float) -> float:
    """How far the first mover is to the right of the centre line, m."""
    is_alone = len(movers) == 1 and movers[0].noun.motion == "drive"
    return lane_m if is_alone and lane_m > 0.6 * movers[0].model.width else 0.0


def lay_across(actors: Sequence[Actor], road: RoadLine, duration_s: float) -> list[Actor]:
    """The actors, with stripes across the road before a vehicle, or under who crosses there.

    Args:
        actors: all objects.
        road: from `find_road`.
        duration_s: of the clip, s.
    """
    nouns = nouns_with("across a road")
    others = [one for one in actors if one.noun.name not in nouns and one.noun.habitat != "air"]
    if not others or len(others) == len(actors):
        return list(actors)
    goal = min(others, key=lambda one: one.noun.motion != "drive")
    state = goal.trajectory.at(duration_s)
    x, y, _ = state.position
    moved = []
    for one in actors:
        if one.noun.name in nouns:
            ahead = 0.5 * (goal.model.length + one.model.width) + _STRIPES_AHEAD_M
            ahead = ahead if goal.noun.motion == "drive" else 0.0
            dx = x + ahead * math.cos(state.yaw) - road.offset[0]
            dy = y + ahead * math.sin(state.yaw) - road.offset[1]
            at_x, at_y, angle = road.at(dx * math.cos(road.angle) + dy * math.sin(road.angle))
            path = Stationary((at_x, at_y, 0.0), angle + 0.5 * math.pi)
            one = replace(one, trajectory=path)
        moved.append(one)
    return moved
