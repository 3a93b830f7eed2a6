"""Where the road runs: along the way of what drives on it, with a crossing where that turns."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import SceneDescription
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import is_person
from texvent.scenes.staging.placement.lanes import FEWEST, find_lanes
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.trajectories.phases import ROAD_BEND_PER_M
from texvent.scenes.staging.trajectories.steered_path import SteeredPath

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


def find_road(
    actors: Sequence[Actor],
    usual_y: float,
    lane_m: float,
    shape: str | None = None,
    *,
    beside: str = "",
) -> RoadLine:
    """The road along the path of the first object on the ground that moves.

    Args:
        actors: the objects of the prompt.
        usual_y: where it runs if nothing stands on the ground, m.
        lane_m: from its centre line to the middle of a lane.
        shape: "curved", "crossing" (another road crosses it) or None.
        beside: who is beside it, not on it: "walkers", "all" or "" (nobody).
    """
    road = _straight_road(actors, usual_y, lane_m, beside)
    if shape == "curved" and not road.crossings:
        return replace(road, curvature=_bend_of(actors, lane_m))
    if shape == "crossing" and not road.crossings:
        x, y, angle = road.at(_CROSSING_AHEAD_M)
        return replace(road, crossings=((x, y, angle + 0.5 * math.pi),))
    return road


def find_beside(description: SceneDescription, place: str, actors: Sequence[Actor] = ()) -> str:
    """Who is beside the road: on the pavement of a city, or as the prompt says."""
    if place != "city":
        return ""
    if any(one.side == "lane" for one in description.objects):
        return ""
    has_traffic = any(one.noun.motion == "drive" or one.noun.name == "crosswalk" for one in actors)
    return "walkers" if has_traffic else "all"


def _straight_road(actors: Sequence[Actor], usual_y: float, lane_m: float, beside: str) -> RoadLine:
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
        return _road_of(movers, lane_m, has_pavement=bool(beside))
    if actors and (beside == "all" or _belong_at_kerb(actors)):
        farthest = max(float(one.corners(0.0)[:, 1].max()) for one in actors)
        return RoadLine(offset=(0.0, farthest + 2.0 * lane_m + _VERGE_M))
    if grounded:
        return RoadLine(offset=(0.0, grounded[0].trajectory.at(0.0).position[1]))
    return RoadLine(offset=(0.0, usual_y))


_AT_KERB = frozenset({
    "street lamp", "traffic light", "park lamp", "fire hydrant", "parking meter", "stop sign",
    "sign", "mailbox", "dustbin", "dumpster", "bus stop", "phone booth", "bollard", "bench", "tree",
    "autumn tree", "cherry tree", "bare tree", "pine", "palm", "bush", "vending machine", "statue",
    "fountain", "fence", "power pylon",
})  # fmt: skip
"""What stands beside a road, not on it."""
_ON_ROAD = frozenset({"crosswalk", "barrier", "traffic cone", "manhole cover", "puddle"})


def _belong_at_kerb(actors: Sequence[Actor]) -> bool:
    """Whether something stands here that no road leads through, and nothing that is on a road."""
    nouns = {actor.noun.name for actor in actors}
    others = [one for one in actors if one.noun.habitat != "fixed"]
    is_quiet = all(is_person(one) and not one.is_mover for one in others)
    return bool(nouns & _AT_KERB) and not nouns & _ON_ROAD and is_quiet


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
