"""What hands do at the own head, and what the head does: postures and tools."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from texvent.scenes.models.materials import BLUE, DARK, RED, STEEL, WHITE, Material, glowing
from texvent.scenes.models.people.acts.prop_shapes import Prop, stick, still
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import DOWN, OUT, Arm, Posture
from texvent.scenes.models.people.timing import ease, follow_keys, pulse, swing
from texvent.scenes.models.shapes import Point, ball, box, part_way, rod

_HANGING: Point = (0.06, 0.05, -0.60)


def _stroking(
    spot: Point, stroke: Point, rate_hz: float, tool: Point, *, nod: float = 0.0, look: float = 0.0
) -> Movement:
    """The right hand to and fro about a spot at the head; the tool points to the head."""

    def move(t: float) -> Posture:
        share = swing(t, rate_hz)
        x, y, z = (a + share * b for a, b in zip(spot, stroke, strict=True))
        return Posture(right=Arm((x, y, z), OUT), tool=tool, nod=nod,
                       look=look + 0.08 * swing(t, 0.4))  # fmt: skip

    return move


_COMB = (
    # Right hand forward, outward, up: from the crown down beside the head.
    (0.0, (0.12, -0.02, 0.50)),
    (0.55, (0.12, 0.06, 0.14)),
    (0.80, (0.26, 0.12, 0.24)),
    (1.10, (0.20, 0.04, 0.48)),
)


def _comb(t: float) -> Posture:
    forward, out, up = follow_keys(t, _COMB, 1.3)
    return Posture(right=Arm((forward, out, up), OUT), tool=(-0.35, -0.85, 0.2), look=0.15,
                   left=Arm((0.10, 0.02, 0.06), DOWN))  # fmt: skip


def _both(spot: Point, stroke: Point, rate_hz: float, nod: float, lean: float) -> Movement:
    """Both hands to and fro, in turn."""

    def move(t: float) -> Posture:
        def arm(phase: float) -> Arm:
            share = swing(t, rate_hz, phase)
            x, y, z = (a + share * b for a, b in zip(spot, stroke, strict=True))
            return Arm((x, y, z), OUT)

        return Posture(left=arm(0.0), right=arm(0.3), nod=nod, lean=lean)

    return move


_SNEEZE = (
    # Nod, lean, right hand forward, outward, up.
    (0.0, (-0.10, 0.00, 0.20, -0.05, -0.20)),
    (0.55, (-0.55, -0.14, 0.24, -0.14, 0.16)),
    (0.70, (0.55, 0.42, 0.17, -0.18, 0.22)),
    (0.95, (0.35, 0.25, 0.17, -0.18, 0.22)),
    (1.30, (0.00, 0.00, 0.20, -0.05, -0.20)),
)


def _sneeze(t: float) -> Posture:
    nod, lean, x, y, z = follow_keys(t, _SNEEZE, 1.6)
    return Posture(nod=nod, lean=lean, right=Arm((x, y, z), OUT))


def _yawn(t: float) -> Posture:
    """A hand comes before the mouth, the head goes back, the other arm stretches up."""
    share = ease(t % 2.6, 0.1, 0.8) - ease(t % 2.6, 1.5, 2.3)
    right = part_way(_HANGING, (0.19, -0.16, 0.24), share)
    left = part_way(_HANGING, (-0.05, 0.18, 0.56), share)
    return Posture(right=Arm(right, OUT), left=Arm(left, OUT), nod=-0.50 * share,
                   lean=-0.10 * share)  # fmt: skip


def _cry(t: float) -> Posture:
    """The face in both hands; shoulders shake, the head goes from side to side."""
    sob = swing(t, 1.9)
    arm = Arm((0.18, -0.13, 0.22 + 0.03 * sob), DOWN)
    return Posture(left=arm, right=arm, nod=0.50 + 0.20 * sob, lean=0.24 + 0.12 * sob,
                   look=0.25 * swing(t, 0.45))  # fmt: skip


def _laugh(t: float) -> Posture:
    shake, back = swing(t, 2.1), pulse(t, 0.45)
    return Posture(
        nod=0.22 - 0.60 * back + 0.10 * shake, lean=0.20 - 0.34 * back + 0.04 * shake,
        right=Arm((0.24, -0.16, -0.28 + 0.02 * shake), DOWN),
        left=Arm((0.20, 0.02 + 0.06 * back, -0.28 + 0.02 * shake), DOWN),
    )  # fmt: skip


def _shout(t: float) -> Posture:
    push = pulse(t, 0.9)
    arm = Arm((0.24 + 0.03 * push, -0.06, 0.20), (0.0, 0.7, -1.0))
    return Posture(left=arm, right=arm, lean=-0.10 + 0.36 * push, nod=-0.25 + 0.10 * push,
                   look=0.5 * swing(t, 0.3))  # fmt: skip


def _smoke(t: float) -> Posture:
    share = ease(t * 0.45 % 1.0, 0.05, 0.30) - ease(t * 0.45 % 1.0, 0.55, 0.85)
    hand = part_way((0.34, 0.10, -0.18), (0.19, -0.13, 0.235), share)
    return Posture(right=Arm(hand, OUT), tool=(0.75, 0.25, 0.15), nod=-0.15 * share)


def _blow(t: float) -> Posture:
    """A hand before the mouth; the head comes forward with each breath."""
    out = pulse(t, 0.6)
    return Posture(right=Arm((0.24 + 0.03 * out, -0.12, 0.14), OUT), tool=(0.05, 0.25, 1.0),
                   lean=0.12 * out, nod=-0.10 + 0.16 * out)  # fmt: skip


def _turn_head(t: float) -> Posture:
    """Slowly to its left and right; the shoulders go along a little."""
    side = swing(t, 0.45)
    return Posture(look=1.15 * side, turn=0.18 * side)


def _shrug(t: float) -> Posture:
    up = pulse(t, 0.8)
    hand = part_way((0.20, 0.08, -0.48), (0.24, 0.30, -0.18), up)
    arm = Arm(hand, (-0.4, 0.5, -1.0))
    return Posture(left=arm, right=arm, nod=-0.10 * up, tilt=0.06 * up)


def _facepalm(t: float) -> Posture:
    share = ease(t % 3.0, 0.2, 0.7) - ease(t % 3.0, 2.2, 2.8)
    hand = part_way(_HANGING, (0.19, -0.19, 0.30), share)
    return Posture(right=Arm(hand, OUT), nod=0.55 * share, look=0.2 * share * swing(t, 0.8))


AT_HEAD_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "shave": _stroking((0.16, 0.02, 0.17), (0.03, -0.02, 0.07), 0.8, (-0.3, -0.75, 0.5),
                           look=-0.25),
        "brush teeth": _stroking((0.19, -0.03, 0.225), (0.0, 0.10, 0.02), 1.05,
                                 (-0.30, -0.95, 0.05)),
        "comb hair": _comb,
        "dry hair": _stroking((0.20, 0.22, 0.34), (0.05, 0.02, 0.10), 0.7, (-0.6, -0.9, 0.1)),
        "put on makeup": _stroking((0.20, 0.00, 0.24), (0.01, 0.05, 0.05), 0.9, (-0.45, -0.8, 0.2)),
        "put on lipstick": _stroking((0.20, -0.10, 0.19), (0.0, 0.05, 0.0), 1.0, (-0.5, -0.7, 0.4)),
        "wash face": _both((0.18, -0.12, 0.22), (0.02, 0.02, 0.09), 1.1, 0.35, 0.30),
        "wash hair": _both((0.08, -0.10, 0.46), (0.06, 0.07, 0.03), 1.2, 0.25, 0.05),
        "wipe face": _stroking((0.18, -0.15, 0.32), (0.01, 0.10, 0.03), 0.9, (0.0, 0.0, 1.0)),
        "scratch head": _stroking((0.08, -0.06, 0.42), (0.03, 0.03, 0.05), 1.4, (0.0, 0.0, 1.0),
                                  nod=0.1, look=0.2),
        "facepalm": _facepalm,
        "sneeze": _sneeze,
        "yawn": _yawn,
        "cry": _cry,
        "laugh": _laugh,
        "shout": _shout,
        "smoke": _smoke,
        "blow bubbles": _blow,
        "blow whistle": lambda t: replace(_blow(t), right=Arm((0.24, 0.02, 0.08), OUT)),
        "turn head": _turn_head,
        "nod": lambda t: Posture(nod=0.22 + 0.62 * swing(t, 0.7), lean=0.06 + 0.08 * swing(t, 0.7)),
        "shake head": lambda t: Posture(look=0.70 * swing(t, 0.9)),
        "shrug": _shrug,
    }
)  # fmt: skip
"""Activity at the head → posture over time."""

_RAZOR = still(stick(DARK, -0.06, 0.12, 0.014), box(STEEL, (0.0, 0.0, 0.14), (0.04, 0.09, 0.03)))
_TOOTHBRUSH = still(
    stick(Material(BLUE), -0.07, 0.17, 0.011), box(Material(WHITE), (-0.02, 0.0, 0.16),
                                                  (0.035, 0.03, 0.06)),
)  # fmt: skip
_COMB_TOOL = still(
    box(DARK, (0.0, 0.0, 0.06), (0.02, 0.03, 0.24)),
    *(box(DARK, (-0.03, 0.0, 0.02 + 0.025 * k), (0.06, 0.02, 0.012)) for k in range(7)),
)
_DRYER = still(
    rod(Material(RED), (0.0, 0.0, -0.06), (0.0, 0.0, 0.08), 0.026),
    rod(Material(RED), (-0.08, 0.0, 0.10), (0.12, 0.0, 0.10), 0.050),
    rod(DARK, (0.12, 0.0, 0.10), (0.18, 0.0, 0.10), 0.036),
)
_BRUSH = still(
    stick(DARK, -0.05, 0.12, 0.010),
    ball(Material((0.75, 0.35, 0.40)), (0.0, 0.0, 0.14), (0.05, 0.05, 0.06)),
)
_LIPSTICK = still(stick(DARK, -0.05, 0.06, 0.018), stick(Material(RED), 0.06, 0.12, 0.013))
_CIGARETTE = still(
    stick(Material(WHITE), -0.02, 0.13, 0.011), stick(glowing((1.0, 0.35, 0.08), 1.5), 0.13, 0.15,
                                                      0.013),
)  # fmt: skip
_WAND = still(
    stick(Material(RED), -0.08, 0.05, 0.009),
    *(ball(Material(RED), (0.0, 0.045 * math.sin(a), 0.095 + 0.045 * math.cos(a)), (0.024,) * 3)
      for a in (0.524 * k for k in range(12))),
)  # fmt: skip
_WHISTLE = still(
    rod(Material(RED), (0.08, -0.018, -0.01), (0.08, 0.018, -0.01), 0.030),
    box(Material(RED), (0.045, 0.0, 0.010), (0.08, 0.034, 0.022)),
)
_LATHER = still(
    *(ball(Material(WHITE), place, (0.10, 0.10, 0.08))
      for place in ((0.0, 0.05, 0.08), (0.02, -0.05, 0.08), (-0.05, 0.0, 0.09), (0.05, 0.0, 0.07)))
)  # fmt: skip
_FOAM = still(ball(Material(WHITE), (-0.015, 0.0, -0.045), (0.08, 0.15, 0.10)))

AT_HEAD_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "shave": (Prop("right hand", _RAZOR, ("razor",)), Prop("mouth", _FOAM)),
        "brush teeth": (Prop("right hand", _TOOTHBRUSH, ("toothbrush",)),),
        "comb hair": (Prop("right hand", _COMB_TOOL, ("comb", "hairbrush")),),
        "dry hair": (Prop("right hand", _DRYER, ("hair drier",)),),
        "put on makeup": (Prop("right hand", _BRUSH),),
        "put on lipstick": (Prop("right hand", _LIPSTICK, ("lipstick",)),),
        "wash hair": (Prop("crown", _LATHER),),
        "blow bubbles": (Prop("right hand", _WAND),),
        "blow whistle": (Prop("mouth", _WHISTLE, ("whistle",), is_own=True),),
        "smoke": (Prop("right hand", _CIGARETTE, ("cigarette",)),),
    }
)
"""Activity at the head → what is drawn with it."""
