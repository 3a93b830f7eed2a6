"""Ego-motion: the straight route of a camera that travels along a road or through a place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from texvent_scenes.description import SceneDescription
from texvent_scenes.models.places import PLACES
from texvent_scenes.rendered_scene import Ground
from texvent_scenes.staging.camera.camera_track import Journey, TimedMove, time_moves
from texvent_scenes.staging.surroundings.road_line import RoadLine, with_crossing
from texvent_scenes.staging.tracks.keys import Key
from texvent_scenes.staging.tracks.track import Track

NORTH = 0.5 * math.pi
"""Heading of a route."""
VIEW_M = 70.0
"""Distance ahead up to which scenery stands along a route."""
_LEAST_CLEAR_M = 1.1
_ON_FOOT_M_S = 4.0
"""Speed below which a camera keeps to the pavement of a city."""


class Means(NamedTuple):
    """Means of travel of a camera."""

    speed_m_s: float
    height_m: float
    pitch_rad: float
    is_on_road: bool = False
    """Whether it keeps to its lane."""


_MEANS: dict[str, Means] = {
    "drive": Means(9.0, 1.35, 0.03, is_on_road=True),
    "cycle": Means(5.0, 1.6, 0.06, is_on_road=True),
    "walk": Means(1.5, 1.65, 0.04),
    "run": Means(3.4, 1.6, 0.04),
    "fly": Means(8.0, 9.0, 0.22),
    "sail": Means(4.0, 2.2, 0.06),
    "swim": Means(1.0, 1.4, 0.0),
}
"""`CameraMove.means` → speed, height above the ground, pitch."""
_BY_GROUND = {
    Ground.ROAD: "drive", Ground.DIRT_ROAD: "drive", Ground.CITY: "drive", Ground.SEA: "sail",
    Ground.LAKE: "sail", Ground.RIVER: "sail", Ground.UNDERWATER: "swim", Ground.NONE: "fly",
}  # fmt: skip
"""Usual means of travel on a ground; elsewhere one walks."""
_LOW_M, _AERIAL_M, _AERIAL_PITCH, _TOP_PITCH = 0.5, 16.0, 0.5, 1.4
"""Heights and pitches of low, aerial and top views."""
_INDOORS_M, _SLOPE = 2.6, 0.27
"""Greatest height in a room, and pitch of a view from the air there."""


@dataclass(frozen=True)
class TravelPlan:
    """A straight route northwards, its middle at (0, 0), with the scenery along it."""

    journey: Journey
    length_m: float
    """From its rearmost to its foremost point."""
    clear_m: tuple[float, float]
    """Widths to the left and to the right of the route in which the ground stays free."""
    road: RoadLine

    def clear(self, side: float) -> float:
        """Metres that stay free on a side; 1 = right, -1 = left."""
        return self.clear_m[1] if side > 0.0 else self.clear_m[0]

    @property
    def speed_m_s(self) -> float:
        """At its beginning; negative = backwards."""
        return self.journey.route.keys[0].speed_m_s

    def point(self, along_m: float, right_m: float) -> tuple[float, float]:
        """X and y of a place that far ahead of the rearmost point and to the right."""
        return right_m, along_m - 0.5 * self.length_m


def plan_travel(description: SceneDescription, place: str, duration_s: float) -> TravelPlan | None:
    """The route of a camera that travels, with the road below it; None where it does not."""
    moves = [move for move in description.camera.moves if move.kind == "travel"]
    if not moves:
        return None
    ground, view = PLACES[place].ground, description.camera.view
    is_aerial = view in ("aerial", "top")
    usual = _BY_GROUND.get(ground, "walk")
    means = _MEANS[moves[0].means or ("fly" if is_aerial else usual)]
    height, pitch = means.height_m, means.pitch_rad
    if is_aerial:
        height, pitch = max(height, _AERIAL_M), _TOP_PITCH if view == "top" else _AERIAL_PITCH
    height = min(height, _LOW_M) if view == "low" else height
    if PLACES[place].is_room:
        height, pitch = min(height, _INDOORS_M), pitch if view == "top" else min(pitch, _SLOPE)
    road_half = PLACES[place].road_m if PLACES[place].has_road else 0.0
    is_on_pavement = ground is Ground.CITY and not is_aerial and means.speed_m_s < _ON_FOOT_M_S
    lane = 0.5 * road_half if means.is_on_road else road_half + 1.0 if is_on_pavement else 0.0
    timed = time_moves(description.camera.moves, duration_s)
    travels = [one for one in timed if one.move.kind == "travel"]
    route, length = _lay_route(travels, means.speed_m_s, duration_s)
    clear = (max(road_half + lane, _LEAST_CLEAR_M), max(road_half - lane, _LEAST_CLEAR_M))
    road = RoadLine(NORTH, (-lane, route.start[1]))
    road = with_crossing(road, description.place, 0.6 * length + 4.0)
    return TravelPlan(Journey(route, height, pitch), length, clear, road)


def _lay_route(
    travels: Sequence[TimedMove], usual_m_s: float, duration_s: float
) -> tuple[Track, float]:
    """The route, and its length from end to end, m; the camera rests between its moves."""
    times = {time for one in travels for time in (one.begin_s, min(one.end_s, duration_s))}
    keys = []
    for begin, end in pairwise(sorted({0.0, duration_s, *times})):
        now = [one.move for one in travels if one.begin_s <= begin < one.end_s]
        is_back = any(move.direction == "backward" for move in now)
        stated = now[0].speed_m_s if now else 0.0
        speed_m_s = usual_m_s * now[0].pace if stated is None else stated
        speed_m_s = -speed_m_s if is_back else speed_m_s
        keys.append(Key(end - begin, speed_m_s, ramp_s=min(0.5, 0.4 * (end - begin))))
    route = Track((0.0, 0.0, 0.0), NORTH, (Key(0.0, keys[0].speed_m_s), *keys), floor_m=0.0)
    distances_m = [route.at(float(time)).distance_m for time in np.linspace(0.0, duration_s, 33)]
    start = (0.0, -0.5 * (min(distances_m) + max(distances_m)), 0.0)
    return replace(route, start=start), max(distances_m) - min(distances_m)
