"""How hands move at a thing: strokes, blows, twists and the like, as functions of time.

Offsets are in the axes of the surface that is worked on: along it away from the worker (a level
surface) or up (an upright one), along it to the left, and out of it; metres for an adult.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from texvent.scenes.models.people.timing import ease, pulse, swing
from texvent.scenes.models.shapes import Point

RATE_HZ = 0.9
"""Strokes per second: each is seen in several of a few stills."""


@dataclass(frozen=True)
class Stroke:
    """Where hands and tool are at one instant, from the spot that is worked on."""

    right: Point
    """Tip of the tool, or the right palm."""
    left: Point | None = (0.0, 0.20, 0.02)
    """Left palm; None = it hangs."""
    tool: Point = (0.75, 0.0, -0.65)
    """Direction from the right palm to the tip of the tool."""
    thing: Point = (0.0, 0.0, 0.0)
    """How far the thing has been moved."""
    bow: float = 0.0
    """How much further the body leans, radians."""


Pattern = Callable[[float, float], Stroke]
"""Time, s, and half of the thing's width, m → the hands."""


def _slice(t: float, half: float) -> Stroke:
    up = pulse(t, 1.3)
    return Stroke(
        (0.02 + 0.06 * up, -0.02 - 0.05 * swing(t, 0.4), 0.24 * up),
        (0.02, 0.10, 0.03),
        (0.92, 0.1, -0.25 + 0.75 * up),
    )


def _peel(t: float, half: float) -> Stroke:
    along = swing(t, RATE_HZ)
    return Stroke((0.12 * along, -0.02, 0.02), (-0.02, 0.03, -0.03), (0.2, 0.85, 0.1))


def _snip(t: float, half: float) -> Stroke:
    up = pulse(t, 1.2)
    return Stroke((0.05 * swing(t, 0.5), -0.02, 0.09 * up), (0.0, 0.12, 0.02), (0.8, 0.3, -0.3))


def _saw(t: float, half: float) -> Stroke:
    along = swing(t, 1.1)
    return Stroke((0.10 + 0.15 * along, 0.0, 0.0), (0.08, 0.18, 0.02), (0.95, 0.0, -0.30))


def _strike(t: float, half: float) -> Stroke:
    share = (t * 1.1) % 1.0
    up = ease(share, 0.0, 0.55) - ease(share, 0.60, 0.80)
    return Stroke(
        (-0.20 * up, -0.06 * up, 0.48 * up),
        (-0.05, 0.24, 0.02),
        (0.85 - 1.05 * up, 0.0, -0.35 + 1.25 * up),
        bow=-0.12 * up,
    )


def _chop(t: float, half: float) -> Stroke:
    share = (t * 0.8) % 1.0
    up = ease(share, 0.0, 0.55) - ease(share, 0.60, 0.80)
    tool = (0.80 - 1.1 * up, 0.0, -0.50 + 1.4 * up)
    grip = (-0.62 * (0.80 - 1.1 * up) - 0.12, 0.08, 0.40 + 0.15 * up)
    return Stroke((-0.35 * up, 0.0, 0.70 * up), grip, tool, bow=-0.25 * up)


def _rub(t: float, half: float) -> Stroke:
    return Stroke(
        (0.10 * swing(t, RATE_HZ), -0.02 + 0.15 * swing(t, RATE_HZ, 0.22), 0.0), (-0.06, 0.24, 0.02)
    )


def _stroke(t: float, half: float) -> Stroke:
    share = (t * RATE_HZ) % 1.0
    forth = ease(share, 0.0, 0.6) - ease(share, 0.6, 1.0)
    lift = 0.10 * math.sin(math.pi * max(share - 0.6, 0.0) / 0.4) ** 2
    return Stroke((0.15 - 0.32 * forth, -0.02, lift), (-0.02, 0.20, 0.02), (0.55, 0.1, -0.8))


def _scribble(t: float, half: float) -> Stroke:
    return Stroke(
        (0.08 * swing(t, 1.2), 0.17 * swing(t, 0.45), 0.0), (-0.05, 0.24, 0.01), (0.35, 0.25, -0.9)
    )


def _pluck(t: float, half: float) -> Stroke:
    out = pulse(t, RATE_HZ)
    return Stroke(
        (-0.06 * out, -0.03 - 0.24 * out, 0.04 + 0.20 * out), (0.0, 0.06, -0.03), (0.3, 0.7, -0.3)
    )


def _knit(t: float, half: float) -> Stroke:
    """Both hands close before the body; the needles go up and down against each other."""
    go = swing(t, 1.3)
    return Stroke(
        (-0.02, -0.09 + 0.02 * go, 0.07 + 0.05 * go), (-0.02, 0.09 - 0.02 * go, 0.05 - 0.05 * go),
        (0.25, 0.75, 0.35 + 0.25 * go),
    )  # fmt: skip


def _tie(t: float, half: float) -> Stroke:
    apart, up = pulse(t, RATE_HZ), 0.18 * pulse(t, RATE_HZ, 0.2)
    return Stroke((-0.02, -0.03 - 0.18 * apart, 0.02 + up), (-0.02, 0.03 + 0.18 * apart, 0.02 + up))


def _twist(t: float, half: float) -> Stroke:
    angle = 1.1 * swing(t, 0.8)
    return Stroke((0.0, -0.03, 0.02), (0.02, 0.10, 0.01), (math.cos(angle), math.sin(angle), -0.2))


def _squeeze(t: float, half: float) -> Stroke:
    """Both hands press from the sides, lift it a little and wring it."""
    press, turn = pulse(t, RATE_HZ), 0.05 * swing(t, RATE_HZ)
    side, up = min(half, 0.12) + 0.06 - 0.06 * press, -0.03 + 0.10 * press
    thing = (0.0, 0.0, 0.10 * press)
    return Stroke((turn, -side, up), (-turn, side, up), thing=thing, bow=-0.04 * press)


def _reel(t: float, half: float) -> Stroke:
    """The hands go round each other."""
    angle = 2.0 * math.pi * 0.9 * t
    x, z = 0.08 * math.cos(angle), 0.08 * math.sin(angle)
    return Stroke((x, -0.09, 0.10 + z), (-x, 0.09, 0.10 - z))


def _uncork(t: float, half: float) -> Stroke:
    """Turns the screw, then pulls the cork up, again and again; the left hand is at the neck."""
    share = (t * 0.55) % 1.0
    up = 0.17 * (ease(share, 0.45, 0.75) - ease(share, 0.9, 1.0))
    turn = 0.03 * math.sin(2.0 * math.pi * 5.0 * min(share, 0.4) / 0.4)
    return Stroke((0.0, turn, up), (-0.02, 0.05, -0.10), (0.0, 0.0, -1.0), bow=-0.3 * up)


def _unlock(t: float, half: float) -> Stroke:
    """The key comes to the lock and turns to and fro in it."""
    away = 0.16 * (1.0 - ease(t, 0.1, 0.5))
    angle = 0.9 * swing(max(t - 0.5, 0.0), 1.1)
    return Stroke(
        (0.05 * math.sin(angle), 0.05 * (1.0 - math.cos(angle)), away), None, (0.0, 0.12, -1.0)
    )


def _drill(t: float, half: float) -> Stroke:
    return Stroke(
        (0.0, -0.03, 0.13 * pulse(t, RATE_HZ)),
        (0.02, 0.05, 0.20),
        (0.05, 0.0, -1.0),
        bow=-0.12 * pulse(t, RATE_HZ),
    )


def _hold(t: float, half: float) -> Stroke:
    return Stroke(
        (0.07 * swing(t, 0.4), 0.09 * swing(t, 0.5), 0.05), (-0.04, 0.20, 0.02), (0.6, 0.2, -0.75)
    )


def _dab(t: float, half: float) -> Stroke:
    up = pulse(t, RATE_HZ)
    return Stroke(
        (-0.02, -0.02 + 0.08 * swing(t, 0.25), 0.16 * up), (-0.04, 0.18, 0.02), (0.25, 0.1, -1.0)
    )


def _knock(t: float, half: float) -> Stroke:
    return Stroke((0.0, -0.03, 0.16 * pulse(t, 1.6)), None)


def _press(t: float, half: float) -> Stroke:
    push = pulse(t, RATE_HZ)
    return Stroke(
        (-0.06 + 0.14 * push, -0.08, 0.09 - 0.09 * push),
        (-0.06 + 0.14 * push, 0.08, 0.09 - 0.09 * push),
        bow=0.14 * push,
    )


def _mould(t: float, half: float) -> Stroke:
    side, up = min(half, 0.22), -0.10 + 0.10 * swing(t, 0.7)
    side = side * (0.85 + 0.15 * swing(t, 0.7, 0.3)) + 0.03
    return Stroke((0.04, -side, up), (0.04, side, up))


def _fold(t: float, half: float) -> Stroke:
    over, up = swing(t, 0.7), pulse(t, 1.4, 0.25)
    return Stroke((0.02, -0.05 - 0.15 * over, 0.16 * up), (0.02, 0.20, 0.01))


def _stir(t: float, half: float) -> Stroke:
    angle = 2.0 * math.pi * t
    radius = min(max(0.5 * half, 0.05), 0.11)
    return Stroke(
        (radius * math.cos(angle), radius * math.sin(angle), 0.0),
        (-0.02, half + 0.04, 0.0),
        (0.25 + 0.2 * math.cos(angle), 0.2 * math.sin(angle), -0.9),
    )


def _sprinkle(t: float, half: float) -> Stroke:
    return Stroke(
        (0.08 * swing(t, 1.6), 0.08 * swing(t, 0.4), 0.22 + 0.05 * swing(t, 1.6)),
        (-0.06, 0.24, 0.02),
        (0.2, 0.1, -1.0),
    )


def _pour(t: float, half: float) -> Stroke:
    tip = ease(t, 0.2, 0.9) - ease(t, 1.7, 2.4)
    return Stroke(
        (0.0, 0.0, 0.24), (-0.02, half + 0.05, 0.02), (0.35 + 0.65 * tip, 0.1, 0.9 - 1.5 * tip)
    )


def _water(t: float, half: float) -> Stroke:
    """With one hand and from higher than `_pour`: plants are lower than a table."""
    tip = ease(t, 0.2, 0.9) - ease(t, 1.7, 2.4)
    return Stroke((0.0, 0.0, 0.42), None, (1.0, 0.1, 0.35 - 0.95 * tip))


def _lift(t: float, half: float) -> Stroke:
    up = 0.55 * (ease(t % 2.4, 0.15, 1.1) - ease(t % 2.4, 1.5, 2.35))
    side = min(half, 0.36) + 0.02
    return Stroke(
        (0.05, -side, up - 0.05), (0.05, side, up - 0.05), thing=(0.0, 0.0, up), bow=-0.45 * up
    )


_HELD: Point = (-0.24, 0.0, 0.36)
"""Where what is put down comes from and what is picked up goes to, before the chest."""


def _carried(t: float, half: float, share: float, hold: float) -> Stroke:
    """Both hands at a thing that is `share` of the way to the chest; at `hold` 0 they let go."""
    thing = (share * _HELD[0], 0.0, share * _HELD[2])
    side = min(0.85 * half, 0.36) + 0.14 * (1.0 - hold)
    back = -0.22 * (1.0 - hold)
    return Stroke(
        (thing[0] + back, -side, thing[2] - 0.05 + 0.16 * (1.0 - hold)),
        (thing[0] + back, side, thing[2] - 0.05 + 0.16 * (1.0 - hold)),
        thing=thing,
        bow=-0.30 * share,
    )


def _put(t: float, half: float) -> Stroke:
    """From the chest down to its place, once; the hands leave it there."""
    return _carried(t, half, 1.0 - ease(t, 0.3, 1.1), 1.0 - ease(t, 1.2, 1.6))


def _take(t: float, half: float) -> Stroke:
    """The hands come to it and lift it to the chest, once."""
    return _carried(t, half, ease(t, 0.6, 1.5), ease(t, 0.0, 0.5))


_DROPPED_S, _DROP_M = 0.55, 0.62
"""When a thing is let go, and from how high, m."""


def _drop(t: float, half: float) -> Stroke:
    """The hands hold it up and open; it falls freely."""
    fallen = 4.905 * max(t - _DROPPED_S, 0.0) ** 2
    side = min(0.85 * half, 0.36) + 0.16 * ease(t, _DROPPED_S - 0.05, _DROPPED_S + 0.1)
    return Stroke(
        (0.0, -side, _DROP_M - 0.05), (0.0, side, _DROP_M - 0.05),
        thing=(0.0, 0.0, max(_DROP_M - fallen, 0.0)),
        bow=-0.30,
    )  # fmt: skip


def _punch(t: float, half: float) -> Stroke:
    """Left and right in turn, from a guard to the face of the thing."""

    def fist(phase: float) -> float:
        return 0.34 * (1.0 - pulse(t, 1.2, phase) ** 2)

    return Stroke((0.0, -0.07, fist(0.0)), (0.0, 0.07, fist(0.5)), bow=0.06)


def _jab(t: float, half: float) -> Stroke:
    """The right fist again and again, the left one on guard."""
    out = pulse(t, 1.2) ** 2
    return Stroke(
        (0.0, -0.05, 0.36 * (1.0 - out) - 0.04), (0.02, 0.12, 0.36), bow=0.04 + 0.06 * out
    )


def _tug(t: float, half: float) -> Stroke:
    back = pulse(t, RATE_HZ)
    return Stroke(
        (-0.16 * back, -0.05, 0.0),
        (-0.16 * back, 0.05, 0.0),
        bow=-0.30 * back,
        thing=(-0.05 * back, 0.0, 0.0),
    )


def _rock(t: float, half: float) -> Stroke:
    move = (0.0, 0.03 * swing(t, 1.4), 0.09 * swing(t, 1.4))
    side = min(half, 0.36) + 0.02
    return Stroke((0.0, move[1] - side, move[2]), (0.0, move[1] + side, move[2]), thing=move)


def _offer(t: float, half: float) -> Stroke:
    near = pulse(t, 0.6)
    return Stroke((-0.20 + 0.20 * near, -0.03, 0.03), None, (0.9, 0.0, 0.1))


def _reach(t: float, half: float) -> Stroke:
    there = pulse(t, 0.6)
    return Stroke((-0.32 + 0.32 * there, -0.04, 0.03 - 0.10 * (1.0 - there)), (-0.34, 0.20, -0.15))


def _dig(t: float, half: float) -> Stroke:
    up = pulse(t, RATE_HZ)
    return Stroke(
        (-0.05 * up, -0.03, 0.14 * up), (-0.06, 0.20, 0.0), (0.5 + 0.4 * up, 0.0, -0.85 + 0.6 * up)
    )


def _spray(t: float, half: float) -> Stroke:
    return Stroke((0.12 * swing(t, 0.6), 0.18 * swing(t, 0.8), 0.16), None, (0.1, 0.0, -1.0))


PATTERNS: Mapping[str, Pattern] = MappingProxyType(
    {
        "slice": _slice,
        "peel": _peel,
        "snip": _snip,
        "saw": _saw,
        "strike": _strike,
        "chop": _chop,
        "rub": _rub,
        "stroke": _stroke,
        "scribble": _scribble,
        "pluck": _pluck,
        "knit": _knit,
        "tie": _tie,
        "twist": _twist,
        "squeeze": _squeeze,
        "reel": _reel,
        "uncork": _uncork,
        "unlock": _unlock,
        "drill": _drill,
        "hold": _hold,
        "dab": _dab,
        "knock": _knock,
        "press": _press,
        "mould": _mould,
        "fold": _fold,
        "stir": _stir,
        "sprinkle": _sprinkle,
        "pour": _pour,
        "water": _water,
        "lift": _lift,
        "put": _put,
        "take": _take,
        "drop": _drop,
        "punch": _punch,
        "jab": _jab,
        "tug": _tug,
        "rock": _rock,
        "offer": _offer,
        "reach": _reach,
        "dig": _dig,
        "spray": _spray,
    }
)
"""Name → how hands move."""

POURED_S = (0.65, 2.0)
"""From when to when a vessel is tipped so far that something flows, s."""

BLOWS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"strike": (0.8 / 1.1, 1.0 / 1.1), "jab": (0.5 / 1.2, 1.0 / 1.2)}
)
"""Pattern → when its first blow lands, and how long it is from blow to blow, s."""
