"""Where a thing is at each instant: trajectories as pure functions of time.

Angles are radians, positions metres in world coordinates (x right, y away, z up), times seconds.
Every trajectory is continuous, and `distance_m` never falls, so that wheels and legs turn with
the ground they cover.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from texvent.generate.procedural.primitives import Float64Array

GRAVITY_M_S2 = 9.81
Vector = tuple[float, float, float]


@dataclass(frozen=True)
class State:
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

    def to_world(self) -> Float64Array:
        """[3, 4] map from body to world coordinates."""
        turn = rotation(self.yaw, self.pitch, self.roll)
        pivot = np.array([0.0, 0.0, self.pivot_m])
        offset = np.array(self.position) + pivot - turn @ pivot
        return np.column_stack([turn, offset])


def rotation(yaw: float, pitch: float, roll: float) -> Float64Array:
    """[3, 3] rotation: roll about x, then pitch about y, then yaw about z.

    Example:
        >>> rotation(math.pi / 2, 0.0, 0.0).round(6).tolist()[1]
        [1.0, 0.0, 0.0]
    """
    cy, sy = math.cos(yaw), math.sin(yaw)
    cp, sp = math.cos(pitch), math.sin(pitch)
    cr, sr = math.cos(roll), math.sin(roll)
    about_z = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    about_y = np.array([[cp, 0.0, sp], [0.0, 1.0, 0.0], [-sp, 0.0, cp]])
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]])
    return np.asarray(about_z @ about_y @ about_x)


class Trajectory(Protocol):
    """A body's state as a function of time."""

    def at(self, time_s: float) -> State:
        """State at that instant."""
        ...


@dataclass(frozen=True)
class Rest:
    """Stays where it is; `activity` still moves limbs, flags and blades."""

    home: Vector
    yaw: float = 0.0
    activity: str = "stand"

    def at(self, time_s: float) -> State:
        """State at that instant."""
        return State(self.home, self.yaw, activity=self.activity)


@dataclass(frozen=True)
class Straight:
    """Moves along its heading at constant speed; at its home at `mid_s`."""

    home: Vector
    yaw: float
    speed_m_s: float
    mid_s: float
    activity: str = "move"
    climb: float = 0.0
    """Metres up per metre along."""
    bob_m: float = 0.0
    """Amplitude of a slow up and down."""
    weave_rad: float = 0.0
    """Amplitude of swaying about its heading, as fish do."""
    phase: float = 0.0
    facing_rad: float | None = None
    """Where its front points if not along its heading (a kite's face)."""

    def at(self, time_s: float) -> State:
        """State at that instant."""
        facing = self.yaw if self.facing_rad is None else self.facing_rad
        along = self.speed_m_s * (time_s - self.mid_s)
        x, y, z = self.home
        wave = 2.0 * math.pi * 0.4 * time_s + self.phase
        return State(
            (
                x + along * math.cos(self.yaw),
                y + along * math.sin(self.yaw),
                z + along * self.climb + self.bob_m * math.sin(wave),
            ),
            facing + self.weave_rad * math.sin(1.7 * wave),
            -math.atan(self.climb),
            distance_m=self.speed_m_s * time_s,
            speed_m_s=self.speed_m_s,
            activity=self.activity,
        )


@dataclass(frozen=True)
class Rolling:
    """Rolls without sliding: turns by distance over radius while `path` carries it."""

    path: Trajectory
    radius_m: float
    pivot_m: float
    """Height of its middle above the body's origin."""

    def at(self, time_s: float) -> State:
        """State at that instant."""
        state = self.path.at(time_s)
        return replace(state, pitch=state.distance_m / self.radius_m, pivot_m=self.pivot_m)


@dataclass(frozen=True)
class Shuttle:
    """Goes to and fro about its home along its heading, as a sine of time."""

    home: Vector
    yaw: float
    amplitude_m: float
    period_s: float
    activity: str = "move"
    vertical: bool = False

    def at(self, time_s: float) -> State:
        """State at that instant."""
        rate = 2.0 * math.pi / self.period_s
        offset = self.amplitude_m * math.sin(rate * time_s)
        x, y, z = self.home
        along = 0.0 if self.vertical else offset
        return State(
            (
                x + along * math.cos(self.yaw),
                y + along * math.sin(self.yaw),
                z + (offset if self.vertical else 0.0),
            ),
            self.yaw,
            distance_m=self.amplitude_m * _sine_path(rate * time_s),
            speed_m_s=abs(self.amplitude_m * rate * math.cos(rate * time_s)),
            activity=self.activity,
        )


def _sine_path(angle: float) -> float:
    """Integral of |cos| from 0: the path of a sine of amplitude 1."""
    half_turns = math.floor(angle / math.pi + 0.5)
    sign = 1.0 if half_turns % 2 == 0 else -1.0
    return 2.0 * half_turns + sign * math.sin(angle)


@dataclass(frozen=True)
class Circle:
    """Goes round a centre at constant speed, facing along its path and leaning into the turn."""

    centre: Vector
    radius_m: float
    rate_rad_s: float
    """Positive = anticlockwise seen from above."""
    phase: float = 0.0
    activity: str = "move"
    lean_rad: float = 0.0

    def at(self, time_s: float) -> State:
        """State at that instant."""
        angle = self.phase + self.rate_rad_s * time_s
        turn = math.copysign(math.pi / 2.0, self.rate_rad_s)
        x, y, z = self.centre
        speed = abs(self.rate_rad_s) * self.radius_m
        return State(
            (x + self.radius_m * math.cos(angle), y + self.radius_m * math.sin(angle), z),
            angle + turn,
            roll=-math.copysign(self.lean_rad, self.rate_rad_s),
            distance_m=speed * time_s,
            speed_m_s=speed,
            activity=self.activity,
        )


@dataclass(frozen=True)
class Spin:
    """Turns about the vertical through its home."""

    home: Vector
    rate_rad_s: float
    yaw: float = 0.0
    activity: str = "move"

    def at(self, time_s: float) -> State:
        """State at that instant."""
        return State(self.home, self.yaw + self.rate_rad_s * time_s, activity=self.activity)


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
    activity: str = "move"

    def at(self, time_s: float) -> State:
        """State at that instant."""
        elapsed = max(time_s - self.start_s, 0.0)
        along = self.along_m_s * elapsed
        x, y, _ = self.start
        return State(
            (
                x + along * math.cos(self.yaw),
                y + along * math.sin(self.yaw),
                self.floor_m + self.height_m(elapsed),
            ),
            self.yaw,
            pitch=self.tumble_rad_s * elapsed,
            distance_m=abs(along),
            speed_m_s=abs(self.along_m_s),
            activity=self.activity,
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
    yaw: float = 0.0

    def at(self, time_s: float) -> State:
        """State at that instant."""
        x, y, z = self.home
        risen = self.speed_m_s * (time_s - self.mid_s)
        risen += 0.5 * self.acceleration_m_s2 * max(time_s, 0.0) ** 2
        return State(
            (x, y, max(z + risen, self.lowest_m)),
            self.yaw,
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

    def at(self, time_s: float) -> State:
        """State at that instant."""
        rate = self.pace * math.sqrt(GRAVITY_M_S2 / self.length_m)
        angle = self.amplitude_rad * math.cos(rate * time_s)
        return State(self.home, self.yaw, pitch=angle, activity="swing", pivot_m=self.length_m)


@dataclass(frozen=True)
class Jump:
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

    def at(self, time_s: float) -> State:
        """State at that instant."""
        flight = 2.0 * math.sqrt(2.0 * self.height_m / GRAVITY_M_S2)
        period = flight + self.pause_s
        clock = time_s + self.phase_s
        number = math.floor(clock / period)
        into = min(clock - number * period, flight)
        height = 0.5 * GRAVITY_M_S2 * into * (flight - into)
        hops = number + into / flight
        along = self.hop_m * (hops - (self.mid_s + self.phase_s) / period)
        x, y, z = self.home
        swing = self.sway_rad * math.sin(math.pi * clock / period)
        return State(
            (x + along * math.cos(self.yaw), y + along * math.sin(self.yaw), z + height),
            self.yaw + swing,
            distance_m=max(self.hop_m * (hops - self.phase_s / period), 0.0),
            speed_m_s=self.hop_m / period,
            activity="move" if self.hop_m else "jump",
        )


@dataclass(frozen=True)
class Hover:
    """Stays in one place in the air or on water, drifting a little."""

    home: Vector
    amplitude_m: float
    yaw: float = 0.0
    phase: float = 0.0
    turn_rad: float = 0.12

    def at(self, time_s: float) -> State:
        """State at that instant."""
        wave = 2.0 * math.pi * time_s + self.phase
        x, y, z = self.home
        return State(
            (
                x + 0.6 * self.amplitude_m * math.sin(0.23 * wave),
                y,
                z + self.amplitude_m * math.sin(0.4 * wave),
            ),
            self.yaw + self.turn_rad * math.sin(0.31 * wave),
            roll=0.05 * math.sin(0.23 * wave),
            activity="move",
        )


@dataclass(frozen=True)
class Sway:
    """Leans from side to side about its foot."""

    home: Vector
    amplitude_rad: float
    rate_hz: float
    yaw: float = 0.0

    def at(self, time_s: float) -> State:
        """State at that instant."""
        angle = self.amplitude_rad * math.sin(2.0 * math.pi * self.rate_hz * time_s)
        return State(self.home, self.yaw, roll=angle, activity="stand")


@dataclass(frozen=True)
class Riding:
    """Goes where another body goes, at a fixed place on it, with a motion of its own on top."""

    carrier: Trajectory
    seat: Vector
    """In the carrier's body coordinates, m."""
    yaw: float = 0.0
    activity: str = "sit"

    def at(self, time_s: float) -> State:
        """State at that instant."""
        below = self.carrier.at(time_s)
        place = below.to_world() @ np.array([*self.seat, 1.0])
        return State(
            (float(place[0]), float(place[1]), float(place[2])),
            below.yaw + self.yaw,
            below.pitch,
            below.roll,
            activity=self.activity,
        )
