"""Lines on the ground: where a road runs, and where the shore of water lies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.places import Place
from texvent.scenes.models.tables import nouns_with
from texvent.scenes.scene import Float64Array, Ground
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.trajectories.phases import ROAD_BEND_PER_M
from texvent.scenes.staging.trajectories.steered_path import SteeredPath
from texvent.scenes.staging.trajectories.trajectory import Attached, Stationary

_LEAST_TURN = 0.9
"""Least change of heading, radians, after which a road goes off there."""
_PAVEMENT_M, _VERGE_M = 1.4, 0.5
"""From the edge of the road to who walks beside it, and to what stands beside it."""
_ROADSIDE = 1.4
"""Where one walks on a road without pavement, in lanes from its middle."""
_USUAL_S = 2.0
_CROSSING_AHEAD_M = 7.0
_AFLOAT = ("swim", "surf")
"""What people do in water, or on it."""
_BANK, _LEAST_BANK_M = 0.22, 1.0
"""Land between what the camera looks at and the water: a share of the camera's distance, and m."""
_NEARER = 0.45
"""How far before what floats on it a lake begins, as a share of the camera's distance."""


@dataclass(frozen=True)
class RoadLine:
    """Centre lines of the roads of a scene; lengths in metres, angles in radians."""

    angle: float = 0.0
    """Direction at `offset`, from x towards y."""
    offset: tuple[float, float] = (0.0, 0.0)
    """A point (x, y) on the main road's centre line."""
    curvature: float = 0.0
    """1/m; positive bends to the left of `angle`; 0 = straight."""
    crossings: tuple[tuple[float, float, float], ...] = ()
    """Straight roads that cross the main one: a point (x, y) on the centre line, and direction."""

    def at(self, along_m: float) -> tuple[float, float, float]:
        """Point (x, y) and direction of the main road at that arc length from `offset`."""
        heading, half = self.angle + self.curvature * along_m, 0.5 * self.curvature * along_m
        chord = along_m * float(np.sinc(half / math.pi))
        x = self.offset[0] + chord * math.cos(self.angle + half)
        return x, self.offset[1] + chord * math.sin(self.angle + half), heading

    def across(self, spots: Float64Array) -> Float64Array:
        """[n] metres from the main road's line to ground points [n, 2], positive on its left."""
        x, y = (np.asarray(spots, dtype=np.float64) - self.offset).T
        aside = y * math.cos(self.angle) - x * math.sin(self.angle)
        if self.curvature == 0.0:
            return np.asarray(aside)
        radius = 1.0 / self.curvature
        far = np.hypot(x + radius * math.sin(self.angle), y - radius * math.cos(self.angle))
        return np.asarray(math.copysign(1.0, radius) * (abs(radius) - far))

    def distance(self, spots: Float64Array) -> Float64Array:
        """[n] metres from each ground point [n, 2] to the nearest centre line."""
        lines = [self, *(RoadLine(angle, (x, y)) for x, y, angle in self.crossings)]
        return np.asarray(np.min([np.abs(line.across(spots)) for line in lines], axis=0))


def find_road(
    description: SceneDescription, place: Place, actors: Sequence[Actor], usual_y: float
) -> RoadLine:
    """The road along the path of the first object on the ground that moves, or at `usual_y`, m."""
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
    grounded = [one for one in actors if one.noun.habitat == "ground"]
    # Ducks cross a road too.
    movers = [one for one in actors if one.is_mover and (one in grounded or one.goes_across)]
    drivers = [one for one in movers if one.noun.motion == "drive"]
    if drivers or (movers and not movers[0].goes_across):
        return _road_of(drivers or movers, lane_m, has_pavement=has_pavement)
    if movers:
        crossing = [one for one in movers if one.goes_across]
        middle = crossing[len(crossing) // 2]
        x, y, _ = middle.middle(0.5 * _USUAL_S)
        return RoadLine(movers[0].trajectory.at(0.0).yaw + 0.5 * math.pi, (float(x), float(y)))
    nouns = {one.noun.name for one in actors}
    drive = any(one.noun.motion == "drive" for one in actors)
    may_be_beside = not drive and (has_pavement or nouns & nouns_with("beside a road"))
    if nouns and may_be_beside and not nouns & nouns_with("on a road"):
        farthest = max(float(one.corners(0.0)[:, 1].max()) for one in actors)
        return RoadLine(offset=(0.0, farthest + 2.0 * lane_m + _VERGE_M))
    y = grounded[0].trajectory.at(0.0).position[1] if grounded else usual_y
    return RoadLine(offset=(0.0, float(y)))


def _road_of(movers: Sequence[Actor], lane_m: float, *, has_pavement: bool) -> RoadLine:
    """The road whose right lane, or whose edge, the first mover keeps to, also where it turns."""
    first = movers[0]
    lane = _lane_of(movers, lane_m)
    if first.noun.motion != "drive":
        lane = 2.0 * lane_m + _PAVEMENT_M if has_pavement else _ROADSIDE * lane_m

    def centre_line(time_s: float) -> tuple[float, float, float]:
        state = first.trajectory.at(time_s)
        x, y, _ = state.position
        # Traffic keeps to the right: the centre line is on its left.
        return x - lane * math.sin(state.yaw), y + lane * math.cos(state.yaw), state.yaw

    x, y, yaw = centre_line(0.0)
    crossings: list[tuple[float, float, float]] = []
    if isinstance(first.trajectory, SteeredPath):
        ends = (0.5 * first.trajectory.duration_s, first.trajectory.duration_s)
        crossings = [
            line
            for line in map(centre_line, ends)
            if abs(math.remainder(line[2] - yaw, math.pi)) > _LEAST_TURN
        ]
    return RoadLine(yaw % math.pi if lane == 0.0 else yaw, (x, y), crossings=tuple(crossings[:1]))


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


def lay_across(actors: Sequence[Actor], road: RoadLine) -> list[Actor]:
    """The actors, with what is painted across a road turned to it and under who crosses."""
    crossing = next((one for one in actors if one.goes_across), None)
    laid = []
    for one in actors:
        if one.noun.name in nouns_with("across a road"):
            x, y, _ = (crossing or one).middle(0.5 * _USUAL_S) - (*road.offset, 0.0)
            along = float(x * math.cos(road.angle) + y * math.sin(road.angle))
            x, y, angle = road.at(along)
            one = replace(one, trajectory=Stationary((x, y, 0.0), angle + 0.5 * math.pi))
        laid.append(one)
    return laid


def water_line(place: Place, actors: Sequence[Actor], path: CameraPath) -> RoadLine:
    """The middle of a river, or the shore of a lake with the water on its left.

    It runs through what floats or swims, and behind what stands beside it.
    """
    forward = path.at(0.0).rotation[2, :2]
    angle = math.atan2(float(forward[1]), float(forward[0])) - 0.5 * math.pi
    x, y = float(path.framing.target[0]), float(path.framing.target[1])
    half = place.road_m if place.ground is Ground.RIVER else 0.0
    swimmers = [one for one in actors if _is_in_water(one)]
    gap = half + _BANK * path.framing.distance_m + _LEAST_BANK_M
    if not actors:
        gap = half
    elif swimmers and place.ground is Ground.RIVER:
        gap, state = 0.0, swimmers[0].trajectory.at(0.0)
        angle = state.yaw if swimmers[0].is_mover else angle
        x, y = float(state.position[0]), float(state.position[1])
    elif swimmers:
        gap = -_NEARER * path.framing.distance_m
    return RoadLine(angle, (x - gap * math.sin(angle), y + gap * math.cos(angle)))


def _is_in_water(actor: Actor) -> bool:
    is_of_water = actor.noun.habitat == "water" and not isinstance(actor.trajectory, Attached)
    return is_of_water or actor.trajectory.at(0.0).activity in _AFLOAT
