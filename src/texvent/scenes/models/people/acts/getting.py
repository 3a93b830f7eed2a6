"""From one posture to another, once in a clip: sits down, stands up, lies down, kneels, falls."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.people.daily import DAILY
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import ANKLE, HIP, Arm, Leg, Posture, blend
from texvent.scenes.models.people.timing import ease
from texvent.scenes.models.shapes import Point

STARTS_S, LASTS_S = 0.35, 0.8
"""When a body sets off for the other posture, and how long it takes, s."""
_BEFORE_SEAT_M = 0.40
"""Where who sits down stands before, ahead of the seat's middle, m."""


def _standing(ahead_m: float = 0.0) -> Posture:
    leg = Leg((ahead_m, 0.08, ANKLE))
    return Posture(hips=(ahead_m, 0.0, HIP), left=Arm(), right=Arm(), left_leg=leg, right_leg=leg)


def _change(*postures: Movement, start_s: float = STARTS_S, lasts_s: float = LASTS_S) -> Movement:
    """From each posture to the next, all in the same time."""

    def move(t: float) -> Posture:
        step_s = lasts_s / (len(postures) - 1)
        found = postures[0](t)
        for number, posture in enumerate(postures[1:]):
            begin = start_s + number * step_s
            found = blend(found, posture(t), ease(t, begin, begin + step_s))
        return found

    return move


def _stand(_: float) -> Posture:
    return _standing()


def _before_seat(_: float) -> Posture:
    return _standing(_BEFORE_SEAT_M)


def _bend(ahead_m: float) -> Movement:
    """Half way down to a seat: the hips back, the torso forward."""
    arm: Point = (0.34, 0.02, -0.40)
    leg = Leg((ahead_m, 0.10, ANKLE))
    posture = Posture(
        hips=(ahead_m - 0.24, 0.0, 0.68), lean=0.70, left=Arm(arm), right=Arm(arm), left_leg=leg,
        right_leg=leg,
    )  # fmt: skip
    return lambda _: posture


def _fallen(t: float) -> Posture:
    """Flat on the front, arms ahead."""
    leg = Leg((-0.86, 0.12, 0.14), (0.3, 0.2, -1.0), 1.4)
    arm = Arm((0.02, 0.22, 0.40), (0.4, 1.0, 0.0))
    return Posture(hips=(0.0, 0.0, 0.17), lean=1.45, nod=-0.35, left=arm, right=arm, left_leg=leg,
                   right_leg=leg)  # fmt: skip


def _stumbling(_: float) -> Posture:
    """About to fall: on the toes, arms thrown forward."""
    arm = Arm((0.46, 0.12, 0.10), (-0.3, 0.6, -0.8))
    return Posture(
        hips=(-0.10, 0.0, 0.72), lean=0.95, nod=-0.3, left=arm, right=arm,
        left_leg=Leg((-0.30, 0.10, ANKLE), pitch=0.3),
        right_leg=Leg((-0.60, 0.10, 0.20), pitch=0.8),
    )  # fmt: skip


_SIT, _GROUND, _LIE = DAILY["sit"], DAILY["sit on ground"], DAILY["lie"]

GETTING_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "sit down": _change(_before_seat, _bend(_BEFORE_SEAT_M), _SIT),
        "stand up": _change(_SIT, _bend(_BEFORE_SEAT_M), _before_seat),
        "sit down on ground": _change(_stand, DAILY["crouch"], _GROUND),
        "stand up from ground": _change(_GROUND, DAILY["crouch"], _stand),
        "lie down": _change(_stand, _GROUND, _LIE, lasts_s=1.1),
        "kneel down": _change(_stand, DAILY["kneel"]),
        "crouch down": _change(_stand, DAILY["crouch"]),
        "fall over": _change(_stand, _stumbling, _fallen, lasts_s=0.7),
    }
)
"""Activity → posture over time."""
