"""Who climbs a ladder, a wall or a tree: hands and feet at it, up from the ground."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.hand_work.surface_points import sample_surface
from texvent.scenes.staging.acts.holding import is_person, size_of
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Stationary,
    Vector,
    ahead,
)

_REACH_M = 0.27
"""From the middle of a climber to what the hands hold, m."""
_BAND_M = 0.3
_TRUNK_M = 0.7
"""Radius within which what is at the height of an animal is the trunk, m."""
_START_M, _SPEED_M_S = 0.12, 0.45
_STEPPING_M_S, _BEFORE_M, _LANDING_M = 0.95, 0.35, 0.15
"""Speed on stairs, m/s; how far before the lowest step and the end of the highest one walks, m."""
_FIRST = 0.06
"""Share of the rise that a foot on a step is above the line of the steps' edges."""
_STAIRS_YAW = -0.35
"""Heading of stairs that are climbed: their way up is seen from the side, rad."""
_TREAD_SHARE = 0.605
"""Height of the highest step, as a share of the model's, whose railing is higher."""
_DOWN_M = 1.0
"""From how high one climbs down, m."""
_OVER_M = 1.2
"""How far below the top of a thing a climber stops, m."""


@dataclass(frozen=True)
class ClimbingAt:
    """Goes straight up before a thing, and stops below its top; or down to the ground."""

    home: Vector
    yaw: float
    highest_m: float
    slope: float = 0.0
    """Metres ahead per metre up: a ladder leans."""
    is_down: bool = False

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        z = self.home[2]
        way = _SPEED_M_S * time_s
        height = min(z + way, self.highest_m)
        if self.is_down:
            height = max(min(z + _DOWN_M, self.highest_m) - way, z)
        place = ahead(self.home, self.yaw, self.slope * (height - z), height)
        return BodyState(place, self.yaw, activity="climb down" if self.is_down else "climb")


@dataclass(frozen=True)
class OnStairs:
    """Walks up a flight of stairs, or down."""

    foot: Vector
    """Where the steps begin, on the ground, m."""
    yaw: float
    """Heading of the way up."""
    run_m: float
    rise_m: float
    is_down: bool = False

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        way = min(_STEPPING_M_S * time_s, self.run_m + _BEFORE_M - _LANDING_M)
        along = self.run_m - _LANDING_M - way if self.is_down else way - _BEFORE_M
        share = min(max(along / self.run_m + _FIRST, 0.0), 1.0)
        place = ahead(self.foot, self.yaw, along, self.foot[2] + share * self.rise_m)
        yaw = self.yaw + (math.pi if self.is_down else 0.0)
        return BodyState(place, yaw, distance_m=way, speed_m_s=_STEPPING_M_S, activity="walk")


@dataclass(frozen=True)
class ClimbingUp:
    """An animal that runs straight up a trunk, its belly to it, and stops below the top."""

    home: Vector
    yaw: float
    highest_m: float
    speed_m_s: float

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        way = self.speed_m_s * time_s
        height = min(self.home[2] + way, self.highest_m)
        is_up = self.home[2] + way >= self.highest_m
        return BodyState(
            (self.home[0], self.home[1], height), self.yaw, pitch=-0.5 * math.pi,
            distance_m=min(way, self.highest_m - self.home[2]),
            speed_m_s=0.0 if is_up else self.speed_m_s,
        )  # fmt: skip


def climb_up(subject: Actor, target: Actor) -> Actor:
    """An animal at the left of a trunk or a pole that stays."""
    if target.is_mover:
        return subject
    model, points = subject.model, sample_surface(target, 0.0).points
    start, speed = 0.6 * model.length, min(0.55 * model.length, 0.6)
    foot = points[points[:, 2] < start + 2.0 * speed]
    middle = np.median((foot if len(foot) else points)[:, :2], axis=0)
    level = points[np.abs(points[:, 2] - start - speed) < speed]
    trunk = level[np.linalg.norm(level[:, :2] - middle, axis=1) < _TRUNK_M]
    side = float(np.median(trunk[trunk[:, 0] < middle[0], 0])) if len(trunk) else float(middle[0])
    ground, top = (side - 0.04 * model.height, float(middle[1])), float(points[:, 2].max())
    path = ClimbingUp((*ground, start), 0.0, top, speed)
    return replace(subject, trajectory=path, is_mover=True, lead_m=0.0)


def climb_stairs(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """A person on stairs, which turn their side to the camera."""
    path, model = target.trajectory, target.model
    if not isinstance(path, Stationary):
        return subject, target
    # The steps rise towards -x.
    target = replace(target, trajectory=replace(path, yaw=_STAIRS_YAW))
    up = _STAIRS_YAW + math.pi
    foot = ahead(path.home, up, -0.5 * model.length, path.home[2])
    is_down = subject.trajectory.at(0.0).activity == "climb down"
    walk = OnStairs(foot, up, model.length, _TREAD_SHARE * model.height, is_down)
    return replace(subject, trajectory=walk, is_mover=True, lead_m=0.0), target


def climb_at(subject: Actor, target: Actor) -> Actor:
    """The climber at the left of a thing that stays, facing it; a wide wall is climbed in front."""
    if target.is_mover or not is_person(subject):
        return subject
    points = sample_surface(target, 0.0).points
    low, high = points.min(axis=0), points.max(axis=0)
    size = size_of(subject.model)
    is_wall = high[0] - low[0] > 2.5 and high[1] - low[1] < 0.5 * (high[0] - low[0])
    yaw = 0.5 * math.pi - 0.5 if is_wall else 0.1
    facing = 0.5 * math.pi if is_wall else yaw
    heading = np.array([math.cos(facing), math.sin(facing)])
    across = np.array([-heading[1], heading[0]])
    middle = 0.5 * (low + high)[:2]
    aside = np.abs((points[:, :2] - middle) @ across) < _BAND_M
    strip = points[aside] if aside.any() else points
    first, second = (_nearest(strip, middle, heading, height * size) for height in (1.4, 2.0))
    slope = 0.0 if is_wall else min(max((second - first) / (0.6 * size), 0.0), 0.8)
    ground = middle + (first - _REACH_M * size) * heading
    top = max(float(high[2]) - _OVER_M * size, _START_M)
    is_down = subject.trajectory.at(0.0).activity == "climb down"
    path = ClimbingAt((float(ground[0]), float(ground[1]), _START_M), yaw, top, slope, is_down)
    return replace(subject, trajectory=path, is_mover=True, lead_m=0.0)


def _nearest(
    points: Float64Array, middle: Float64Array, heading: Float64Array, height: float
) -> float:
    """How far ahead of the middle a thing begins about a height, m."""
    level = points[np.abs(points[:, 2] - height) < 0.25]
    near = level if len(level) else points
    return float(((near[:, :2] - middle) @ heading).min())
