"""What two people do before each other: postures of each, the other one ahead.

`PAIR_GAPS` says how far apart the two stand; the one's hand is then where the other's is.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.materials import WOOD, Material
from texvent.scenes.models.people.acts.prop_shapes import Prop, still
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import ANKLE, DOWN, OUT, Arm, Leg, Posture
from texvent.scenes.models.people.timing import ease, pulse, swing
from texvent.scenes.models.shapes import Point, box, rod

PAIR_GAPS: Mapping[str, float] = MappingProxyType(
    {
        "hug": 0.36, "kiss": 0.41, "shake hands": 0.92, "high five": 0.92, "wrestle": 0.86,
        "arm wrestle": 0.98, "argue": 0.95, "tango": 0.50, "tug of war": 2.1, "give": 0.95,
        "receive": 0.95, "show fists": 1.05, "box": 1.02, "fence": 1.9, "play chess": 1.32,
    }
)  # fmt: skip
"""Activity → distance of two adults who do it before each other, m."""


def _hug(t: float) -> Posture:
    """Arms open, then round the other; they rock from side to side."""
    closed = ease(t, 0.15, 0.75)
    sway = 0.10 * swing(t, 0.5) * closed
    x = 0.30 + 0.14 * closed
    left, right = (Arm((x, side * (0.52 - 0.40 * closed), 1.22 + side * 0.14 * closed), OUT, True)
                   for side in (1.0, -1.0))  # fmt: skip
    return Posture(hips=(-0.10 * (1.0 - closed), 0.0, 0.94), lean=0.04 + 0.12 * closed, tilt=sway,
                   look=0.5 * closed, nod=0.2 * closed, left=left, right=right)  # fmt: skip


def _kiss(t: float) -> Posture:
    """They lean to each other until their faces meet, hands at the other's waist."""
    near = ease(t, 0.1, 0.8) - 0.25 * pulse(t, 0.7) * ease(t, 0.9, 1.2)
    left, right = (Arm((0.40, side * 0.16, 1.02 + 0.14 * side), OUT, True)
                   for side in (1.0, -1.0))  # fmt: skip
    return Posture(hips=(-0.03, 0.0, 0.94), lean=-0.14 + 0.34 * near, nod=-0.10, tilt=0.06 * near,
                   left=left, right=right)  # fmt: skip


def _shake_hands(t: float) -> Posture:
    """The right hands meet in the middle and go up and down."""
    out = ease(t, 0.0, 0.4)
    up = 0.09 * swing(t, 1.4) * ease(t, 0.4, 0.6)
    hand = (0.10 + 0.36 * out, -0.22 + 0.20 * out, 0.80 + 0.26 * out + up)
    return Posture(right=Arm(hand, (-0.4, 0.6, -0.8), True), lean=0.06 * out, nod=0.05)


def _high_five(t: float) -> Posture:
    """The right hands meet above the heads, once in 1.4 s."""
    up = ease(t % 1.4, 0.1, 0.5) - ease(t % 1.4, 0.75, 1.25)
    hand = (0.22 + 0.24 * up, -0.24 + 0.20 * up, 0.95 + 0.77 * up)
    return Posture(right=Arm(hand, OUT, True), lean=0.05 * up, nod=-0.15 * up)


def _wrestle(t: float) -> Posture:
    """Bent forward, hands at the other's shoulders, legs braced."""
    strain = swing(t, 0.9)
    left = Arm((0.50, 0.20, 1.12 + 0.08 * strain), OUT, True)
    right = Arm((0.50, -0.20, 1.02 - 0.08 * strain), OUT, True)
    return Posture(hips=(-0.16, 0.0, 0.74 + 0.03 * swing(t, 1.3)), lean=0.80 + 0.10 * strain,
                   tilt=0.10 * strain, nod=-0.2, left=left, right=right,
                   left_leg=Leg((0.16, 0.20, ANKLE)),
                   right_leg=Leg((-0.50, 0.16, ANKLE + 0.03), pitch=0.4))  # fmt: skip


def _arm_wrestle(t: float) -> Posture:
    """The right hands clasped over a table; they lean to one side and back."""
    side = 0.26 * swing(t, 0.6)
    return Posture(hips=(-0.10, 0.0, 0.86), lean=0.48, nod=-0.3, tilt=0.14 * swing(t, 0.6),
                   right=Arm((0.49, -0.02 + side, 1.16 - 0.7 * abs(side)), (0.2, 0.2, -1.0), True),
                   left=Arm((0.36, 0.30, 0.86), OUT, True))  # fmt: skip


def _argue(t: float) -> Posture:
    """A finger stabs at the other, the free hand flies out, the body leans forward."""
    jab, wave = pulse(t, 1.3), pulse(t, 0.55)
    return Posture(
        lean=0.05 + 0.20 * jab * wave, nod=-0.10 + 0.12 * swing(t, 1.3), look=0.12 * swing(t, 0.5),
        right=Arm((0.26 + 0.22 * jab, -0.04, -0.02 + 0.06 * jab), DOWN), tool=(1.0, 0.0, 0.2),
        left=Arm((0.18, 0.12 + 0.30 * wave, -0.34 + 0.34 * wave), DOWN),
    )  # fmt: skip


def _tango(t: float) -> Posture:
    """One hand at the other's back, the other hands joined beside them."""
    step = swing(t, 1.0)
    return Posture(
        hips=(0.0, 0.0, 0.93 + 0.015 * swing(t, 2.0)), lean=0.03, tilt=0.06 * step,
        right=Arm((0.42, -0.16, 1.18), OUT, True), left=Arm((0.25, 0.56, 1.42), OUT, True),
        left_leg=Leg((0.10 * step, 0.09, ANKLE + 0.05 * max(step, 0.0)), pitch=0.2),
        right_leg=Leg((-0.10 * step, 0.09, ANKLE + 0.05 * max(-step, 0.0)), pitch=0.2),
    )  # fmt: skip


def _fists(t: float) -> Posture:
    """A fist goes up and down before the other's, then both stay."""
    up = pulse(t, 1.4) * (1.0 - ease(t, 2.1, 2.2))
    return Posture(right=Arm((0.40, -0.10, 1.02 + 0.26 * up), (-0.4, 0.7, -0.8), True),
                   left=Arm((0.30, 0.06, 0.98), (-0.4, 0.7, -0.8), True), lean=0.10)  # fmt: skip


def _tug(t: float) -> Posture:
    """Leans back on the heels and pulls with both hands."""
    strain = swing(t, 0.8)
    arm, right = (Arm((0.36, side * 0.05 + 0.06 * side, 0.98), DOWN, True)
                  for side in (1.0, -1.0))  # fmt: skip
    return Posture(hips=(-0.30 - 0.04 * strain, 0.0, 0.74), lean=-0.42 - 0.06 * strain, nod=0.2,
                   left=arm, right=right, left_leg=Leg((0.26, 0.12, ANKLE)),
                   right_leg=Leg((0.04, 0.16, ANKLE)))  # fmt: skip


GIVEN_S = 1.0
"""When a thing goes from hand to hand, s."""


def _reach_to(before: Point, after: Point) -> Movement:
    """The right hand from one place to the middle between the two, and on to another."""

    def move(t: float) -> Posture:
        there, back = ease(t, 0.25, GIVEN_S - 0.05), ease(t, GIVEN_S + 0.05, 1.7)
        hand: Point = (0.47, -0.02, 1.10)
        x, y, z = (a + there * (m - a) + back * (b - m)
                   for a, m, b in zip(before, hand, after, strict=True))  # fmt: skip
        return Posture(right=Arm((x, y, z), (-0.4, 0.7, -0.8), True), lean=0.10 * (there - back))

    return move


_AT_CHEST: Point = (0.28, -0.16, 1.12)
_AT_SIDE: Point = (0.08, -0.24, 0.78)

PAIR_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "hug": _hug, "kiss": _kiss, "shake hands": _shake_hands, "high five": _high_five,
        "wrestle": _wrestle, "arm wrestle": _arm_wrestle, "argue": _argue, "tango": _tango,
        "show fists": _fists, "tug of war": _tug, "give": _reach_to(_AT_CHEST, _AT_SIDE),
        "receive": _reach_to(_AT_SIDE, _AT_CHEST),
    }
)  # fmt: skip
"""Activity → posture of each of the two over time."""

_TABLE = still(
    box(WOOD, (0.49, 0.0, 0.80), (0.52, 0.80, 0.05)),
    *(rod(WOOD, (0.49 + a, b, 0.0), (0.49 + a, b, 0.78), 0.03)
      for a in (0.20, -0.20) for b in (0.34, -0.34)),
)  # fmt: skip
_ROPE = still(rod(Material((0.62, 0.48, 0.28)), (-0.15, 0.0, 0.98), (1.05, 0.0, 0.98), 0.022))

PAIR_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "arm wrestle": (Prop("ground", _TABLE, ("table",)),),
        "tug of war": (Prop("ground", _ROPE, ("rope",)),),
    }
)
"""Activity → what is drawn with each of the two."""
