"""Instruments that are played seated or before the chest: postures, and the instruments."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.materials import DARK, RED, STEEL, WHITE, WOOD, YELLOW, Material
from texvent.scenes.models.people.acts.prop_shapes import Prop, stick, still
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import ANKLE, OUT, Arm, Leg, Posture
from texvent.scenes.models.people.timing import swing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, post, rod

_BROWN = Material((0.30, 0.12, 0.05))
SEAT_M = 0.50
"""Height of the hips of who sits on the stool, m."""
SITTING = Leg((0.40, 0.16, ANKLE))
STOOL = post(DARK, (-0.05, 0.0, 0.21), (0.36, 0.36, 0.42))


def _cello(t: float) -> Posture:
    """Seated, the bow across the strings before the body."""
    stroke = swing(t, 0.8)
    return Posture(
        hips=(0.0, 0.0, SEAT_M), lean=0.10, nod=0.12, tilt=0.04 * stroke,
        left=Arm((0.36, -0.16, 0.02 + 0.08 * swing(t, 0.45)), OUT),
        right=Arm((0.40, 0.10 + 0.18 * stroke, -0.30), OUT),
        left_leg=Leg((0.40, 0.30, ANKLE), (1.0, 0.6, 0.2)),
        right_leg=Leg((0.40, 0.30, ANKLE), (1.0, 0.6, 0.2)), tool=(0.0, -1.0, 0.05),
    )  # fmt: skip


def _harp(t: float) -> Posture:
    """Seated, both hands pluck in turn."""

    def arm(phase: float) -> Arm:
        pluck = swing(t, 1.1, phase)
        return Arm((0.44 - 0.08 * pluck, -0.08, 0.02 + 0.14 * swing(t, 0.6, phase)), OUT)

    return Posture(hips=(0.0, 0.0, SEAT_M), nod=0.1, left=arm(0.0), right=arm(0.5),
                   left_leg=SITTING, right_leg=SITTING)  # fmt: skip


def _squeeze(t: float) -> float:
    """From the middle to a hand of an accordion, m."""
    return 0.24 + 0.13 * swing(t, 0.6)


def _accordion(t: float) -> Posture:
    out = _squeeze(t) - 0.20
    return Posture(left=Arm((0.30, out, -0.22), OUT), right=Arm((0.30, out, -0.22), OUT),
                   nod=0.12, tilt=0.05 * swing(t, 0.6))  # fmt: skip


def _bellows(t: float) -> list[ModelPart]:
    half = _squeeze(t)
    folds = [box(DARK if k % 2 else Material((0.75, 0.72, 0.65)),
                 (0.30, -half + (k + 0.5) * half / 4.0, 0.21), (0.20, half / 4.2, 0.36))
             for k in range(8)]  # fmt: skip
    return [*folds, *(box(Material(RED), (0.30, s * (half + 0.03), 0.21), (0.24, 0.07, 0.42))
                      for s in (1.0, -1.0))]  # fmt: skip


_CELLO = still(
    STOOL,
    ball(_BROWN, (0.40, 0.0, 0.42), (0.16, 0.44, 0.46)),
    ball(_BROWN, (0.36, 0.0, 0.74), (0.15, 0.34, 0.36)),
    rod(DARK, (0.40, 0.0, 0.80), (0.20, 0.04, 1.36), 0.024),
    rod(STEEL, (0.42, 0.0, 0.22), (0.46, 0.0, 0.0), 0.012),
)
_CELLO_BOW = still(stick(WOOD, -0.04, 0.66, 0.011))
_HARP = still(
    STOOL,
    rod(Material(YELLOW), (0.30, 0.0, 0.10), (0.24, 0.0, 1.15), 0.05),
    rod(Material(YELLOW), (0.92, 0.0, 0.06), (1.02, 0.0, 1.62), 0.04),
    rod(Material(YELLOW), (0.24, 0.0, 1.15), (0.62, 0.0, 1.30), 0.035),
    rod(Material(YELLOW), (0.62, 0.0, 1.30), (1.02, 0.0, 1.62), 0.035),
    rod(Material(YELLOW), (0.30, 0.0, 0.08), (0.94, 0.0, 0.06), 0.06),
    *(rod(Material(WHITE), (0.36 + 0.085 * k, 0.0, 0.10), (0.32 + 0.10 * k, 0.0, 1.16 + 0.055 * k),
          0.007) for k in range(7)),
)  # fmt: skip

MUSIC_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {"play cello": _cello, "play harp": _harp, "play accordion": _accordion}
)
"""Activity → posture over time."""
MUSIC_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "play cello": (
            Prop("ground", _CELLO, ("cello",), is_own=True),
            Prop("right hand", _CELLO_BOW),
        ),
        "play harp": (Prop("ground", _HARP, ("harp",), is_own=True),),
        "play accordion": (Prop("torso", _bellows, ("accordion",), is_own=True),),
    }
)
"""Activity → what is drawn with it."""
