"""What hands do with one thing that comes along: an umbrella, a candle, binoculars, a keyboard."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise
from types import MappingProxyType

from texvent.scenes.models.materials import (
    BLUE,
    DARK,
    ORANGE,
    RED,
    STEEL,
    WHITE,
    WOOD,
    Material,
    glowing,
    striped,
)
from texvent.scenes.models.people.acts.music import SITTING, STOOL
from texvent.scenes.models.people.acts.play import build_basket
from texvent.scenes.models.people.acts.prop_shapes import Prop, stick, still
from texvent.scenes.models.people.daily import DAILY, SEAT
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import ANKLE, DOWN, HIP, OUT, Arm, Leg, Posture
from texvent.scenes.models.people.timing import ease, swing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, box, moved, rod, shift, spike

_GRAVITY_M_S2 = 9.81


def _conduct(t: float) -> Posture:
    """Both arms go out and in; the right one beats time with the baton."""
    beat, wide = 0.20 * swing(t, 1.1), 0.14 * swing(t, 0.55)
    return Posture(
        left=Arm((0.34, 0.08 + wide, 0.02 - 0.7 * beat), OUT),
        right=Arm((0.36, 0.06 + wide, 0.08 + beat), OUT), nod=0.06 * swing(t, 1.1),
        tool=(0.55, -0.15 + 0.5 * swing(t, 0.55), 0.75 + 0.8 * beat),
    )  # fmt: skip


def _look_through(t: float) -> Posture:
    """Both hands before the eyes; the body turns slowly from side to side."""
    arm = Arm((0.27, -0.13, 0.27), OUT)
    return Posture(left=arm, right=arm, turn=0.42 * swing(t, 0.45))


_OPENED_S = (0.35, 1.15)


def _open_umbrella(t: float) -> Posture:
    """The left hand pushes the slide up the stick."""
    share = ease(t, *_OPENED_S)
    return Posture(
        right=Arm((0.30, -0.10, -0.16 + 0.12 * share), DOWN),
        left=Arm((0.32, -0.22, 0.0 + 0.26 * share), OUT), nod=-0.12 * share,
        tool=(0.12, 0.0, 1.0),
    )  # fmt: skip


_OUT_S = 0.95
"""When a candle is out, s."""


def _blow_out(t: float) -> Posture:
    """Leans to the candle in the right hand."""
    near = ease(t, 0.3, 0.75) - ease(t, 1.3, 1.8)
    return Posture(right=Arm((0.42, -0.20, 0.02), DOWN), lean=0.24 * near, nod=0.10 * near,
                   tool=(0.0, 0.0, 1.0))  # fmt: skip


_WHEEL: Point = (0.50, 0.0, 0.92)
_WHEEL_M, _WHEEL_TILT = 0.20, 0.45
"""Radius of the wheel, and how far its top leans away, rad."""


def _on_wheel(angle: float, radius: float = _WHEEL_M) -> Point:
    """A place on a steering wheel: angle 0 is its left, pi/2 its top."""
    out, up = radius * math.cos(angle), radius * math.sin(angle)
    x, y, z = _WHEEL
    return (x + up * math.sin(_WHEEL_TILT), y + out, z + up * math.cos(_WHEEL_TILT))


def _turned(t: float) -> float:
    return 0.8 * swing(t, 0.5)


def _steer(t: float) -> Posture:
    """Seated, both hands on the rim, which turns to and fro."""
    left, right = (_on_wheel(start + _turned(t), _WHEEL_M + 0.01) for start in (0.25, 2.9))
    return Posture(
        hips=(0.0, 0.0, SEAT + 0.08), lean=0.05, left=Arm(left, DOWN, True),
        right=Arm((right[0], -right[1], right[2]), DOWN, True), left_leg=SITTING,
        right_leg=SITTING, tilt=-0.06 * _turned(t),
    )  # fmt: skip


_THROWN_S, _IN_S = 0.75, 1.5
"""When a ball leaves the hands, and when it is in the basket, s."""
_BASKET_M = 1.9
"""How much farther the basket of a shot is than that of a dunk, m."""
_HANDS: Point = (0.30, 0.0, 2.02)


def _shoot(t: float) -> Posture:
    """Bends the knees with the ball at the chest, stretches and lets it go above the head."""
    low = ease(t, 0.05, 0.40) - ease(t, 0.42, 0.75)
    up = ease(t, 0.35, _THROWN_S)
    hand = (0.30 - 0.04 * up, -0.12, -0.06 + 0.62 * up)
    leg = Leg((0.05, 0.10, ANKLE), (1.0, 0.1, 0.3))
    return Posture(hips=(0.0, 0.0, HIP - 0.02 - 0.16 * low), lean=0.15 * low, left=Arm(hand, OUT),
                   right=Arm(hand, OUT), left_leg=leg, right_leg=leg, nod=-0.15 * up)  # fmt: skip


EVERYDAY_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "conduct": _conduct,
        "look through binoculars": _look_through,
        "open umbrella": _open_umbrella,
        "blow out": _blow_out,
        "turn steering wheel": _steer,
        "type on keyboard": DAILY["type"],
        "shoot basket": _shoot,
    }
)
"""Activity with a thing → posture over time."""

_BATON = still(stick(WOOD, -0.07, 0.02, 0.014), stick(Material(WHITE), 0.02, 0.42, 0.009))
_BINOCULARS = still(
    *(part for y in (0.042, -0.042) for part in (
        rod(DARK, (0.01, y, 0.03), (0.16, y, 0.03), 0.034),
        rod(Material((0.25, 0.32, 0.40)), (0.16, y, 0.03), (0.166, y, 0.03), 0.030))),
    box(DARK, (0.08, 0.0, 0.03), (0.08, 0.05, 0.03)),
)  # fmt: skip


def _umbrella(t: float) -> list[ModelPart]:
    """A closed canopy about its stick that spreads."""
    share = ease(t, *_OPENED_S)
    wide, low = 0.05 + 0.52 * share, 0.20 + 0.46 * share
    tip: Point = (0.0, 0.0, 0.95)
    ribs = ((wide * math.cos(a), wide * math.sin(a), low) for a in (0.785 * k for k in range(8)))
    return [
        stick(DARK, -0.14, 0.98, 0.010),
        spike(striped(RED, (0.75, 0.75, 0.72), 2.0), (0.0, 0.0, low), tip, wide),
        *(rod(DARK, rib, tip, 0.006) for rib in ribs),
    ]


def _candle(t: float) -> list[ModelPart]:
    """A flame that bends away and goes out, and a thread of smoke."""
    size = max(1.0 - ease(t, _OUT_S - 0.15, _OUT_S), 0.01)
    away = 0.035 * ease(t, 0.6, _OUT_S)
    smoke = 0.01 + ease(t, _OUT_S, _OUT_S + 0.3)
    return [
        rod(Material(WHITE), (0.0, 0.0, -0.06), (0.0, 0.0, 0.16), 0.026),
        rod(DARK, (0.0, 0.0, 0.16), (0.0, 0.0, 0.18), 0.004),
        ball(glowing((1.0, 0.55, 0.12), 3.0), (away, 0.0, 0.18 + 0.045 * size),
             (0.045 * size, 0.045 * size, 0.11 * size)),
        ball(Material((0.55, 0.55, 0.55)), (0.01, 0.0, 0.19 + 0.05 * smoke),
             (0.02 * smoke, 0.02 * smoke, 0.10 * smoke)),
    ]  # fmt: skip


def _steering_wheel(t: float) -> list[ModelPart]:
    angles = [_turned(t) + 0.393 * k for k in range(17)]
    rim = [rod(DARK, _on_wheel(a), _on_wheel(b), 0.020) for a, b in pairwise(angles)]
    spokes = [rod(STEEL, _WHEEL, _on_wheel(_turned(t) + a), 0.016) for a in (0.0, 3.14, 4.71)]
    x, _, z = _WHEEL
    return [
        STOOL, *rim, *spokes, ball(DARK, _WHEEL, (0.08, 0.12, 0.12)),
        rod(DARK, _WHEEL, (x + 0.30, 0.0, z - 0.14), 0.03),
        box(DARK, (x + 0.38, 0.0, 0.40), (0.16, 0.70, 0.80)),
    ]  # fmt: skip


_KEYBOARD = still(
    STOOL, box(WOOD, (0.68, 0.0, 0.64), (0.66, 1.20, 0.04)),
    *(rod(WOOD, (x, y, 0.0), (x, y, 0.63), 0.025) for x in (0.42, 0.94) for y in (0.54, -0.54)),
    box(Material((0.30, 0.31, 0.33)), (0.52, 0.0, 0.675), (0.20, 0.50, 0.03)),
    *(box(Material(WHITE), (0.46 + 0.045 * i, -0.21 + 0.06 * j, 0.695), (0.034, 0.046, 0.012))
      for i in range(4) for j in range(8)),
    box(DARK, (0.86, 0.0, 0.90), (0.03, 0.56, 0.36)), box(DARK, (0.88, 0.0, 0.70),
                                                         (0.05, 0.06, 0.12)),
    box(glowing(BLUE, 0.9), (0.842, 0.0, 0.90), (0.008, 0.52, 0.32)),
)  # fmt: skip


def _shot_ball(t: float) -> list[ModelPart]:
    """In both hands, then in free flight into the basket, through it and down."""
    skin = striped(ORANGE, (0.05, 0.03, 0.02), 2.0)
    rim_x, _, rim_z = build_basket()[0]
    goal_x = rim_x + _BASKET_M
    low = ease(t, 0.05, 0.40) - ease(t, 0.42, 0.75)
    up = ease(t, 0.35, _THROWN_S)
    if t < _THROWN_S:
        place = (0.36, 0.0, 1.36 - 0.16 * low + 0.66 * up)
    elif t < _IN_S:
        share = (t - _THROWN_S) / (_IN_S - _THROWN_S)
        arc = 0.5 * _GRAVITY_M_S2 * (_IN_S - _THROWN_S) ** 2 * share * (1.0 - share)
        place = (0.36 + share * (goal_x - 0.36), 0.0, 2.02 + share * (rim_z - 2.02) + arc)
    else:
        fallen = 1.5 * (t - _IN_S) + 0.5 * _GRAVITY_M_S2 * (t - _IN_S) ** 2
        place = (goal_x, 0.0, max(rim_z - fallen, 0.12))
    return [ball(skin, place, (0.24, 0.24, 0.24))]


_HOOP = still(*moved(build_basket()[1], shift(x=_BASKET_M)))

EVERYDAY_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "conduct": (Prop("right hand", _BATON, ("baton",)),),
        "look through binoculars": (Prop("face", _BINOCULARS, ("binoculars",)),),
        "open umbrella": (Prop("right hand", _umbrella, ("umbrella",)),),
        "blow out": (Prop("right hand", _candle, ("candle",)),),
        "turn steering wheel": (Prop("ground", _steering_wheel, ("steering wheel",)),),
        "type on keyboard": (Prop("ground", _KEYBOARD, ("keyboard", "monitor", "desk", "table")),),
        "shoot basket": (
            Prop("ground", _shot_ball, ("basketball", "ball")),
            Prop("ground", _HOOP, ("basketball hoop",)),
        ),
    }
)
"""Activity with a thing → what is drawn with it."""
