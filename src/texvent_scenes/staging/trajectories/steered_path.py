"""A path made of pieces: each ends at a speed, a rate of turning and a rate of climbing.

Within a piece these three change smoothly (3u² - 2u³) from the values that the last piece ended
with and stay there, so position, heading and speed are continuous. Heading, height and distance
follow in closed form; the position is the integral of the velocity, in closed form on straight
lines and by Gauss-Legendre quadrature in bends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from texvent_scenes.staging.trajectories.action_trajectories import GRAVITY_M_S2, bounce_height
from texvent_scenes.staging.trajectories.trajectory import BodyState, Vector

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_RADIANS_PER_STEP = 1.0
"""Most heading that one step of the quadrature spans."""
_RAMP_S, _SAMPLES, _RESTITUTION = 0.3, 41, 0.3


@dataclass(frozen=True)
class Piece:
    """One stretch of a path."""

    duration_s: float
    speed_m_s: float = 0.0
    """Along the heading, at its end; negative = backwards."""
    turn_rad_s: float = 0.0
    """Rate of the heading at its end; positive = to the left."""
    climb_m_s: float = 0.0
    ramp_s: float = 0.3
    """Duration of the change to these values; at most the whole piece."""
    activity: str = "move"
    hop_m: float = 0.0
    """Height of hops; 0 = none."""
    is_dropped: bool = False
    """Whether it falls to the floor, with small bounces."""
    pitch_rad: float = 0.0
    """Pitch of the body at its end, as of a person who falls over."""

    @property
    def rates(self) -> tuple[float, float, float, float]:
        """As those of a knot, at its end."""
        return (self.speed_m_s, self.turn_rad_s, self.climb_m_s, self.pitch_rad)


class _Knot(NamedTuple):
    """Values at the beginning of a piece."""

    time_s: float
    place: Vector
    heading: float
    distance_m: float
    rates: tuple[float, float, float, float]
    """Speed, rate of turning, rate of climbing; and pitch, which changes as they do."""


@dataclass(frozen=True)
class SteeredPath:
    """Goes along its pieces; before the first it moves straight, after the last it goes on."""

    start: Vector
    """Position at t = 0, m."""
    yaw: float
    pieces: tuple[Piece, ...]
    initial_speed_m_s: float = 0.0
    initial_turn_rad_s: float = 0.0
    usual_speed_m_s: float = 1.0
    floor_m: float = 0.0
    """Height of its origin when it rests on the ground, m."""

    @property
    def duration_s(self) -> float:
        """Sum of its pieces."""
        return self._knots[-1].time_s

    @cached_property
    def _knots(self) -> list[_Knot]:
        rates = (self.initial_speed_m_s, self.initial_turn_rad_s, 0.0, 0.0)
        knot = _Knot(0.0, self.start, self.yaw, 0.0, rates)
        knots = [knot]
        for piece in self.pieces:
            knot = self._advance(knot, piece, piece.duration_s)
            knots.append(knot)
        return knots

    def at(self, time_s: float) -> BodyState:
        """State at that instant."""
        knot, piece, elapsed = self._find(time_s)
        now = self._advance(knot, piece, elapsed)
        speed, _, climb, pitch = now.rates
        (x, y, height), act_s = now.place, None
        if piece.hop_m > 0.0 and 0.0 <= elapsed <= piece.duration_s:
            hop, act_s = _hop(piece, elapsed)
            height += hop
        slow = 0.3 * max(self.usual_speed_m_s, 0.1)
        pitch -= math.atan(climb * abs(speed) / (speed**2 + slow**2))
        return BodyState(
            (x, y, height),
            now.heading,
            pitch,
            distance_m=now.distance_m,
            speed_m_s=abs(speed),
            activity=piece.activity,
            act_s=act_s,
        )

    def _find(self, time_s: float) -> tuple[_Knot, Piece, float]:
        """The piece that holds an instant: its beginning, itself, and time in it."""
        knots = self._knots
        if time_s < 0.0:
            speed = self.initial_speed_m_s
            steady = Piece(1.0, speed, activity=self.pieces[0].activity)
            return knots[0]._replace(rates=(speed, 0.0, 0.0, 0.0)), steady, time_s
        for number, piece in enumerate(self.pieces):
            if time_s < knots[number + 1].time_s or number == len(self.pieces) - 1:
                return knots[number], piece, time_s - knots[number].time_s
        raise AssertionError("a path has at least one piece")

    def _advance(self, knot: _Knot, piece: Piece, elapsed: float) -> _Knot:
        """Values that long after the beginning of a piece."""
        ramp = min(piece.ramp_s, piece.duration_s)
        pairs = list(zip(knot.rates, piece.rates, strict=True))
        travelled, turned, risen, _ = (_integral(*pair, ramp, elapsed) for pair in pairs)
        speed, turn, climb, pitch = (_blend(*pair, ramp, elapsed) for pair in pairs)
        x, y = _travel(knot, piece, ramp, elapsed)
        z = knot.place[2] + risen
        if piece.is_dropped:
            drop = max(knot.place[2] - self.floor_m, 0.0)
            z = self.floor_m + bounce_height(drop, 0.0, _RESTITUTION, max(elapsed, 0.0))
        return _Knot(
            knot.time_s + elapsed, (x, y, max(z, self.floor_m)), knot.heading + turned,
            knot.distance_m + travelled, (speed, turn, climb, pitch),
        )  # fmt: skip


def steady(
    start: Vector, yaw: float, speed_m_s: float, *, turn_rad_s: float = 0.0, climb: float = 0.0,
    activity: str = "move",
) -> SteeredPath:  # fmt: skip
    """A straight line or a circle at constant speed; `climb` is metres up per metre along."""
    piece = Piece(1.0, speed_m_s, turn_rad_s, climb * speed_m_s, ramp_s=0.0, activity=activity)
    return SteeredPath(start, yaw, (piece,), speed_m_s, turn_rad_s, 0.0, -math.inf)


def _blend(before: float, after: float, ramp: float, elapsed: float) -> float:
    if elapsed >= ramp:
        return after
    u = max(elapsed, 0.0) / ramp
    return before + (after - before) * u * u * (3.0 - 2.0 * u)


def _integral(before: float, after: float, ramp: float, elapsed: float) -> float:
    """Integral of `_blend` from 0 to `elapsed`; before 0 the value is `before`."""
    if elapsed < 0.0 or ramp <= 0.0:
        return (before if elapsed < 0.0 else after) * elapsed
    u = min(elapsed / ramp, 1.0)
    eased = ramp * (u * u * u - 0.5 * u**4)
    return before * u * ramp + (after - before) * eased + after * max(elapsed - ramp, 0.0)


def _travel(knot: _Knot, piece: Piece, ramp: float, elapsed: float) -> tuple[float, float]:
    """X and y that long after the beginning of a piece, m."""
    (x, y, _), heading, (speed, turn, *_) = knot.place, knot.heading, knot.rates
    if elapsed < 0.0 or turn == 0.0 == piece.turn_rad_s:
        travelled = _integral(speed, piece.speed_m_s, ramp, elapsed)
        return x + travelled * math.cos(heading), y + travelled * math.sin(heading)
    edges = [0.0, min(elapsed, ramp), elapsed]
    most = max(abs(turn), abs(piece.turn_rad_s))
    for begin, end in pairwise(edges):
        steps = max(1, math.ceil(most * (end - begin) / _RADIANS_PER_STEP))
        half = 0.5 * (end - begin) / steps
        times = begin + half * (2.0 * np.arange(steps)[:, None] + 1.0 + _NODES)
        u = np.minimum(times / max(ramp, 1e-9), 1.0)
        speeds = speed + (piece.speed_m_s - speed) * u * u * (3.0 - 2.0 * u)
        eased = (piece.turn_rad_s - turn) * (u**3 - 0.5 * u**4)
        headings = heading + ramp * (turn * u + eased) + piece.turn_rad_s * (times - ramp * u)
        x += half * float(np.sum(_WEIGHTS * speeds * np.cos(headings)))
        y += half * float(np.sum(_WEIGHTS * speeds * np.sin(headings)))
    return x, y


HOP_PAUSE_S = 0.12
"""Time on the ground between hops."""


def flight_s(height_m: float) -> float:
    """Duration of a hop of that height, s."""
    return 2.0 * math.sqrt(2.0 * height_m / GRAVITY_M_S2)


def _hop(piece: Piece, elapsed: float) -> tuple[float, float]:
    """Height above the ground, m, and time since the highest point, s.

    Hops of free flight fill the piece as often as they fit.
    """
    flight = flight_s(piece.hop_m)
    count = max(1, math.floor(piece.duration_s / (flight + HOP_PAUSE_S)))
    period = piece.duration_s / count
    flight = min(flight, period)
    into = min(elapsed % period, flight) if elapsed < piece.duration_s else flight
    return max(0.5 * GRAVITY_M_S2 * into * (flight - into), 0.0), into - 0.5 * flight


def arc(span: float, speed: float, angle: float, least_m: float) -> list[Piece]:
    """Turn by an angle, the rate rising and falling smoothly.

    Args:
        span: how long it takes, s.
        speed: along the heading, m/s.
        angle: positive = to the left, radians.
        least_m: least radius, m; a tighter turn is turned less far.
    """
    ramp = min(_RAMP_S, 0.3 * span)
    turn = angle / (span - ramp)
    if least_m > 0.0 and speed != 0.0:
        turn = math.copysign(min(abs(turn), abs(speed) / least_m), turn)
    return [
        Piece(span - ramp, speed, turn, ramp_s=ramp),
        Piece(ramp, speed, 0.0, ramp_s=ramp),
    ]


def centred(path: SteeredPath, duration_s: float) -> SteeredPath:
    """The same path with its box over (0, 0)."""
    places = sample_places(path, duration_s)
    middle = 0.5 * (places.min(axis=0) + places.max(axis=0))
    return replace(path, start=(-float(middle[0]), -float(middle[1]), path.start[2]))


def sample_places(path: SteeredPath, duration_s: float) -> np.ndarray:
    """[n, 3] places along a path over the clip, m."""
    times = np.linspace(0.0, duration_s, _SAMPLES)
    return np.array([path.at(float(time)).position for time in times])
