"""Work on the floor with a long tool, and rowing: postures and what they are done with."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.materials import BLUE, DARK, RED, WHITE, WOOD, Material
from texvent.scenes.models.people.acts.prop_shapes import Prop, stick, still
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import ANKLE, OUT, Arm, Leg, Posture
from texvent.scenes.models.people.timing import pulse, swing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, box, post, rod


def _vacuum(t: float) -> Posture:
    """The cleaner goes far forward and back."""
    push = pulse(t, 0.6)
    return Posture(
        hips=(-0.05 + 0.10 * push, 0.0, 0.90), lean=0.18 + 0.16 * push, nod=0.25,
        right=Arm((0.22 + 0.20 * push, -0.06, -0.24), OUT),
        left_leg=Leg((0.22, 0.12, ANKLE)), right_leg=Leg((-0.16, 0.12, ANKLE)),
        tool=(0.62, 0.0, -0.80),
    )  # fmt: skip


def _rake(t: float) -> Posture:
    """Reaches far out and pulls back."""
    out = pulse(t, 0.7)
    return Posture(
        hips=(-0.03, 0.0, 0.88), lean=0.22 + 0.20 * out, nod=0.25,
        right=Arm((0.16 + 0.26 * out, -0.10, -0.16), OUT),
        left=Arm((0.34 + 0.20 * out, -0.20, -0.36), OUT),
        left_leg=Leg((0.20, 0.12, ANKLE)), right_leg=Leg((-0.18, 0.12, ANKLE)),
        tool=(0.75 + 0.30 * out, -0.12, -0.80),
    )  # fmt: skip


_STROKE_HZ = 0.7
_HANDS_UP = 0.66
"""Height of the hands of who rows over the boat's floor, m."""


def _hands_ahead(t: float) -> float:
    return 0.50 - 0.20 * swing(t, _STROKE_HZ)


def _row_oars(t: float) -> Posture:
    """Leans forward and back; both hands pull the oars."""
    pull = swing(t, _STROKE_HZ)
    leg = Leg((0.66, 0.12, 0.14), (0.3, 0.2, 1.0))
    x = _hands_ahead(t)
    return Posture(
        hips=(0.0, 0.0, 0.26), lean=0.12 - 0.34 * pull,
        left=Arm((x, 0.16, _HANDS_UP), OUT, True), right=Arm((x, -0.16, _HANDS_UP), OUT, True),
        left_leg=leg, right_leg=leg,
    )  # fmt: skip


def _oars(t: float) -> list[ModelPart]:
    """From the hands over the sides to the water; the blades go against the hands."""
    x, dip = _hands_ahead(t), 0.12 * swing(t, _STROKE_HZ, 0.25)
    parts = []
    for side in (1.0, -1.0):
        hand, edge = (x, 0.16 * side, _HANDS_UP), (0.40, 0.55 * side, 0.56)
        run = 3.4
        tip = tuple(a + run * (b - a) for a, b in zip(hand, edge, strict=True))
        end: Point = (tip[0], tip[1], tip[2] - 0.20 + dip)
        parts += [rod(WOOD, hand, end, 0.022),
                  ball(Material((0.8, 0.55, 0.25)), end, (0.20, 0.46, 0.08))]  # fmt: skip
    return parts


CHORE_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {"vacuum": _vacuum, "rake": _rake, "row oars": _row_oars}
)
"""Activity → posture over time."""

_CLEANER = still(
    stick(Material((0.35, 0.36, 0.40)), -0.12, 0.62, 0.022),
    rod(Material(RED), (0.0, 0.0, 0.48), (0.0, 0.0, 0.96), 0.095),
    box(DARK, (0.0, 0.0, 1.04), (0.16, 0.36, 0.10)),
)
_STRANDS = tuple(
    rod(Material(WHITE), (0.0, 0.0, 0.84), (0.15 * x, 0.15 * y, 1.06), 0.03)
    for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7))
)
_MOP = still(stick(Material(BLUE), -0.50, 0.86, 0.014), *_STRANDS)
_BUCKET = still(
    post(Material(BLUE), (0.15, 0.62, 0.15), (0.30, 0.30, 0.30)),
    post(Material((0.75, 0.85, 0.9)), (0.15, 0.62, 0.305), (0.25, 0.25, 0.012)),
)
_RAKE = still(
    stick(WOOD, -0.46, 0.96, 0.014),
    box(DARK, (0.0, 0.0, 0.98), (0.03, 0.44, 0.03)),
    *(rod(DARK, (0.0, y, 0.98), (-0.09, y, 1.06), 0.010)
      for y in (-0.21, -0.14, -0.07, 0.0, 0.07, 0.14, 0.21)),
)  # fmt: skip
_LEAF_COLOURS = ((0.75, 0.35, 0.05), (0.70, 0.15, 0.05), (0.75, 0.60, 0.10))
_OF_LEAVES = ("leaf pile", "leaf", "leaves")
_LEAVES = still(
    *(ball(Material(_LEAF_COLOURS[n % 3]),
           (0.95 + 0.045 * ((7 * n) % 11), -0.42 + 0.07 * ((5 * n) % 13), 0.03 + 0.02 * (n % 4)),
           (0.13, 0.09, 0.03)) for n in range(30))
)  # fmt: skip

CHORE_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "vacuum": (Prop("right hand", _CLEANER, ("vacuum cleaner",)),),
        "mop": (Prop("right hand", _MOP, ("mop",)), Prop("ground", _BUCKET, ("bucket",))),
        "rake": (
            Prop("right hand", _RAKE, ("rake",)),
            Prop("ground", _LEAVES, _OF_LEAVES),
        ),
        "row oars": (Prop("ground", _oars),),
    }
)
"""Activity → what is drawn with it."""
