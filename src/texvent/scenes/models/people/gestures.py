"""Gestures of arms and head: functions of time, legs as they are. The eleven of DVS-Gesture too."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

from texvent.scenes.models.people.posture import DOWN, OUT, SHOULDER_SIDE, Arm, Posture
from texvent.scenes.models.people.timing import ease, follow_keys, pulse, swing

Movement = Callable[[float], Posture]
"""Posture as a function of time, s."""

PALM_HALF = 0.035
"""Half the thickness of a palm, m."""
MEETING = PALM_HALF - SHOULDER_SIDE
"""How far out of its shoulder a palm is that touches the other in the middle."""


def _wave_arm(t: float) -> Arm:
    return Arm((0.14, 0.17 + 0.16 * swing(t, 1.6), 0.44), (0.0, 1.0, -0.5))


def _clap(t: float) -> Posture:
    out = MEETING + 0.24 * pulse(t, 2.0)
    arm = Arm((0.38, out, -0.08), (-0.2, 0.7, -1.0))
    return Posture(left=arm, right=arm, nod=0.05 * swing(t, 1.0))


def _point(t: float) -> Posture:
    reach = 0.35 + 0.65 * pulse(t, 0.7)
    return Posture(
        right=Arm((0.10 + 0.08 * reach, 0.10 + 0.50 * reach, -0.10 + 0.20 * reach), DOWN),
        look=-0.9, tool=(0.3, 1.0, 0.1),
    )  # fmt: skip


def _bow(t: float) -> Posture:
    down = ease(t % 2.4, 0.0, 0.8) - ease(t % 2.4, 1.2, 2.2)
    return Posture(
        hips=(-0.10 * down, 0.0, 0.95 - 0.01 * down), lean=1.15 * down, nod=0.25 * down,
        left=Arm((0.12 - 0.1 * down, 0.0, -0.60)), right=Arm((0.12 - 0.1 * down, 0.0, -0.60)),
    )  # fmt: skip


def _salute(t: float) -> Posture:
    up = ease(t % 2.4, 0.0, 0.5) - ease(t % 2.4, 1.5, 2.1)
    x, y, z = (a + up * (b - a) for a, b in zip((0.06, 0.05, -0.60), (0.16, -0.08, 0.24),
                                                strict=True))  # fmt: skip
    return Posture(right=Arm((x, y, z), (0.1, 1.0, -0.2)))


def _raise_arms(t: float) -> Posture:
    angle = -1.3 + 2.6 * pulse(t, 0.6)
    arm = Arm((0.08, 0.60 * math.cos(angle) * 0.9, 0.60 * math.sin(angle)), (-0.5, 0.6, -0.6))
    return Posture(left=arm, right=arm)


def _stretch(t: float) -> Posture:
    lean = swing(t, 0.35)
    arm = Arm((0.0, -0.12, 0.60), (-0.2, 1.0, 0.2))
    return Posture(left=arm, right=arm, tilt=0.35 * lean, nod=-0.15)


def _talk(t: float) -> Posture:
    """Hands move before the body, out of step with each other."""
    right = Arm((0.34 + 0.08 * swing(t, 0.9), -0.02 + 0.10 * swing(t, 0.7, 0.2),
                 -0.22 + 0.12 * swing(t, 1.1)), DOWN)  # fmt: skip
    left = Arm((0.32 + 0.07 * swing(t, 0.8, 0.4), -0.02 + 0.08 * swing(t, 0.6),
                -0.26 + 0.10 * swing(t, 0.9, 0.3)), DOWN)  # fmt: skip
    return Posture(left=left, right=right, nod=0.08 * swing(t, 0.8), look=0.2 * swing(t, 0.4))


def _arm_circle(side: float, sense: float) -> Movement:
    """One stretched arm goes round; `sense` +1 = clockwise for who faces the person."""

    def move(t: float) -> Posture:
        angle = 2.0 * math.pi * 0.9 * t
        # Who faces the person sees its left on the right: clockwise is from up to its left.
        across, up = sense * math.sin(angle), math.cos(angle)
        arm = Arm((0.30, 0.10 + 0.40 * side * across, 0.06 + 0.40 * up), (-0.2, 1.0, -0.5))
        return Posture(left=arm) if side > 0.0 else Posture(right=arm)

    return move


def _arm_roll(t: float) -> Posture:
    """Forearms turn about each other before the chest."""
    angle = 2.0 * math.pi * 1.3 * t

    def arm(phase: float) -> Arm:
        forward, up = math.cos(angle + phase), math.sin(angle + phase)
        return Arm((0.33 + 0.11 * forward, 0.02 - SHOULDER_SIDE, -0.12 + 0.11 * up),
                   (-0.1, 1.0, -0.25))  # fmt: skip

    return Posture(left=arm(0.0), right=arm(math.pi))


def drum(t: float) -> Posture:
    """Both hands beat in turn, twice a second each."""

    def arm(phase: float, side: float) -> Arm:
        beat = pulse(t, 2.0, phase) ** 2
        across = 0.06 * swing(t, 0.5, 0.25 * side)
        return Arm((0.40, -0.06 + across, -0.28 + 0.26 * beat), DOWN)

    return Posture(left=arm(0.0, 0.0), right=arm(0.5, 1.0), nod=0.10 * swing(t, 2.0),
                   tool=(1.0, 0.25, 0.75 * pulse(t, 2.0, 0.5) - 0.35))  # fmt: skip


def _air_drum(t: float) -> Posture:
    """The same higher, as there are no drums: hands in turn above the chest and down."""
    posture = drum(t)

    def raised(arm: Arm | None) -> Arm:
        x, y, z = (arm or Arm()).hand
        return Arm((x + 0.04, y + 0.02, 1.5 * z + 0.36), DOWN)

    return replace(posture, left=raised(posture.left), right=raised(posture.right))


def strum(t: float) -> Posture:
    """The left hand on a neck, the right strums three times a second."""
    slide = 0.05 * swing(t, 0.5)
    return Posture(
        left=Arm((0.30 - 0.3 * slide, 0.16 + slide, -0.16 + 0.3 * slide), DOWN),
        right=Arm((0.24, -0.13, -0.36 + 0.09 * swing(t, 2.5)), OUT),
        nod=0.18 * pulse(t, 2.0), tilt=0.04 * swing(t, 1.0),
    )  # fmt: skip


def _other(t: float) -> Posture:
    """Both hands push forward and spread."""
    (forward, out, up) = follow_keys(
        t, [(0.0, (0.20, -0.05, -0.10)), (0.5, (0.52, -0.05, 0.02)), (1.0, (0.30, 0.42, 0.10)),
            (1.5, (0.25, 0.10, -0.35))], 2.0,
    )  # fmt: skip
    return Posture(left=Arm((forward, out, up), DOWN), right=Arm((forward, out, up), DOWN))


GESTURES: Mapping[str, Movement] = MappingProxyType(
    {
        "stand": lambda t: Posture(lean=0.012 * swing(t, 0.3), look=0.06 * swing(t, 0.15)),
        "wave": lambda t: Posture(right=_wave_arm(t)),
        "wave right": lambda t: Posture(right=_wave_arm(t)),
        "wave left": lambda t: Posture(left=_wave_arm(t)),
        "wave both": lambda t: Posture(left=_wave_arm(t), right=_wave_arm(t)),
        "clap": _clap,
        "point": _point,
        "bow": _bow,
        "salute": _salute,
        "raise arms": _raise_arms,
        "stretch": _stretch,
        "talk": _talk,
        "right arm clockwise": _arm_circle(-1.0, 1.0),
        "right arm counter-clockwise": _arm_circle(-1.0, -1.0),
        "left arm clockwise": _arm_circle(1.0, 1.0),
        "left arm counter-clockwise": _arm_circle(1.0, -1.0),
        "arm roll": _arm_roll,
        "air drums": _air_drum,
        "air guitar": strum,
        "other gesture": _other,
    }
)
"""Activity → posture of arms and head over time."""
