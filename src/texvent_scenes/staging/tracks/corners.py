"""Corners of a path: where one leg ends and the next begins at a stated time.

A body turns as long before that time as after it, and as fast as takes it to where legs with a
sharp corner end: each leg is its speed times its duration long, along its own direction.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.staging.tracks.keys import Key, Knot, advance

_USUAL_S, _RAMP = 0.4, 0.35
"""Duration of a turn of a body that is not steered, s; share of it that its rate takes to rise."""
_MOST, _LEAST_DEG, _SHARE = 3.0, 3.0, 0.9
"""Most speed in a corner, as a multiple of that of the legs; least turn; and the most of a leg that
a corner takes."""
_REVERSAL_S, _LEAST_S, _BEFORE = 0.8, 0.05, 1.2
"""Duration of a turn on the spot; least duration of a change, s; and its most, as a multiple of the
time in which the speed before holds."""


def corner(before: Key, last: Key, turn_rad: float, span_s: float, least_m: float) -> list[Key]:
    """Keys from the end of one leg into the next, the first of them the shortened leg before.

    Args:
        before: last key of the leg before, straight, its speed reached.
        last: the next leg, straight.
        turn_rad: angle between them, positive = to the left.
        span_s: duration of the next leg, s.
        least_m: least radius of its turns, m.

    Returns:
        Nothing where there is no room for the turn, or none is needed.
    """
    speeds = before.speed_m_s, last.speed_m_s
    if min(speeds) <= 0.0 or abs(turn_rad) < math.radians(_LEAST_DEG):
        return []
    if abs(turn_rad) > math.radians(180.0 - _LEAST_DEG):
        return [] if least_m else _reverse(before, last, turn_rad, span_s)
    room_s = 2.0 * _SHARE * min(before.duration_s - before.ramp_s, span_s)
    tight_s = abs(turn_rad) * least_m / (min(speeds) * (1.0 - _RAMP))
    whole_s = max(min(_USUAL_S, room_s), tight_s)
    if whole_s > room_s:
        return []
    keys = _solve(whole_s, turn_rad, speeds)
    if not keys:
        return []
    straight = replace(last, duration_s=span_s - 0.5 * whole_s, ramp_s=0.0, turn_rad_s=0.0)
    turning = [replace(one, activity=last.activity) for one in keys]
    shorter = replace(before, duration_s=before.duration_s - 0.5 * whole_s)
    return [shorter, *turning, straight]


def _reverse(before: Key, last: Key, turn_rad: float, span_s: float) -> list[Key]:
    """Keys of a turn on the spot before the way back, at rest about the stated time."""
    room_s = _SHARE * min(before.duration_s - before.ramp_s, span_s)
    whole_s = min(_REVERSAL_S, room_s)
    if whole_s < _LEAST_S:
        return []
    easing_s, turning_s = 0.3 * whole_s, 0.4 * whole_s
    one, other = before.speed_m_s, last.speed_m_s
    early_s = 0.5 * easing_s + (easing_s + turning_s) * other / (one + other)
    rest = Key(easing_s, ramp_s=easing_s, activity=last.activity)
    half = replace(rest, duration_s=0.5 * turning_s, ramp_s=0.5 * turning_s)
    return [
        replace(before, duration_s=before.duration_s - early_s),
        rest,
        replace(half, turn_rad_s=2.0 * turn_rad / turning_s),
        half,
        replace(rest, speed_m_s=other),
        replace(last, duration_s=span_s - (whole_s - early_s), ramp_s=0.0, turn_rad_s=0.0),
    ]


def centre_change(
    last: Sequence[Key], key: Key, *, is_act: bool, is_spin: bool
) -> tuple[list[Key], Key]:
    """The last keys and the next one, half of whose change of speed comes before its time.

    So a body is where legs without easing end: what starts or stops at a time and a place that
    are told has gone as far as if it did so at once.

    Args:
        last: one or two keys, of which the last is shortened.
        key: the next one, on a straight line too.
        is_act: whether something is done in it that begins at its time, when half of the speed is
            gone.
        is_spin: whether one of them turns on the spot all along.
    """
    *before, one = last
    is_plain = all(
        not ((each.turn_rad_s and not is_spin) or each.hop_m or each.swing_hz)
        and each.restitution is None
        for each in (one, key)
    )
    is_plain &= not (is_spin and (one.speed_m_s or key.speed_m_s))
    if one.rates == key.rates or not is_plain or one.pitch_rad != key.pitch_rad:
        return [*last], key
    is_even = bool(before) and before[-1].rates == one.rates
    room_s = one.duration_s if is_even else one.duration_s - one.ramp_s
    ramp_s = min(key.ramp_s, _BEFORE * room_s, key.duration_s)
    if ramp_s < min(_LEAST_S, key.ramp_s):
        return [*last], key
    shorter = replace(one, duration_s=one.duration_s - 0.5 * ramp_s)
    if key.speed_m_s or key.climb_m_s or not is_act:
        longer = replace(key, duration_s=key.duration_s + 0.5 * ramp_s, ramp_s=ramp_s)
        return [*before, shorter], longer
    half_s, rates = 0.5 * ramp_s, (one.speed_m_s, one.turn_rad_s, one.climb_m_s)
    speed, turn, climb = (0.5 * rate for rate in rates)
    half = replace(one, duration_s=half_s, ramp_s=half_s, speed_m_s=speed, turn_rad_s=turn,
                   climb_m_s=climb)  # fmt: skip
    return [*before, shorter, half], replace(key, ramp_s=half_s)


def _solve(whole_s: float, turn_rad: float, speeds: tuple[float, float]) -> list[Key]:
    """The turn at the speeds that end where a sharp corner would."""
    ramp_s = _RAMP * whole_s
    rate = turn_rad / (whole_s - ramp_s)

    def build(first: float, second: float) -> list[Key]:
        half_s = 0.5 * whole_s
        return [
            Key(half_s, first, rate, ramp_s=ramp_s),
            Key(half_s - ramp_s, second, rate, ramp_s=half_s - ramp_s),
            Key(ramp_s, speeds[1], 0.0, ramp_s=ramp_s),
        ]

    def end(first: float, second: float) -> np.ndarray:
        knot = Knot(0.0, (0.0, 0.0, 0.0), 0.0, 0.0, (speeds[0], 0.0, 0.0, 0.0))
        for key in build(first, second):
            knot = advance(knot, key, key.duration_s, -math.inf)
        return np.array(knot.place[:2])

    along = np.array([math.cos(turn_rad), math.sin(turn_rad)])
    wanted = 0.5 * whole_s * (speeds[0] * np.array([1.0, 0.0]) + speeds[1] * along)
    none = end(0.0, 0.0)
    effects = np.column_stack([end(1.0, 0.0) - none, end(0.0, 1.0) - none])
    first, second = map(float, np.linalg.solve(effects, wanted - none))
    if not 0.0 < min(first, second) <= max(first, second) < _MOST * max(speeds):
        return []
    return build(first, second)
