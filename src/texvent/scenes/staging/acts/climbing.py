"""Who climbs a ladder, a wall or a tree: hands and feet at it, up from the ground."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.hand_work.surface_points import sample_surface
from texvent.scenes.staging.acts.holding import is_person, size_of
from texvent.scenes.staging.trajectories.trajectory import BodyState, Vector, ahead

_REACH_M = 0.27
"""From the middle of a climber to what the hands hold, m."""
_BAND_M = 0.3
_TRUNK_M = 0.7
"""Radius within which what is at the height of an animal is the trunk, m."""
_START_M, _SPEED_M_S = 0.12, 0.45
_OVER_M = 1.2
"""How far below the top of a thing a climber stops, m."""


@dataclass(frozen=True)
class ClimbingAt:
    """Goes straight up before a thing, and stops below its top."""

    home: Vector
    yaw: float
    highest_m: float
    slope: float = 0.0
    """Metres ahead per metre up: a ladder leans."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        z = self.home[2]
        height = min(z + _SPEED_M_S * time_s, self.highest_m)
        place = ahead(self.home, self.yaw, self.slope * (height - z), height)
        return BodyState(place, self.yaw, activity="climb")


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
    path = ClimbingAt((float(ground[0]), float(ground[1]), _START_M), yaw, top, slope)
    return replace(subject, trajectory=path, is_mover=True, lead_m=0.0)


def _nearest(
    points: Float64Array, middle: Float64Array, heading: Float64Array, height: float
) -> float:
    """How far ahead of the middle a thing begins about a height, m."""
    level = points[np.abs(points[:, 2] - height) < 0.25]
    near = level if len(level) else points
    return float(((near[:, :2] - middle) @ heading).min())
