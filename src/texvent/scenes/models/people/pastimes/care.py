"""Care of the body: washing, nails, brows, a bandage, a tie, a massage, a haircut.

Postures as functions of time, and what they are done with.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.materials import (
    DARK,
    RED,
    STEEL,
    WHITE,
    Material,
    checked,
    striped,
)
from texvent.scenes.models.people.acts.music import SEAT_M, SITTING, STOOL
from texvent.scenes.models.people.acts.prop_shapes import Prop, stick, still
from texvent.scenes.models.people.figure import draw_figure
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.outfit import WOMAN, dress_person
from texvent.scenes.models.people.posture import ANKLE, DOWN, HIP, OUT, Arm, Leg, Posture, solve
from texvent.scenes.models.people.timing import ease, pulse, swing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, box, moved, post, rod, shift, spike

_WATER = Material((0.45, 0.70, 0.90), emission=0.15)


def _fill_brows(t: float) -> Posture:
    """A pencil goes along a brow."""
    along = swing(t, 0.9)
    return Posture(
        right=Arm((0.24, 0.03 + 0.05 * along, 0.31 + 0.01 * along), OUT), tool=(-0.55, -0.75, 0.1),
        look=0.10, nod=-0.05,
    )  # fmt: skip


def _cut_nails(t: float) -> Posture:
    """The left hand is held up before the chest, the right one comes to its fingers and back."""
    near = pulse(t, 0.9)
    return Posture(
        left=Arm((0.34, -0.10, -0.02), DOWN), nod=0.35, look=0.12,
        right=Arm((0.36, -0.06 - 0.12 * near, 0.02), OUT), tool=(0.0, -1.0, 0.05),
    )  # fmt: skip


def _massage_legs(t: float) -> Posture:
    """Seated, both hands go up and down one shin."""

    def hand(phase: float, side: float) -> Point:
        share = 0.5 + 0.42 * swing(t, 0.7, phase)
        return (0.47 + 0.15 * share, 0.13 + side, 0.58 - 0.36 * share)

    return Posture(
        hips=(0.0, 0.0, SEAT_M), lean=0.78 + 0.08 * swing(t, 0.7), nod=0.1,
        left=Arm(hand(0.0, 0.06), OUT, True), right=Arm(hand(0.15, -0.04), OUT, True),
        left_leg=Leg((0.62, 0.13, ANKLE), (1.0, 0.1, 0.6)), right_leg=Leg((0.34, 0.16, ANKLE)),
    )  # fmt: skip


_BASIN: Point = (0.54, 0.0, 0.90)
"""Middle of a washbasin's rim."""


def _wash_hands(t: float) -> Posture:
    """Palms rub each other under the water of a tap."""
    x, _, z = _BASIN
    rub, turn = 0.07 * swing(t, 1.1), 0.04 * swing(t, 1.1, 0.25)
    return Posture(
        hips=(-0.04, 0.0, 0.93), lean=0.30, nod=0.30,
        left=Arm((x - 0.02 + rub, 0.045 + 0.3 * turn, z + 0.13 + turn), DOWN, True),
        right=Arm((x - 0.02 - rub, -0.045, z + 0.13 - turn), DOWN, True),
    )  # fmt: skip


def _shower(t: float) -> Posture:
    """Both hands rub the hair, then the shoulders."""
    low = 0.5 + 0.5 * swing(t, 0.45)
    rub = 0.06 * swing(t, 1.3)
    arm = Arm((0.12 + 0.10 * low, -0.12 + rub, 0.44 - 0.42 * low), OUT)
    right = Arm((0.12 + 0.10 * low, -0.12 - rub, 0.44 - 0.42 * low), OUT)
    return Posture(left=arm, right=right, nod=-0.15 + 0.25 * low, tilt=0.05 * swing(t, 0.6))


def _bandage(t: float) -> Posture:
    """The right hand goes round the left forearm with a roll of bandage."""
    angle = 2.0 * math.pi * 0.8 * t
    return Posture(
        left=Arm((0.38, -0.14, -0.12), DOWN), nod=0.35, look=0.1, tool=(0.0, 0.3, 1.0),
        right=Arm((0.30, -0.24 + 0.10 * math.cos(angle), -0.14 + 0.11 * math.sin(angle)), OUT),
    )  # fmt: skip


def _tie_tie(t: float) -> Posture:
    """Both hands at the knot below the chin; one pulls the long end down."""
    pull = pulse(t, 0.7)
    return Posture(
        left=Arm((0.19, -0.17, 0.02 + 0.03 * pull), OUT), nod=0.25, look=0.08 * swing(t, 0.5),
        right=Arm((0.20, -0.17, -0.04 - 0.20 * pull), OUT),
    )  # fmt: skip


def _tongue_out(t: float) -> Posture:
    return Posture(nod=-0.10 + 0.10 * swing(t, 0.8), look=0.15 * swing(t, 0.4))


def _sit_still(t: float) -> Posture:
    return Posture(
        hips=(0.0, 0.0, SEAT_M), nod=0.10 + 0.20 * swing(t, 0.5), look=0.40 * swing(t, 0.4),
        tilt=0.10 * swing(t, 0.5), left_leg=SITTING, left=Arm((0.36, -0.08, -0.36), DOWN),
        right=Arm((0.36, -0.08, -0.36), DOWN),
        right_leg=SITTING,
    )  # fmt: skip


CARE_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "fill brows": _fill_brows, "cut nails": _cut_nails, "massage legs": _massage_legs,
        "wash hands": _wash_hands, "take shower": _shower, "bandage arm": _bandage,
        "tie tie": _tie_tie, "tongue out": _tongue_out, "get haircut": _sit_still,
    }
)  # fmt: skip
"""Care → posture over time."""

_PENCIL = still(stick(DARK, -0.06, 0.15, 0.013), stick(Material((0.35, 0.18, 0.08)), 0.15, 0.19,
                                                       0.009))  # fmt: skip
_CLIPPER = still(
    box(STEEL, (0.0, 0.0, 0.08), (0.012, 0.03, 0.16)),
    box(STEEL, (0.035, 0.0, 0.05), (0.012, 0.03, 0.14)),
)
_SHOWER_WALL = checked((0.55, 0.72, 0.80), (0.75, 0.85, 0.90), 4.0)
_TIE = still(
    box(striped(RED, (0.02, 0.03, 0.20), 6.0), (0.155, 0.0, 0.26), (0.02, 0.085, 0.34)),
    ball(striped(RED, (0.02, 0.03, 0.20), 6.0), (0.15, 0.0, 0.45), (0.05, 0.07, 0.06)),
)


def _tap(x: float, z: float) -> tuple[ModelPart, ...]:
    """A tap behind a basin, and its water."""
    return (
        rod(STEEL, (x + 0.18, 0.0, z), (x + 0.18, 0.0, z + 0.28), 0.020),
        rod(STEEL, (x + 0.18, 0.0, z + 0.28), (x, 0.0, z + 0.28), 0.020),
        rod(_WATER, (x, 0.0, z + 0.27), (x, 0.0, z), 0.016),
    )


def build_basin() -> tuple[ModelPart, ...]:
    """A washbasin on its foot, with a tap that runs."""
    x, _, z = _BASIN
    white = Material(WHITE)
    return (
        post(white, (x + 0.06, 0.0, 0.5 * z), (0.16, 0.18, z)),
        box(white, (x + 0.02, 0.0, z - 0.06), (0.46, 0.62, 0.12)),
        box(Material((0.55, 0.60, 0.64)), (x - 0.01, 0.0, z + 0.002), (0.32, 0.46, 0.01)),
        *_tap(x, z),
    )


def _lather(t: float) -> list[ModelPart]:
    """White foam about the hands, which goes with them."""
    x, _, z = _BASIN
    turn = 0.04 * swing(t, 1.1, 0.25)
    return [ball(Material(WHITE), (x - 0.02 + a, b, z + 0.13 + c + turn), (0.07,) * 3)
            for a, b, c in ((0.05, 0.03, 0.03), (-0.05, -0.02, 0.02), (0.0, 0.05, -0.02),
                            (0.02, -0.05, 0.03))]  # fmt: skip


def _falling_water(t: float) -> list[ModelPart]:
    """A shower cabin, its head above the hair, and drops on their way down."""
    parts = [
        box(_SHOWER_WALL, (-0.62, 0.0, 1.15), (0.06, 1.5, 2.3)),
        box(Material(WHITE), (0.0, 0.0, 0.02), (1.2, 1.5, 0.04)),
        rod(STEEL, (-0.56, 0.0, 0.9), (-0.56, 0.0, 2.16), 0.02),
        rod(STEEL, (-0.56, 0.0, 2.16), (0.08, 0.0, 2.16), 0.02),
        post(STEEL, (0.08, 0.0, 2.11), (0.30, 0.30, 0.06)),
    ]
    for k in range(26):
        angle, far = 2.4 * k, 0.10 + 0.26 * ((k * 7) % 13) / 13.0
        fall = (1.3 * t + 0.137 * k) % 1.0
        x, y, z = 0.08 + far * math.cos(angle), far * math.sin(angle), 2.06 - 1.9 * fall
        parts.append(rod(_WATER, (x, y, z), (x, y, max(z - 0.16, 0.04)), 0.009))
    return parts


def _wrapped(t: float) -> list[ModelPart]:
    """More and more of the forearm is white."""
    long = 0.07 + 0.12 * ease(t, 0.0, 1.8)
    return [rod(Material(WHITE), (-0.24, 0.0, 0.0), (-0.24 + long, 0.0, 0.0), 0.058)]


def _tongue(t: float) -> list[ModelPart]:
    out = 0.25 + 0.75 * pulse(t, 0.8, 0.5)
    return [ball(Material((0.80, 0.18, 0.22)), (0.02 + 0.035 * out, 0.0, -0.005 - 0.03 * out),
                 (0.03 + 0.07 * out, 0.06, 0.03 + 0.05 * out))]  # fmt: skip


_HAIRDRESSER = dress_person(WOMAN, colour=(0.05, 0.30, 0.32), seed=3)
_BEHIND_M = 0.62


def _hairdresser(t: float) -> list[ModelPart]:
    """Who stands behind the chair and cuts."""
    snip = swing(t, 1.2)
    right: Point = (0.52, -0.17, 1.30 + 0.06 * snip)
    posture = Posture(
        hips=(0.0, 0.0, HIP - 0.02), lean=0.14, nod=0.35, left=Arm((0.52, 0.15, 1.34), OUT, True),
        right=Arm(right, OUT, True), left_leg=Leg((0.04, 0.10, ANKLE)),
        right_leg=Leg((-0.04, 0.10, ANKLE)),
    )  # fmt: skip
    x, y, z = right
    apart = 0.02 + 0.03 * abs(snip)
    scissors = [rod(STEEL, (x, y, z + 0.02), (x + 0.16, y + side * apart, z + 0.04), 0.009)
                for side in (1.0, -1.0)]  # fmt: skip
    figure = draw_figure(WOMAN, _HAIRDRESSER, solve(posture))
    return moved([*figure, *scissors], shift(x=-_BEHIND_M))


_CAPE = still(
    spike(Material((0.75, 0.78, 0.82)), (0.16, 0.0, -0.10), (-0.01, 0.0, 0.62), 0.42),
)
_SEAT = still(STOOL, box(DARK, (-0.22, 0.0, 0.66), (0.06, 0.42, 0.40)))

CARE_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "fill brows": (Prop("right hand", _PENCIL, ("pencil",)),),
        "cut nails": (Prop("right hand", _CLIPPER),),
        "massage legs": (Prop("ground", still(STOOL)),),
        "wash hands": (
            Prop("ground", still(*build_basin()), ("sink",), is_own=True),
            Prop("ground", _lather),
        ),
        "take shower": (Prop("ground", _falling_water, ("shower",), is_own=True),),
        "bandage arm": (
            Prop("left hand", _wrapped),
            Prop("right hand", still(rod(Material(WHITE), (0.02, -0.05, 0.0), (0.02, 0.05, 0.0),
                                         0.05))),
        ),
        "tie tie": (Prop("torso", _TIE, ("tie",), is_own=True),),
        "tongue out": (Prop("mouth", _tongue),),
        "get haircut": (
            Prop("ground", _SEAT),
            Prop("torso", _CAPE),
            Prop("ground", _hairdresser),
        ),
    }
)  # fmt: skip
"""Care → what is drawn with it."""
