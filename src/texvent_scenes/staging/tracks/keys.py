"""Keys of a track: rates that a body reaches, and its place after each of them.

Each key ends at a speed, a rate of turning and a rate of climbing. Within it these three change
smoothly (3u² - 2u³) from the values that the last key ended with and stay there, so position,
heading and speed are continuous. Heading, height and distance follow in closed form; the position
is the integral of the velocity, in closed form on straight lines and by Gauss-Legendre quadrature
in bends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

Vector = tuple[float, float, float]
GRAVITY_M_S2 = 9.81
RAMP_S = 0.3
"""Time to reach a speed, s."""
HOP_PAUSE_S = 0.12
"""Time on the ground between hops."""
_TURNING = 0.4
"""Share of its greatest speed below which who goes to and fro turns round."""
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_RADIANS_PER_STEP = 1.0
"""Most heading that one step of the quadrature spans."""


@dataclass(frozen=True)
class Key:
    """One stretch of a track, and the rates at its end."""

    duration_s: float
    speed_m_s: float = 0.0
    """Along the heading; negative = backwards."""
    turn_rad_s: float = 0.0
    """Rate of the heading; positive = to the left."""
    climb_m_s: float = 0.0
    """Rate of the height; of a body in free flight at its beginning."""
    ramp_s: float = 0.3
    """Duration of the change to these values; at most the whole key."""
    activity: str = "move"
    hop_m: float = 0.0
    """Height of hops; 0 = none."""
    restitution: float | None = None
    """Share of the upward speed that each bounce of a body in free flight keeps; None = no flight.
    """
    pitch_rad: float = 0.0
    """Pitch of the body, as of a person who falls over."""
    swing_hz: float = 0.0
    """Rate at which it goes to and fro, its speeds the greatest; 0 = it goes on."""

    @property
    def rates(self) -> tuple[float, float, float, float]:
        """Speed, rate of turning, rate of climbing; and pitch, which changes as they do."""
        climb = self.climb_m_s if self.restitution is None else 0.0
        return (self.speed_m_s, self.turn_rad_s, climb, self.pitch_rad)


class Knot(NamedTuple):
    """Values at the beginning of a key."""

    time_s: float
    place: Vector
    heading: float
    distance_m: float
    rates: tuple[float, float, float, float]


def ahead(home: Vector, yaw: float, along_m: float, height_m: float) -> Vector:
    """The point `along_m` from `home` along a heading, at a height, m."""
    x, y, _ = home
    return (x + along_m * math.cos(yaw), y + along_m * math.sin(yaw), height_m)


def advance(knot: Knot, key: Key, elapsed: float, floor_m: float) -> Knot:
    """Values that long after the beginning of a key."""
    if key.swing_hz:
        return _swing(knot, key, elapsed)
    ramp = min(key.ramp_s, key.duration_s)
    pairs = list(zip(knot.rates, key.rates, strict=True))
    travelled, turned, risen, _ = (_integral(*pair, ramp, elapsed) for pair in pairs)
    speed, turn, climb, pitch = (_blend(*pair, ramp, elapsed) for pair in pairs)
    x, y = _travel(knot, key, ramp, elapsed)
    z = knot.place[2] + risen
    if key.restitution is not None:
        drop = max(knot.place[2] - floor_m, 0.0)
        flown_s = max(elapsed, 0.0)
        z = floor_m + bounce_height(drop, key.climb_m_s, key.restitution, flown_s)
    way = math.hypot(travelled, risen) if key.activity == "climb" else travelled
    return Knot(
        knot.time_s + elapsed, (x, y, max(z, floor_m)), knot.heading + turned,
        knot.distance_m + way, (speed, turn, climb, pitch),
    )  # fmt: skip


def _blend(before: float, after: float, ramp: float, elapsed: float) -> float:
    if elapsed >= ramp or elapsed < 0.0:
        return before if elapsed < 0.0 else after
    u = elapsed / ramp
    return before + (after - before) * u * u * (3.0 - 2.0 * u)


def _integral(before: float, after: float, ramp: float, elapsed: float) -> float:
    """Integral of `_blend` from 0 to `elapsed`; before 0 the value is `before`."""
    if elapsed < 0.0 or ramp <= 0.0:
        return (before if elapsed < 0.0 else after) * elapsed
    u = min(elapsed / ramp, 1.0)
    eased = ramp * (u * u * u - 0.5 * u**4)
    return before * u * ramp + (after - before) * eased + after * max(elapsed - ramp, 0.0)


def _travel(knot: Knot, key: Key, ramp: float, elapsed: float) -> tuple[float, float]:
    """X and y that long after the beginning of a key, m."""
    (x, y, _), heading, (speed, turn, *_) = knot.place, knot.heading, knot.rates
    if elapsed < 0.0 or turn == 0.0 == key.turn_rad_s:
        travelled = _integral(speed, key.speed_m_s, ramp, elapsed)
        return x + travelled * math.cos(heading), y + travelled * math.sin(heading)
    edges = [0.0, min(elapsed, ramp), elapsed]
    most = max(abs(turn), abs(key.turn_rad_s))
    for begin, end in pairwise(edges):
        steps = max(1, math.ceil(most * (end - begin) / _RADIANS_PER_STEP))
        half = 0.5 * (end - begin) / steps
        times = begin + half * (2.0 * np.arange(steps)[:, None] + 1.0 + _NODES)
        u = np.minimum(times / max(ramp, 1e-9), 1.0)
        speeds = speed + (key.speed_m_s - speed) * u * u * (3.0 - 2.0 * u)
        eased = (key.turn_rad_s - turn) * (u**3 - 0.5 * u**4)
        headings = heading + ramp * (turn * u + eased) + key.turn_rad_s * (times - ramp * u)
        x += half * float(np.sum(_WEIGHTS * speeds * np.cos(headings)))
        y += half * float(np.sum(_WEIGHTS * speeds * np.sin(headings)))
    return x, y


def _swing(knot: Knot, key: Key, elapsed: float) -> Knot:
    """Values of what goes to and fro: a cosine of its speeds."""
    omega, (x, y, z) = 2.0 * math.pi * key.swing_hz, knot.place
    sine, cosine = math.sin(omega * elapsed), math.cos(omega * elapsed)
    # The distance covered is the integral of |cos|.
    halves = math.floor(omega * elapsed / math.pi + 0.5)
    covered = 2.0 * halves + (sine if halves % 2 == 0 else -sine)
    x, y, z = ahead((x, y, z), knot.heading, key.speed_m_s * sine / omega,
                    z + key.climb_m_s * sine / omega)  # fmt: skip
    total = math.hypot(key.speed_m_s, key.climb_m_s)
    rates = (total * cosine, 0.0, 0.0, 0.0)
    distance_m = knot.distance_m + total * covered / omega
    return Knot(knot.time_s + elapsed, (x, y, z), knot.heading, distance_m, rates)


def turn_round(key: Key, elapsed: float) -> float:
    """Turn of who walks or runs to and fro, towards where it goes."""
    if not key.swing_hz or key.activity not in ("walk", "run") or key.climb_m_s:
        return 0.0
    forth = math.cos(2.0 * math.pi * key.swing_hz * elapsed) / _TURNING
    return 0.5 * math.pi * (1.0 - math.sin(0.5 * math.pi * max(-1.0, min(1.0, forth))))


def flight_s(height_m: float) -> float:
    """Duration of a hop of that height, s."""
    return 2.0 * math.sqrt(2.0 * height_m / GRAVITY_M_S2)


def hop_of(key: Key, elapsed: float) -> tuple[float, float]:
    """Height above the ground, m, and time since the highest point, s.

    Hops of free flight fill the key as often as they fit.
    """
    flight = flight_s(key.hop_m)
    count = max(1, math.floor(key.duration_s / (flight + HOP_PAUSE_S)))
    period = key.duration_s / count
    flight = min(flight, period)
    into = min(elapsed % period, flight) if elapsed < key.duration_s else flight
    return max(0.5 * GRAVITY_M_S2 * into * (flight - into), 0.0), into - 0.5 * flight


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


def arc(span: float, speed: float, angle: float, least_m: float) -> list[Key]:
    """Turn by an angle, the rate rising and falling smoothly.

    Args:
        span: how long it takes, s.
        speed: along the heading, m/s.
        angle: positive = to the left, radians.
        least_m: least radius, m; a tighter turn is turned less far.
    """
    ramp = min(RAMP_S, 0.3 * span)
    turn = angle / (span - ramp)
    if least_m > 0.0 and speed != 0.0:
        turn = math.copysign(min(abs(turn), abs(speed) / least_m), turn)
    return [
        Key(span - ramp, speed, turn, ramp_s=ramp),
        Key(ramp, speed, 0.0, ramp_s=ramp),
    ]
