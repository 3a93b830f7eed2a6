"""Trajectories of objects: pure functions of time.

Angles are radians, positions metres in world coordinates (x right, y away, z up), times seconds.
Every trajectory is continuous, and `distance_m` never falls, so that wheels and legs turn with
the ground they cover.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from texvent_scenes.models.shapes import compose, point, shift
from texvent_scenes.models.shapes import rotation as about
from texvent_scenes.rendered_scene import Float64Array

Vector = tuple[float, float, float]
TO_CAMERA = -0.5 * math.pi
"""Yaw of what shows its front to the camera."""


@dataclass(frozen=True)
class BodyState:
    """A body at one instant."""

    position: Vector
    """World position of the body's origin before it is turned about its pivot, m."""
    yaw: float = 0.0
    """Turn about the vertical, from +x towards +y."""
    pitch: float = 0.0
    """Turn about its own y axis: positive puts the nose down."""
    roll: float = 0.0
    """Turn about its own x axis."""
    distance_m: float = 0.0
    """Path covered since t = 0, m."""
    speed_m_s: float = 0.0
    activity: str = "move"
    """`Pose.activity`."""
    pivot_m: float = 0.0
    """Height above the body's origin about which it turns, m."""
    act_s: float | None = None
    """`Pose.act_s`."""
    grips: tuple[tuple[str, Vector], ...] = ()
    """`Pose.grips`."""
    tempo: float = 1.0
    """Rate of its gestures, as a multiple of their usual rate."""

    def to_world(self) -> Float64Array:
        """[3, 4] map from body to world coordinates."""
        turn = rotation(self.yaw, self.pitch, self.roll)
        pivot = np.array([0.0, 0.0, self.pivot_m])
        offset = np.array(self.position) + pivot - turn @ pivot
        return np.column_stack([turn, offset])


def ahead(home: Vector, yaw: float, along_m: float, height_m: float) -> Vector:
    """The point `along_m` from `home` along a heading, at a height, m."""
    x, y, _ = home
    return (x + along_m * math.cos(yaw), y + along_m * math.sin(yaw), height_m)


def rotation(yaw: float, pitch: float, roll: float) -> Float64Array:
    """[3, 3] rotation: roll about x, then pitch about y, then yaw about z.

    Example:
        >>> rotation(math.pi / 2, 0.0, 0.0).round(6).tolist()[1]
        [1.0, 0.0, 0.0]
    """
    return np.asarray(about("z", yaw) @ about("y", pitch) @ about("x", roll))


def state_of(to_world: Float64Array) -> BodyState:
    """The state whose map from body to world this is ([3, 4], a rotation and an offset)."""
    pitch = math.asin(min(max(-float(to_world[2, 0]), -1.0), 1.0))
    yaw = math.atan2(float(to_world[1, 0]), float(to_world[0, 0]))
    roll = math.atan2(float(to_world[2, 1]), float(to_world[2, 2]))
    return BodyState(point(to_world[:, 3]), yaw, pitch, roll, activity="stand")


class Trajectory(Protocol):
    """A body's state as a function of time."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        ...


@dataclass(frozen=True)
class Stationary:
    """Stays where it is; `activity` still moves limbs, flags and blades."""

    home: Vector
    yaw: float = 0.0
    activity: str = "stand"
    tempo: float = 1.0
    gain_per_s: float = 0.0
    """By how much the tempo grows each second."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        mean = self.tempo + 0.5 * self.gain_per_s * time_s
        return BodyState(self.home, self.yaw, activity=self.activity, tempo=mean)


@dataclass(frozen=True)
class Rolling:
    """Rolls without sliding: turns by distance over radius while `path` carries it."""

    path: Trajectory
    radius_m: float
    """Also the height of its middle above the body's origin."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        return replace(state, pitch=state.distance_m / self.radius_m, pivot_m=self.radius_m)


@dataclass(frozen=True)
class Shuttle:
    """Goes to and fro about its home along its heading, as a sine of time.

    Who walks or runs turns round where it goes back.
    """

    home: Vector
    yaw: float
    amplitude_m: float
    period_s: float
    activity: str = "move"
    vertical: bool = False

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        rate = 2.0 * math.pi / self.period_s
        offset = self.amplitude_m * math.sin(rate * time_s)
        # The distance covered is the integral of |cos|.
        halves = math.floor(rate * time_s / math.pi + 0.5)
        covered_m = 2.0 * self.amplitude_m * halves + (offset if halves % 2 == 0 else -offset)
        along, up = (0.0, offset) if self.vertical else (offset, 0.0)
        turned = 0.0
        if self.activity in ("walk", "run") and not self.vertical:
            forth = max(-1.0, min(1.0, math.cos(rate * time_s) / _TURNING))
            turned = 0.5 * math.pi * (1.0 - math.sin(0.5 * math.pi * forth))
        return BodyState(
            ahead(self.home, self.yaw, along, self.home[2] + up),
            self.yaw + turned,
            distance_m=covered_m,
            speed_m_s=abs(self.amplitude_m * rate * math.cos(rate * time_s)),
            activity=self.activity,
        )


_TURNING = 0.4
"""Share of its greatest speed below which who goes to and fro turns round."""


@dataclass(frozen=True)
class Facing:
    """A board or a flat shape that shows its front to the camera all along a path."""

    path: Trajectory

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        return replace(self.path.at(time_s), yaw=TO_CAMERA, pitch=0.0, roll=0.0)


@dataclass(frozen=True)
class Attached:
    """Fixed to axes that another body carries: its own, those of a named place, or of a part."""

    carrier: Trajectory
    axes: Callable[[float], Float64Array]
    """Instant, s → [3, 4] these axes in the world."""
    offset: Float64Array
    """[3, 4] its body coordinates in these axes."""
    activity: str = "stand"

    @classmethod
    def seated(cls, carrier: Trajectory, seat: Vector, activity: str) -> Attached:
        """At a fixed place in the carrier's body coordinates, m."""
        return cls(carrier, lambda time_s: carrier.at(time_s).to_world(), shift(*seat), activity)

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        below = self.carrier.at(time_s)
        return replace(
            state_of(compose(self.axes(time_s), self.offset)),
            distance_m=below.distance_m,
            speed_m_s=below.speed_m_s,
            activity=self.activity,
        )


@dataclass(frozen=True)
class Performed:
    """Another trajectory whose body does something in particular meanwhile."""

    path: Trajectory
    activity: str | None = None
    """None = what the path says."""
    grips: tuple[tuple[str, Vector], ...] = ()
    contact_s: float | None = None
    """Instant of contact of a single act, s."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        return replace(
            state,
            activity=self.activity or state.activity,
            grips=self.grips + state.grips,
            act_s=state.act_s if self.contact_s is None else time_s - self.contact_s,
        )


@dataclass(frozen=True)
class Switched:
    """One trajectory up to an instant, another from then on."""

    before: Trajectory
    after: Trajectory
    at_s: float

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        return (self.before if time_s < self.at_s else self.after).at(time_s)
