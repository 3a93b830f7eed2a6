"""Bends of what steers, as pieces of a path: an arc, a zigzag, into a parking bay."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.staging.trajectories.steered_path import Piece, SteeredPath

QUARTER = 0.5 * math.pi
ZIGZAG_RAD = 0.55
_RAMP_S = 0.3
_SAMPLES = 41


def arc(span: float, speed: float, angle: float, least_m: float, activity: str) -> list[Piece]:
    """Turn by an angle, the rate rising and falling smoothly.

    Args:
        span: how long it takes, s.
        speed: along the heading, m/s.
        angle: positive = to the left, radians.
        least_m: least radius, m; a tighter turn is turned less far.
        activity: `Piece.activity`.
    """
    ramp = min(_RAMP_S, 0.3 * span)
    turn = angle / (span - ramp)
    if least_m > 0.0 and speed != 0.0:
        turn = math.copysign(min(abs(turn), abs(speed) / least_m), turn)
    return [
        Piece(span - ramp, speed, turn, ramp_s=ramp, activity=activity),
        Piece(ramp, speed, 0.0, ramp_s=ramp, activity=activity),
    ]


def zigzag(span: float, speed: float, activity: str, *, is_first: bool) -> list[Piece]:
    """Bends to the left and right in turn; one that comes first begins turned to the right."""
    count = max(2, round(span / 0.8))
    half = 0.5 * span / count
    pieces = []
    for number in range(count):
        is_single = number == 0 and not is_first
        swing = (-1.0) ** number * ZIGZAG_RAD * (1.0 if is_single else 2.0)
        pieces.append(Piece(half, speed, swing / half, ramp_s=half, activity=activity))
        pieces.append(Piece(half, speed, 0.0, ramp_s=half, activity=activity))
    return pieces


def park(span: float, speed: float, angle: float, least_m: float, activity: str) -> list[Piece]:
    """Along, round into a bay at its side, and to rest."""
    along = Piece(0.2 * span, speed, activity=activity)
    into = Piece(0.35 * span, 0.0, ramp_s=0.3 * span, activity=activity)
    return [along, *arc(0.45 * span, speed, angle, least_m, activity), into]


def bend_path(yaw: float, speed_m_s: float, curvature: float, duration_s: float) -> SteeredPath:
    """A path along an arc at a steady speed, its box centred over (0, 0); curvature in 1/m."""
    turn = speed_m_s * curvature
    yaw -= 0.5 * turn * duration_s
    piece = Piece(duration_s, speed_m_s, turn, ramp_s=0.0)
    path = SteeredPath((0.0, 0.0, 0.0), yaw, (piece,), speed_m_s, turn)
    return centred(path, duration_s)


def centred(path: SteeredPath, duration_s: float) -> SteeredPath:
    """The same path with its box over (0, 0)."""
    places = sample_places(path, duration_s)
    middle = 0.5 * (places.min(axis=0) + places.max(axis=0))
    return replace(path, start=(-float(middle[0]), -float(middle[1]), path.start[2]))


def sample_places(path: SteeredPath, duration_s: float) -> np.ndarray:
    """[n, 3] places along a path over the clip, m."""
    times = np.linspace(0.0, duration_s, _SAMPLES)
    return np.array([path.at(float(time)).position for time in times])
