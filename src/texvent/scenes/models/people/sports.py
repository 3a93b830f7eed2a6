"""Exercises, sports and dancing: whole-body postures as functions of time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import ANKLE, DOWN, HIP, OUT, Arm, Leg, Posture
from texvent.scenes.models.people.timing import ease, follow_keys, pulse, swing
from texvent.scenes.models.shapes import Point

_GUARD: Point = (0.26, -0.08, 0.02)


def _jumping_jack(t: float) -> Posture:
    """Apart and together once a second; the feet are in the air while they move sideways."""
    apart, hop = pulse(t, 1.0), 0.09 * swing(t, 1.0) ** 2
    side = 0.08 + 0.28 * apart
    leg = math.sqrt(0.85**2 - (side - 0.10) ** 2)
    angle = -1.35 + 2.75 * apart
    arm = Arm((0.04, 0.62 * math.cos(angle), 0.62 * math.sin(angle)), (-0.5, 0.6, -0.3))
    foot = Leg((0.0, side, ANKLE + hop), (1.0, 0.6, 0.2), 0.5 * hop / 0.09)
    return Posture(hips=(0.0, 0.0, ANKLE + hop + leg + 0.02), left=arm, right=arm,
                   left_leg=foot, right_leg=foot)  # fmt: skip


def _squat(t: float) -> Posture:
    down = pulse(t, 0.6)
    leg = Leg((0.04, 0.15, ANKLE), (1.0, 0.45, 0.1))
    arm = Arm((0.06 + 0.50 * down, 0.04, -0.60 + 0.62 * down), DOWN)
    return Posture(hips=(-0.26 * down, 0.0, 0.93 - 0.46 * down), lean=0.65 * down,
                   nod=-0.4 * down, left=arm, right=arm, left_leg=leg, right_leg=leg)  # fmt: skip


def _lunge(t: float) -> Posture:
    down = pulse(t, 0.6)
    arm = Arm((0.02, 0.12, -0.34), OUT)
    return Posture(hips=(0.0, 0.0, 0.84 - 0.30 * down), lean=0.05, left=arm, right=arm,
                   left_leg=Leg((0.38, 0.08, ANKLE)),
                   right_leg=Leg((-0.40, 0.08, ANKLE + 0.05), (1.0, 0.1, -0.6), 0.8))  # fmt: skip


def _push_up(t: float) -> Posture:
    """A straight body turns about its toes; the hands stay on the ground."""
    rise = 0.60 - 0.34 * pulse(t, 0.7)
    angle = math.asin((rise - 0.13) / 1.38)
    toes = -0.70
    hips = (toes + 0.86 * math.cos(angle), 0.0, 0.13 + 0.86 * math.sin(angle))
    hand = Arm((toes + 1.24, 0.24, 0.04), (-0.7, 0.8, -0.4), True)
    right = Arm((toes + 1.24, -0.24, 0.04), (-0.7, 0.8, -0.4), True)
    leg = Leg((toes, 0.08, 0.13), (0.0, 0.2, -1.0), 1.25)
    return Posture(hips=hips, lean=0.5 * math.pi - angle, nod=-0.35, left=hand, right=right,
                   left_leg=leg, right_leg=leg)  # fmt: skip


def _sit_up(t: float) -> Posture:
    up = pulse(t, 0.5)
    leg = Leg((0.52, 0.10, ANKLE), (0.2, 0.1, 1.0))
    arm = Arm((0.10, -0.07, 0.20), (0.2, 1.0, 0.1))
    return Posture(hips=(0.0, 0.0, 0.12), lean=-1.5 + 1.35 * up, nod=0.3, left=arm, right=arm,
                   left_leg=leg, right_leg=leg)  # fmt: skip


def _lift(t: float) -> Posture:
    """From the thighs to above the head, once in two seconds."""
    up = ease(t % 2.4, 0.1, 1.0) - ease(t % 2.4, 1.4, 2.3)
    arm = Arm((0.26 - 0.20 * up, 0.06 + 0.06 * up, -0.52 + 1.08 * up), (0.2, 0.7, -0.7))
    leg = Leg((0.0, 0.16, ANKLE), (1.0, 0.4, 0.2))
    dip = 0.10 * (1.0 - up)
    return Posture(hips=(-0.6 * dip, 0.0, 0.93 - dip), lean=1.5 * dip, left=arm, right=arm,
                   left_leg=leg, right_leg=leg, tool=(0.0, 1.0, 0.0))  # fmt: skip


def _box(t: float) -> Posture:
    """Guard, left and right straight punches; the feet stay in a fighting stance."""
    left, right = pulse(t, 1.2) ** 3, pulse(t, 1.2, 0.5) ** 3

    def arm(out: float) -> Arm:
        x, y, z = _GUARD
        return Arm((x + 0.36 * out, y - 0.06 * out, z + 0.04 * out), DOWN)

    return Posture(
        hips=(0.02 * swing(t, 1.2), 0.0, 0.88 + 0.015 * swing(t, 2.4)), lean=0.12,
        turn=0.45 * (right - left), left=arm(left), right=arm(right),
        left_leg=Leg((0.24, 0.10, ANKLE)), right_leg=Leg((-0.22, 0.14, ANKLE)),
    )  # fmt: skip


_KICK = (
    # Right foot forward, up, toes down; torso lean and turn. Contact is at 0 s.
    (-0.60, (-0.10, 0.085, 0.2, 0.00, 0.0)),
    (-0.22, (-0.52, 0.360, 1.1, 0.18, -0.25)),
    (0.00, (0.30, 0.115, 0.6, -0.05, 0.20)),
    (0.16, (0.72, 0.520, 0.2, -0.25, 0.35)),
    (0.50, (0.22, 0.20, 0.1, -0.05, 0.1)),
    (0.80, (0.02, ANKLE, 0.0, 0.00, 0.0)),
)


def kick(t: float) -> Posture:
    """The right foot swings back, meets the ball at t = 0, follows through and lands."""
    forward, up, pitch, lean, turn = follow_keys(t, _KICK)
    swings = math.exp(-((t / 0.35) ** 2))
    return Posture(
        hips=(0.06 * swings, 0.0, HIP - 0.02 - 0.03 * swings), lean=lean, turn=turn,
        left=Arm((0.10 + 0.25 * swings, 0.10 + 0.30 * swings, -0.58 + 0.35 * swings), DOWN),
        right=Arm((0.04 - 0.25 * swings, 0.10 + 0.22 * swings, -0.58 + 0.22 * swings), DOWN),
        left_leg=Leg((0.0, 0.08, ANKLE)), right_leg=Leg((forward, 0.09, up), pitch=pitch),
    )  # fmt: skip


_THROW = (
    # Right hand forward, outward, up; lean, turn. The thing leaves the hand at 0 s.
    (-0.80, (0.22, 0.00, -0.30, 0.00, 0.0)),
    (-0.30, (-0.32, 0.20, 0.28, -0.18, -0.6)),
    (0.00, (0.36, 0.10, 0.46, 0.10, 0.15)),
    (0.18, (0.46, -0.16, -0.22, 0.40, 0.5)),
    (0.80, (0.10, 0.04, -0.58, 0.00, 0.0)),
)


def throw(t: float) -> Posture:
    """Overarm with the right hand, let go at t = 0; the left foot is in front."""
    forward, out, up, lean, turn = follow_keys(t, _THROW)
    wind = math.exp(-(((t + 0.25) / 0.35) ** 2))
    return Posture(
        hips=(-0.06 + 0.12 * ease(t, -0.4, 0.1), 0.0, 0.88), lean=lean, turn=turn,
        left=Arm((0.08 + 0.42 * wind, 0.06, -0.56 + 0.50 * wind), DOWN),
        right=Arm((forward, out, up), OUT),
        left_leg=Leg((0.26, 0.08, ANKLE)), right_leg=Leg((-0.24, 0.10, ANKLE + 0.02), pitch=0.3),
    )  # fmt: skip


_CATCH = (
    # Both hands forward, up; the thing arrives at 0 s.
    (-0.70, (0.16, -0.50, 0.03)),
    (-0.20, (0.46, -0.05, -0.10)),
    (0.00, (0.48, 0.00, -0.13)),
    (0.20, (0.30, -0.16, -0.14)),
    (0.90, (0.30, -0.20, -0.12)),
)


def catch(t: float) -> Posture:
    """Both hands reach out, close on the thing at t = 0 and draw it in."""
    forward, up, out = follow_keys(t, _CATCH)
    give = math.exp(-(((t - 0.15) / 0.3) ** 2))
    arm = Arm((forward, out, up), DOWN)
    leg = (Leg((0.10, 0.12, ANKLE)), Leg((-0.10, 0.12, ANKLE)))
    return Posture(hips=(0.0, 0.0, 0.91 - 0.05 * give), lean=0.06, left=arm, right=arm,
                   left_leg=leg[0], right_leg=leg[1])  # fmt: skip


_BAT = (
    # Hands forward, to the left, up; turn of the torso; the bat's direction. Contact at 0 s.
    (-0.80, (0.20, -0.16, 0.02, -0.55, -0.35, -0.25, 0.9)),
    (-0.30, (0.12, -0.24, 0.04, -0.85, -0.75, -0.35, 0.55)),
    (0.00, (0.44, 0.00, -0.22, 0.15, 0.80, -0.60, 0.0)),
    (0.14, (0.34, 0.22, -0.06, 0.65, 0.35, 0.90, 0.15)),
    (0.32, (0.12, 0.30, 0.10, 0.90, -0.60, 0.60, 0.45)),
    (0.90, (0.24, -0.04, -0.16, 0.00, 0.20, -0.20, 0.95)),
)


def swing_bat(t: float) -> Posture:
    """Both hands bring a bat from behind the right shoulder round to the left."""
    forward, left, up, turn, *tool = follow_keys(t, _BAT)
    # `left` is measured from the middle of the chest.
    return Posture(
        hips=(0.0, 0.0, 0.87), lean=0.16, turn=turn,
        left=Arm((forward, left - 0.20 + 0.03, up - 0.05), OUT),
        right=Arm((forward, -left - 0.20 - 0.03, up + 0.03), OUT),
        left_leg=Leg((0.05, 0.24, ANKLE), (1.0, 0.3, 0.2)),
        right_leg=Leg((0.0, 0.24, ANKLE), (1.0, 0.3, 0.2)),
        tool=(tool[0], -tool[1], tool[2]), look=-0.5 * turn,
    )  # fmt: skip


_RACKET = (
    # Right hand forward, outward, up; turn; the racket's direction: forward, outward, up.
    (-0.80, (0.30, -0.02, -0.20, 0.0, 0.8, 0.2, 0.6)),
    (-0.30, (-0.26, 0.36, -0.08, -0.8, -0.5, 0.6, 0.6)),
    (0.00, (0.42, 0.22, -0.10, 0.0, 0.25, 0.95, 0.1)),
    (0.20, (0.36, -0.26, 0.18, 0.55, 0.3, -0.7, 0.6)),
    (0.80, (0.30, -0.02, -0.20, 0.0, 0.8, 0.2, 0.6)),
)


def swing_racket(t: float) -> Posture:
    """A forehand: contact at t = 0 beside the right hip."""
    forward, out, up, turn, *tool = follow_keys(t, _RACKET)
    return Posture(
        hips=(0.0, 0.0, 0.86), lean=0.12, turn=turn,
        left=Arm((0.30, 0.12, -0.15), DOWN), right=Arm((forward, out, up), OUT),
        left_leg=Leg((0.16, 0.18, ANKLE)), right_leg=Leg((-0.16, 0.20, ANKLE)),
        tool=(tool[0], tool[1], tool[2]), look=-0.6 * turn,
    )  # fmt: skip


_CLUB = (
    # Angle of arms and club about the forward axis, 0 = down at the ball; contact at 0 s.
    (-1.10, (0.0,)), (-0.40, (-2.5,)), (0.00, (0.0,)), (0.25, (2.4,)), (1.10, (0.4,)),
)  # fmt: skip


def swing_club(t: float) -> Posture:
    """A golf swing: up to the right, down through the ball, up to the left."""
    (angle,) = follow_keys(t, _CLUB)
    across, down = math.sin(angle), math.cos(angle)
    left, up = 0.45 * across, -0.48 * down
    return Posture(
        hips=(-0.06, 0.0, 0.88), lean=0.40, turn=0.3 * angle, nod=0.2,
        left=Arm((0.30, left - 0.20, up), OUT), right=Arm((0.30, -left - 0.20, up - 0.04), OUT),
        left_leg=Leg((0.02, 0.20, ANKLE)), right_leg=Leg((0.02, 0.20, ANKLE)),
        tool=(0.55, -0.9 * across, -0.9 * down),
    )  # fmt: skip


DRIBBLE_HZ = 1.6
"""Bounces per second of a dribbled ball."""


def _dribble(t: float) -> Posture:
    """The right hand meets the ball at the top of each bounce."""
    push = pulse(t, DRIBBLE_HZ)
    leg = (Leg((0.14, 0.12, ANKLE)), Leg((-0.14, 0.14, ANKLE)))
    return Posture(hips=(0.0, 0.0, 0.82), lean=0.28, nod=0.15,
                   left=Arm((0.26, 0.16, -0.28), DOWN),
                   right=Arm((0.36, 0.10, -0.24 - 0.12 * push), OUT),
                   left_leg=leg[0], right_leg=leg[1])  # fmt: skip


JUGGLE_HZ = 1.1
"""Rounds per second of each hand of a juggler."""


def _juggle(t: float) -> Posture:
    def arm(phase: float) -> Arm:
        angle = 2.0 * math.pi * (JUGGLE_HZ * t + phase)
        return Arm((0.40, 0.0 + 0.07 * math.cos(angle), -0.26 + 0.07 * math.sin(angle)), DOWN)

    return Posture(left=arm(0.0), right=arm(0.5), nod=-0.15)


def _climb(t: float) -> Posture:
    """Hands and feet go up in turn on something upright in front."""
    step = swing(t, 0.6)
    return Posture(
        hips=(-0.06, 0.04 * step, 0.92), lean=0.02, nod=-0.3,
        left=Arm((0.32, 0.02, 0.28 + 0.24 * step), OUT),
        right=Arm((0.32, 0.02, 0.28 - 0.24 * step), OUT),
        left_leg=Leg((0.26, 0.14, 0.34 - 0.20 * step), (1.0, 0.7, 0.3)),
        right_leg=Leg((0.26, 0.14, 0.34 + 0.20 * step), (1.0, 0.7, 0.3)),
    )  # fmt: skip


def _dance(t: float) -> Posture:
    """Two beats a second: hips from side to side, arms in turn up."""
    sway, beat = swing(t, 1.0), pulse(t, 2.0)
    return Posture(
        hips=(0.0, 0.09 * sway, 0.89 - 0.05 * beat), tilt=0.16 * sway, turn=0.45 * swing(t, 0.5),
        look=0.3 * swing(t, 0.5, 0.25),
        left=Arm((0.20, 0.22, 0.10 + 0.32 * sway), OUT),
        right=Arm((0.20, 0.22, 0.10 - 0.32 * sway), OUT),
        left_leg=Leg((0.04, 0.17, ANKLE), (1.0, 0.4, 0.2)),
        right_leg=Leg((-0.04, 0.17, ANKLE), (1.0, 0.4, 0.2)),
    )  # fmt: skip


def _swim(t: float) -> Posture:
    """Front crawl: flat on the water, arms over in turn, legs beat."""

    def arm(phase: float) -> Arm:
        angle = 2.0 * math.pi * (0.8 * t + phase)
        return Arm((0.55 * math.sin(angle), 0.04, 0.55 * math.cos(angle)), (-0.6, 0.8, 0.0))

    def leg(phase: float) -> Leg:
        return Leg((-0.82, 0.08, -0.06 + 0.12 * swing(t, 2.4, phase)), (0.0, 0.1, -1.0), 1.3)

    return Posture(hips=(0.0, 0.0, -0.02), lean=1.48, tilt=0.3 * swing(t, 0.8), nod=-0.4,
                   left=arm(0.0), right=arm(0.5), left_leg=leg(0.0),
                   right_leg=leg(0.5))  # fmt: skip


def _fly(t: float) -> Posture:
    """Stretched out in the air, one arm ahead, legs trailing."""
    sway = swing(t, 0.4)

    def leg(side: float) -> Leg:
        return Leg((-0.84, 0.09, HIP - 0.10 + 0.03 * side * sway), (0.0, 0.1, -1.0), 1.3)

    return Posture(hips=(0.0, 0.0, HIP), lean=1.40, tilt=0.06 * sway, nod=-0.9,
                   left=Arm((0.05, 0.06, 0.62), (-0.6, 0.8, 0.0)),
                   right=Arm((0.05, 0.10, -0.60), (-0.6, 0.8, 0.0)),
                   left_leg=leg(1.0), right_leg=leg(-1.0))  # fmt: skip


BOARD_STANCE = 0.09
"""Height of the soles of who stands on a board, m."""


def _board(t: float) -> Posture:
    """Sideways on a board: knees bent, arms out for balance."""
    sway = swing(t, 0.5)
    foot = ANKLE + BOARD_STANCE
    return Posture(
        hips=(-0.05, 0.03 * sway, 0.76 + 0.03 * swing(t, 0.8)), lean=0.28, tilt=0.10 * sway,
        look=1.1, heading=-0.5 * math.pi,
        left=Arm((0.14, 0.44, 0.02 + 0.10 * sway), OUT),
        right=Arm((0.10, 0.42, -0.04 - 0.10 * sway), OUT),
        left_leg=Leg((0.02, 0.30, foot), (1.0, 0.3, 0.2)),
        right_leg=Leg((0.02, 0.30, foot), (1.0, 0.3, 0.2)),
    )  # fmt: skip


def _ski(t: float) -> Posture:
    lean = swing(t, 0.5)
    foot = ANKLE + 0.03
    arm = Arm((0.34, 0.12, -0.24), OUT)
    return Posture(
        hips=(-0.10, 0.08 * lean, 0.68 + 0.03 * swing(t, 1.0)), lean=0.55, tilt=0.12 * lean,
        nod=-0.4, left=arm, right=arm, left_leg=Leg((0.04, 0.12, foot)),
        right_leg=Leg((-0.04, 0.12, foot)), tool=(-0.75, 0.15, -0.65),
    )  # fmt: skip


def _row(t: float) -> Posture:
    """Sits and paddles to the left and to the right."""
    turn = 2.0 * math.pi * 0.7 * t
    side, dip = math.sin(turn), math.cos(turn)
    leg = Leg((0.62, 0.12, 0.16), (0.3, 0.2, 1.0))
    return Posture(
        hips=(0.0, 0.0, 0.24), lean=0.10 + 0.06 * dip, turn=0.30 * side,
        left=Arm((0.36 + 0.10 * dip, 0.02, -0.16 + 0.16 * side), OUT),
        right=Arm((0.36 - 0.10 * dip, 0.02, -0.16 - 0.16 * side), OUT),
        left_leg=leg, right_leg=leg, tool=(-0.45 * dip, 0.9, -0.40 * side),
    )  # fmt: skip


def repeated(movement: Movement, period_s: float, at_s: float) -> Movement:
    """A single act again and again: its instant t = 0 comes at `at_s` of each period."""
    return lambda t: movement(t % period_s - at_s)


SINGLE_ACTS: Mapping[str, Movement] = MappingProxyType(
    {"kick": kick, "throw": throw, "catch": catch, "swing bat": swing_bat,
     "swing racket": swing_racket, "swing club": swing_club}
)  # fmt: skip
"""Acts with one instant of contact at t = 0 s."""

SPORTS: Mapping[str, Movement] = MappingProxyType(
    {
        "dance": _dance, "jumping jack": _jumping_jack, "squat": _squat, "lunge": _lunge,
        "push-up": _push_up, "sit-up": _sit_up, "lift": _lift, "punch": _box, "box": _box,
        "kick": repeated(kick, 1.8, 0.8), "throw": repeated(throw, 1.9, 0.9),
        "catch": repeated(catch, 1.9, 0.9), "swing bat": repeated(swing_bat, 2.0, 0.9),
        "swing racket": repeated(swing_racket, 1.7, 0.85),
        "swing club": repeated(swing_club, 2.4, 1.2), "dribble": _dribble, "juggle": _juggle,
        "climb": _climb, "swim": _swim, "fly": _fly, "surf": _board, "skate": _board,
        "snowboard": _board, "ski": _ski, "row": _row,
    }
)  # fmt: skip
"""Activity → posture of the whole body over time."""
