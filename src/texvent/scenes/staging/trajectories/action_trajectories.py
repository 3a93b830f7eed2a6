"""Motions in one place or under gravity: spin, bounce, climb, swing, jump, hover, sway.

Like those of `trajectory`, they are pure, continuous functions of time; angles in radians,
lengths in metres, times in seconds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Trajectory,
    Vector,
    ahead,
    rotation,
)

GRAVITY_M_S2 = 9.81


@dataclass(frozen=True)
class Spin:
    """Turns about the vertical through its home."""

    home: Vector
    rate_rad_s: float
    yaw: float = 0.0
    gain_rad_s2: float = 0.0
    """By how much the rate grows, rad/s²."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        turn = (self.rate_rad_s + 0.5 * self.gain_rad_s2 * time_s) * time_s
        return BodyState(self.home, self.yaw + turn)


@dataclass(frozen=True)
class SpinOnAxle:
    """Turns about its axle where it stands: a wheel's lies across its heading."""

    home: Vector
    yaw: float
    rate_rad_s: float
    pivot_m: float
    """Height of the axle above the body's origin, m."""
    gain_rad_s2: float = 0.0
    """By how much the rate grows, rad/s²."""
    is_along: bool = False
    """Whether the axle lies along its heading, as that of a flat shape seen from the front."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        turn = (self.rate_rad_s + 0.5 * self.gain_rad_s2 * time_s) * time_s
        pitch, roll = (0.0, turn) if self.is_along else (turn, 0.0)
        return BodyState(self.home, self.yaw, pitch, roll, pivot_m=self.pivot_m)


@dataclass(frozen=True)
class Bounce:
    """Free flight between bounces, until the energy is spent; then it lies or rolls on.

    Each bounce keeps `restitution` of the upward speed. Times of contact follow in closed form
    from the geometric series of the bounces.
    """

    start: Vector
    """Where it is at `start_s`; its resting height is `floor_m`."""
    floor_m: float = 0.0
    up_m_s: float = 0.0
    """Upward speed at the start."""
    along_m_s: float = 0.0
    yaw: float = 0.0
    restitution: float = 0.8
    start_s: float = 0.0
    tumble_rad_s: float = 0.0
    pivot_m: float = 0.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        elapsed = max(time_s - self.start_s, 0.0)
        along = self.along_m_s * elapsed
        return BodyState(
            ahead(self.start, self.yaw, along, self.floor_m + self.height_m(elapsed)),
            self.yaw,
            pitch=self.tumble_rad_s * elapsed,
            distance_m=abs(along),
            speed_m_s=abs(self.along_m_s),
            pivot_m=self.pivot_m,
        )

    def height_m(self, elapsed_s: float) -> float:
        """Height above its resting place, m, that long after the start."""
        drop = max(self.start[2] - self.floor_m, 0.0)
        impact = math.sqrt(self.up_m_s**2 + 2.0 * GRAVITY_M_S2 * drop)
        landing = (self.up_m_s + impact) / GRAVITY_M_S2
        if elapsed_s <= landing:
            fallen = 0.5 * GRAVITY_M_S2 * elapsed_s**2
            return max(drop + self.up_m_s * elapsed_s - fallen, 0.0)
        elapsed = elapsed_s - landing
        ratio = self.restitution
        flight = 2.0 * ratio * impact / GRAVITY_M_S2
        total = flight / (1.0 - ratio)
        if flight <= 0.0 or elapsed >= total * (1.0 - 1e-9):
            return 0.0
        number = math.floor(math.log(1.0 - elapsed / total) / math.log(ratio))
        into = elapsed - total * (1.0 - ratio**number)
        speed = impact * ratio ** (number + 1)
        return max(speed * into - 0.5 * GRAVITY_M_S2 * into**2, 0.0)


@dataclass(frozen=True)
class Climb:
    """Goes straight up or down at a speed that changes evenly; stops at `lowest_m`."""

    home: Vector
    speed_m_s: float
    mid_s: float
    acceleration_m_s2: float = 0.0
    lowest_m: float = -math.inf

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        x, y, z = self.home
        risen = self.speed_m_s * (time_s - self.mid_s)
        risen += 0.5 * self.acceleration_m_s2 * max(time_s, 0.0) ** 2
        return BodyState(
            (x, y, max(z + risen, self.lowest_m)),
            distance_m=abs(self.speed_m_s) * time_s,
            speed_m_s=abs(self.speed_m_s),
        )


@dataclass(frozen=True)
class Swing:
    """Hangs from a point above and swings as a pendulum of that length does (small angles)."""

    home: Vector
    """Where its origin hangs at rest."""
    length_m: float
    """From the body's origin up to the point it hangs from."""
    amplitude_rad: float
    pace: float = 1.0
    yaw: float = 0.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        rate = self.pace * math.sqrt(GRAVITY_M_S2 / self.length_m)
        angle = self.amplitude_rad * math.cos(rate * time_s)
        return BodyState(self.home, self.yaw, pitch=angle, activity="swing", pivot_m=self.length_m)


@dataclass(frozen=True)
class Hop:
    """Hops: free flight to `height_m`, a short stand, again; moves along while in the air."""

    home: Vector
    height_m: float
    pause_s: float = 0.15
    hop_m: float = 0.0
    """Metres along per hop."""
    yaw: float = 0.0
    mid_s: float = 0.0
    sway_rad: float = 0.0
    phase_s: float = 0.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        flight = 2.0 * math.sqrt(2.0 * self.height_m / GRAVITY_M_S2)
        period = flight + self.pause_s
        clock = time_s + self.phase_s
        number = math.floor(clock / period)
        into = min(clock - number * period, flight)
        height = 0.5 * GRAVITY_M_S2 * into * (flight - into)
        hops = number + into / flight
        along = self.hop_m * (hops - (self.mid_s + self.phase_s) / period)
        swing = self.sway_rad * math.sin(math.pi * clock / period)
        return BodyState(
            ahead(self.home, self.yaw, along, self.home[2] + height),
            self.yaw + swing,
            distance_m=max(self.hop_m * (hops - self.phase_s / period), 0.0),
            speed_m_s=self.hop_m / period,
            activity="move" if self.hop_m else "jump",
            act_s=into - 0.5 * flight,
        )


@dataclass(frozen=True)
class Hover:
    """Stays in one place in the air or on water, drifting a little."""

    home: Vector
    amplitude_m: float
    yaw: float = 0.0
    phase: float = 0.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        wave = 2.0 * math.pi * time_s + self.phase
        x, y, z = self.home
        return BodyState(
            (
                x + 0.6 * self.amplitude_m * math.sin(0.23 * wave),
                y,
                z + self.amplitude_m * math.sin(0.4 * wave),
            ),
            self.yaw + 0.12 * math.sin(0.31 * wave),
            roll=0.05 * math.sin(0.23 * wave),
        )


@dataclass(frozen=True)
class Sway:
    """Leans from side to side about its foot."""

    home: Vector
    amplitude_rad: float
    rate_hz: float
    yaw: float = 0.0
    is_turning: bool = False
    """Whether it turns to and fro instead, as what lies flat."""

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        angle = self.amplitude_rad * math.sin(2.0 * math.pi * self.rate_hz * time_s)
        if self.is_turning:
            return BodyState(self.home, self.yaw + angle, activity="stand")
        return BodyState(self.home, self.yaw, roll=angle, activity="stand")


@dataclass(frozen=True)
class RollOver:
    """Lies and turns about its own length, once in two seconds."""

    home: Vector
    yaw: float
    pivot_m: float
    """Height of that length above the ground, m."""
    tempo: float = 1.0

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        turn = math.pi * self.tempo * time_s
        return BodyState(self.home, self.yaw, roll=turn, pivot_m=self.pivot_m, activity="lie")


@dataclass(frozen=True)
class Wheelie:
    """Rides with its front lifted, about its rear wheel."""

    path: Trajectory
    rear_m: float
    """How far the rear wheel's hub is behind the middle, m."""
    hub_m: float

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        state = self.path.at(time_s)
        share = min(max(time_s / 0.6, 0.0), 1.0)
        lift = 0.65 * share**2 * (3.0 - 2.0 * share)
        hub = np.array([-self.rear_m, 0.0, self.hub_m])
        turned = rotation(state.yaw, -lift, 0.0) @ hub
        level = rotation(state.yaw, 0.0, 0.0) @ hub
        x, y, z = (a + float(b) for a, b in zip(state.position, level - turned, strict=True))
        return replace(state, position=(x, y, z), pitch=-lift)
