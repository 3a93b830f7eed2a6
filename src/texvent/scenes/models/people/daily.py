"""Resting, instruments, tools, meals: postures as functions of time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from texvent.scenes.models.people.gestures import Movement, drum, strum
from texvent.scenes.models.people.posture import ANKLE, DOWN, OUT, Arm, Leg, Posture
from texvent.scenes.models.people.timing import ease, follow_keys, pulse, swing
from texvent.scenes.models.shapes import Point

SEAT = 0.42
"""Height of the chair that "sit" sits on, m: hips are a little above it."""
_SEATED = Posture(
    hips=(0.0, 0.0, SEAT + 0.08), left=Arm((0.38, -0.05, -0.36), DOWN),
    right=Arm((0.38, -0.05, -0.36), DOWN), left_leg=Leg((0.40, 0.10, ANKLE)),
    right_leg=Leg((0.40, 0.10, ANKLE)),
)  # fmt: skip


def _sit(t: float) -> Posture:
    return replace(_SEATED, lean=0.02 * swing(t, 0.3), look=0.25 * swing(t, 0.2))


def _sit_on_ground(t: float) -> Posture:
    leg = Leg((0.50, 0.12, ANKLE), (0.2, 0.3, 1.0))
    return Posture(
        hips=(0.0, 0.0, 0.12), lean=0.08 + 0.02 * swing(t, 0.3), look=0.25 * swing(t, 0.2),
        left=Arm((0.44, -0.06, -0.12), OUT), right=Arm((0.44, -0.06, -0.12), OUT),
        left_leg=leg, right_leg=leg,
    )  # fmt: skip


def _lie(t: float) -> Posture:
    breath = 0.004 * swing(t, 0.3)
    leg = Leg((0.86, 0.11, 0.09), (0.0, 0.2, 1.0), -1.3)
    arm = Arm((-0.02, 0.10, -0.58), (-0.2, 1.0, 0.0))
    return Posture(hips=(0.0, 0.0, 0.13 + breath), lean=-0.5 * math.pi + 0.02, left=arm, right=arm,
                   left_leg=leg, right_leg=leg, look=0.1 * swing(t, 0.2))  # fmt: skip


def _kneel(t: float) -> Posture:
    leg = Leg((-0.34, 0.11, 0.08), (1.0, 0.1, -0.5), 2.4)
    arm = Arm((0.30, 0.0, -0.46), DOWN)
    return Posture(hips=(0.0, 0.0, 0.48), lean=0.06 + 0.02 * swing(t, 0.3),
                   nod=0.2 + 0.05 * swing(t, 0.25), left=arm, right=arm,
                   left_leg=leg, right_leg=leg)  # fmt: skip


def _crouch(t: float) -> Posture:
    leg = Leg((0.06, 0.14, ANKLE), (1.0, 0.35, 0.3))
    arm = Arm((0.42, -0.06, -0.26), DOWN)
    return Posture(hips=(-0.20, 0.0, 0.36), lean=0.55 + 0.03 * swing(t, 0.3), nod=-0.3,
                   left=arm, right=arm, left_leg=leg, right_leg=leg)  # fmt: skip


def _guitar(t: float) -> Posture:
    return replace(strum(t), tool=(0.0, 1.0, 0.0))


def _drums(t: float) -> Posture:
    return replace(drum(t), hips=(0.0, 0.0, SEAT + 0.08), left_leg=Leg((0.40, 0.18, ANKLE)),
                   right_leg=Leg((0.40, 0.18, ANKLE)))  # fmt: skip


_KEYS: Point = (0.49, 0.13, 0.74)
"""Where the hands are over the keys of a piano, a keyboard or a laptop, m."""


def _keys(rate_hz: float, wide: float) -> Movement:
    """Seated, both hands go over the keys and strike them in turn."""
    x, y, z = _KEYS

    def move(t: float) -> Posture:
        def arm(phase: float) -> Arm:
            strike = 0.05 * (1.0 + swing(t, rate_hz, phase))
            across = wide * swing(t, 0.5, phase)
            back = 0.04 * swing(t, 1.3, phase)
            return Arm((x + back, y + across, z + strike), DOWN, True)

        return replace(_SEATED, lean=0.12, nod=0.15 + 0.08 * swing(t, 0.7), left=arm(0.0),
                       right=arm(0.5))  # fmt: skip

    return move


def _violin(t: float) -> Posture:
    stroke = swing(t, 1.2)
    return Posture(
        left=Arm((0.42, 0.16, 0.02), (0.1, 0.3, -1.0)),
        right=Arm((0.36 - 0.10 * stroke, 0.02 + 0.17 * stroke, 0.0 - 0.10 * stroke), OUT),
        look=0.45, nod=0.12, tilt=0.05 * stroke, tool=(0.75, -0.75, 0.35),
    )  # fmt: skip


def _flute(t: float) -> Posture:
    """The flute goes to the right of the mouth; the body sways with the tune."""
    lift, sway = 0.05 * swing(t, 0.6), 0.16 * swing(t, 0.6, 0.2)
    return Posture(
        left=Arm((0.24, -0.24, 0.18 + lift), OUT), right=Arm((0.18, 0.16, 0.18 + lift), OUT),
        nod=0.10 * swing(t, 0.6), look=0.25, tilt=sway,
    )  # fmt: skip


def _trumpet(t: float) -> Posture:
    lift = 0.07 * swing(t, 0.6)
    return Posture(
        left=Arm((0.34, -0.17, 0.05 + lift), OUT), right=Arm((0.46, -0.19, -0.04 + lift), OUT),
        nod=-0.05 + 0.14 * swing(t, 0.6), lean=0.12 * swing(t, 0.6), tool=(0.9, 0.0, -0.35),
    )  # fmt: skip


def _write(t: float) -> Posture:
    return Posture(
        left=Arm((0.32, -0.06, -0.26), DOWN), nod=0.40,
        right=Arm((0.36 + 0.03 * swing(t, 1.7), -0.12 + 0.11 * swing(t, 0.45), -0.17), DOWN),
    )  # fmt: skip


def _read(t: float) -> Posture:
    arm = Arm((0.36, -0.08, -0.12), DOWN)
    return Posture(left=arm, right=arm, nod=0.40, look=0.14 * swing(t, 0.5), tool=(0.2, 0.0, 1.0))


_MOUTH: Point = (0.19, -0.17, 0.20)
_PLATE: Point = (0.40, -0.10, -0.14)


def _to_mouth(t: float, rate_hz: float) -> Point:
    up = ease(t * rate_hz % 1.0, 0.0, 0.3) - ease(t * rate_hz % 1.0, 0.55, 0.95)
    x, y, z = (a + up * (b - a) for a, b in zip(_PLATE, _MOUTH, strict=True))
    return (x, y, z)


def _eat(t: float) -> Posture:
    return Posture(left=Arm((0.36, -0.10, -0.14), DOWN), right=Arm(_to_mouth(t, 0.7), OUT),
                   nod=0.2, tool=(-0.5, -0.8, 0.1))  # fmt: skip


def _drink(t: float) -> Posture:
    up = ease(t * 0.5 % 1.0, 0.0, 0.3) - ease(t * 0.5 % 1.0, 0.6, 0.95)
    return Posture(right=Arm(_to_mouth(t, 0.5), OUT), nod=-0.35 * up,
                   tool=(-0.75 * up, 0.0, 1.0 - 0.3 * up))  # fmt: skip


def _phone(t: float) -> Posture:
    return Posture(
        right=Arm((0.08, -0.07, 0.22), (0.2, 1.0, -0.9)), look=0.15 * swing(t, 0.3),
        left=Arm((0.30 + 0.06 * swing(t, 0.8), 0.02, -0.26 + 0.08 * swing(t, 0.9)), DOWN),
        nod=0.08 * swing(t, 0.7), tool=(0.2, 0.0, 1.0),
    )  # fmt: skip


def _text(t: float) -> Posture:
    return Posture(
        right=Arm((0.36, -0.15, -0.10), DOWN), nod=0.42 + 0.05 * swing(t, 0.4),
        left=Arm((0.36 + 0.02 * swing(t, 3.0), -0.17, -0.12), DOWN), tool=(0.35, 0.0, 0.9),
    )  # fmt: skip


def _photograph(t: float) -> Posture:
    arm = Arm((0.30, -0.15, 0.20), OUT)
    return Posture(left=arm, right=arm, turn=0.25 * swing(t, 0.3), lean=0.06 * swing(t, 0.4),
                   tool=(0.0, 0.0, 1.0))  # fmt: skip


def _sing(t: float) -> Posture:
    return Posture(
        right=Arm((0.20, -0.15, 0.20), OUT), nod=-0.15 + 0.1 * swing(t, 0.8),
        left=Arm((0.30, 0.20 + 0.14 * swing(t, 0.5), -0.05 + 0.20 * swing(t, 0.5)), DOWN),
        tilt=0.08 * swing(t, 1.0), tool=(-0.5, 0.0, 0.85),
    )  # fmt: skip


_DIG = (
    # Right hand forward, up; lean; the shovel's direction: forward, up.
    (0.0, (0.40, -0.45, 0.55, 0.75, -0.65)),
    (0.5, (0.46, -0.52, 0.75, 0.85, -0.55)),
    (1.0, (0.40, -0.24, 0.30, 0.95, 0.05)),
    (1.35, (0.44, -0.12, 0.15, 0.80, 0.45)),
)


def _dig(t: float) -> Posture:
    forward, up, lean, ahead, rise = follow_keys(t, _DIG, 2.0)
    return Posture(
        hips=(-0.08, 0.0, 0.84), lean=lean, nod=0.1,
        right=Arm((forward - 0.30 * ahead, -0.04, up - 0.30 * rise), OUT),
        left=Arm((forward + 0.06, -0.24, up), OUT),
        left_leg=Leg((0.22, 0.12, ANKLE)), right_leg=Leg((-0.22, 0.12, ANKLE)),
        tool=(ahead, -0.2, rise),
    )  # fmt: skip


def _sweep(t: float) -> Posture:
    stroke = swing(t, 0.8)
    return Posture(
        hips=(-0.03, 0.0, 0.90), lean=0.22, turn=0.25 * stroke, nod=0.2,
        right=Arm((0.26 + 0.05 * stroke, -0.08, -0.10), OUT),
        left=Arm((0.40 + 0.05 * stroke, -0.16, -0.36), OUT),
        left_leg=Leg((0.12, 0.12, ANKLE)), right_leg=Leg((-0.12, 0.12, ANKLE)),
        tool=(0.60 + 0.25 * stroke, -0.35 - 0.3 * stroke, -0.95),
    )  # fmt: skip


def _chop(t: float) -> Posture:
    share = (t * 0.7) % 1.0
    up = ease(share, 0.0, 0.6) - ease(share, 0.65, 0.9)
    hand = (0.46 - 0.30 * up, -0.20, -0.40 + 0.86 * up)
    arm = Arm(hand, OUT)
    return Posture(
        hips=(-0.04, 0.0, 0.88), lean=0.55 - 0.60 * up, left=arm, right=arm,
        left_leg=Leg((0.12, 0.16, ANKLE)), right_leg=Leg((-0.10, 0.16, ANKLE)),
        tool=(0.95 - 1.4 * up, 0.0, -0.15 + 0.9 * up),
    )  # fmt: skip


_PUSHING = Arm((0.54, -0.04, -0.04), (-0.3, 0.8, -0.8))


def _push(t: float) -> Posture:
    effort = 0.03 * swing(t, 0.8)
    return Posture(hips=(-0.14, 0.0, 0.86), lean=0.42 + effort, nod=-0.25, left=_PUSHING,
                   right=_PUSHING, left_leg=Leg((0.10, 0.10, ANKLE)),
                   right_leg=Leg((-0.52, 0.10, ANKLE + 0.04), pitch=0.5))  # fmt: skip


def _pull(t: float) -> Posture:
    effort = swing(t, 0.8)
    arm = Arm((0.46 + 0.12 * effort, -0.12, -0.20), DOWN)
    return Posture(hips=(-0.26 + 0.10 * effort, 0.0, 0.76), lean=-0.30 + 0.26 * effort,
                   nod=0.2, left=arm, right=arm, left_leg=Leg((0.22, 0.12, ANKLE)),
                   right_leg=Leg((0.02, 0.14, ANKLE)))  # fmt: skip


def _fish(t: float) -> Posture:
    lift = 0.5 + 0.5 * swing(t, 0.5)
    return Posture(
        right=Arm((0.38, -0.08, -0.26 + 0.12 * lift), DOWN), lean=-0.05 * lift,
        left=Arm((0.46, -0.16, -0.20 + 0.14 * lift), DOWN), tool=(0.85, -0.1, 0.35 + 0.35 * lift),
    )  # fmt: skip


def _tie_shoes(t: float) -> Posture:
    """On one knee, both hands at the shoe in front."""
    apart, up = 0.03 + 0.10 * pulse(t, 0.9), 0.16 + 0.12 * pulse(t, 0.9, 0.2)
    return Posture(
        hips=(-0.16, 0.0, 0.42), lean=0.85, nod=0.25,
        left=Arm((0.36, 0.06 + apart, up), OUT, True),
        right=Arm((0.36, 0.06 - apart, up), OUT, True),
        left_leg=Leg((0.30, 0.08, ANKLE), (1.0, 0.5, 0.6)),
        right_leg=Leg((-0.42, 0.10, 0.10), (1.0, 0.1, -0.6), 2.2),
    )  # fmt: skip


DAILY: Mapping[str, Movement] = MappingProxyType(
    {
        "sit": _sit, "sit on ground": _sit_on_ground, "lie": _lie, "kneel": _kneel,
        "crouch": _crouch, "play guitar": _guitar, "play drums": _drums,
        "play piano": _keys(1.7, 0.12), "type": _keys(2.3, 0.06), "play violin": _violin,
        "play flute": _flute, "play trumpet": _trumpet, "write": _write, "read": _read,
        "eat": _eat, "drink": _drink, "phone": _phone, "text": _text, "photograph": _photograph,
        "sing": _sing, "dig": _dig,
        "sweep": _sweep, "chop wood": _chop, "push": _push,
        "pull": _pull, "fish": _fish, "tie shoes": _tie_shoes,
    }
)  # fmt: skip
"""Activity → posture over time."""
