"""Motions in one place or under gravity: spin, sway, hover, flight.

Like those of `trajectory`, they are pure, continuous functions of time; angles in radians,
lengths in metres, times in seconds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np

from texvent_scenes.models.shapes import point
from texvent_scenes.staging.trajectories.trajectory import (
    BodyState,
    Trajectory,
    Vector,
    rotation,
)

GRAVITY_M_S2 = 9.81
Axis = Literal["yaw", "pitch", "roll"]
"""The vertical, the body's width, or its length."""


@dataclass(frozen=True)
class Spin:
    """Turns about an axis through its home."""

    home: Vector
    rate_rad_s: float
    yaw: float = 0.0
    gain_rad_s2: float = 0.0
    """By how much the rate grows, rad/s²."""
    axis: Axis = "yaw"
    pivot_m: float = 0.0
    """Height of the axis above the body's origin, m, unless it is the vertical."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        turn = (self.rate_rad_s + 0.5 * self.gain_rad_s2 * time_s) * time_s
        state = BodyState(self.home, self.yaw, pivot_m=self.pivot_m)
        if self.axis == "yaw":
            return replace(state, yaw=self.yaw + turn)
        return replace(state, pitch=turn) if self.axis == "pitch" else replace(state, roll=turn)


class Wave(NamedTuple):
    """A sine that is added to one coordinate of a body."""

    axis: Literal["x", "y", "z", "yaw", "pitch", "roll"]
    amplitude: float
    """m or rad."""
    rate_hz: float
    phase: float = 0.0


@dataclass(frozen=True)
class Oscillating:
    """To and fro about where another trajectory has it: what sways, bobs or hovers."""

    path: Trajectory
    waves: tuple[Wave, ...]

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        values = dict(zip("xyz", state.position, strict=True))
        values |= {"yaw": state.yaw, "pitch": state.pitch, "roll": state.roll}
        for wave in self.waves:
            angle = 2.0 * math.pi * wave.rate_hz * time_s + wave.phase
            values[wave.axis] += wave.amplitude * math.sin(angle)
        x, y, z, yaw, pitch, roll = values.values()
        return replace(state, position=(x, y, z), yaw=yaw, pitch=pitch, roll=roll)


def hover(path: Trajectory, amplitude_m: float, phase: float = 0.0) -> Oscillating:
    """Drifting a little, in the air or on water, about where a path has it."""
    return Oscillating(
        path,
        (
            Wave("x", 0.6 * amplitude_m, 0.23, 0.23 * phase),
            Wave("z", amplitude_m, 0.4, 0.4 * phase),
            Wave("yaw", 0.12, 0.31, 0.31 * phase),
            Wave("roll", 0.05, 0.23, 0.23 * phase),
        ),
    )


@dataclass(frozen=True)
class Flight:
    """Free flight between bounces, until the energy is spent; then it lies or rolls on."""

    start: BodyState
    """State at release; it turns about its pivot."""
    velocity_m_s: Vector = (0.0, 0.0, 0.0)
    floor_m: float = 0.0
    """Height of its origin where it bounces."""
    restitution: float = 0.8
    """Share of the upward speed that each bounce keeps."""
    start_s: float = 0.0
    tumble_rad_s: float = 0.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        elapsed = max(time_s - self.start_s, 0.0)
        x, y, z = self.start.position
        speed = math.hypot(self.velocity_m_s[0], self.velocity_m_s[1])
        drop = max(z - self.floor_m, 0.0)
        height = bounce_height(drop, self.velocity_m_s[2], self.restitution, elapsed)
        return replace(
            self.start,
            position=(
                x + elapsed * self.velocity_m_s[0],
                y + elapsed * self.velocity_m_s[1],
                self.floor_m + height,
            ),
            pitch=self.start.pitch + self.tumble_rad_s * elapsed,
            distance_m=self.start.distance_m + speed * elapsed,
            speed_m_s=speed,
        )


def bounce_height(drop_m: float, up_m_s: float, restitution: float, elapsed_s: float) -> float:
    """Height above the floor, m, of what is let go at a height with an upward speed.

    Times of contact follow in closed form from the geometric series of the bounces.
    """
    impact = math.sqrt(up_m_s**2 + 2.0 * GRAVITY_M_S2 * drop_m)
    landing = (up_m_s + impact) / GRAVITY_M_S2
    if elapsed_s <= landing:
        fallen = 0.5 * GRAVITY_M_S2 * elapsed_s**2
        return max(drop_m + up_m_s * elapsed_s - fallen, 0.0)
    elapsed = elapsed_s - landing
    flight = 2.0 * restitution * impact / GRAVITY_M_S2
    total = flight / (1.0 - restitution)
    if flight <= 0.0 or elapsed >= total * (1.0 - 1e-9):
        return 0.0
    number = math.floor(math.log(1.0 - elapsed / total) / math.log(restitution))
    into = elapsed - total * (1.0 - restitution**number)
    speed = impact * restitution ** (number + 1)
    return max(speed * into - 0.5 * GRAVITY_M_S2 * into**2, 0.0)


def about_pivot(state: BodyState, pivot_m: float) -> BodyState:
    """The same body in the same place, said by a point so high above its origin."""
    pivot = np.array([0.0, 0.0, pivot_m])
    turn = rotation(state.yaw, state.pitch, state.roll)
    position = point(state.to_world()[:, 3] + turn @ pivot - pivot)
    return replace(state, position=position, pivot_m=pivot_m)
