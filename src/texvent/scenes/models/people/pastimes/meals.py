"""Meals: washing up, a grill, food from a plate, a slice in both hands, candles on a cake.

Postures as functions of time, and what they are done with.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.materials import (
    BLUE,
    CHROME,
    DARK,
    RED,
    STEEL,
    WHITE,
    WOOD,
    YELLOW,
    Material,
    glowing,
)
from texvent.scenes.models.people.acts.prop_shapes import Prop, stick, still
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import DOWN, OUT, Arm, Posture
from texvent.scenes.models.people.timing import ease, pulse, swing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, box, post, rod
from texvent.scenes.scene import Colour

_GREEN = Material((0.10, 0.45, 0.16))


def _wash_dishes(t: float) -> Posture:
    """A plate in one hand over the sink, a sponge in the other one goes round on it."""
    angle = 2.0 * math.pi * 0.9 * t
    return Posture(
        hips=(-0.04, 0.0, 0.93), lean=0.28, nod=0.30, tool=(0.3, -0.9, 0.1),
        left=Arm((0.52, 0.14, 1.06), DOWN, True),
        right=Arm((0.50 + 0.07 * math.cos(angle), -0.03, 1.10 + 0.08 * math.sin(angle)), OUT,
                  True),
    )  # fmt: skip


_PLATE = Material((0.80, 0.82, 0.86))
_KITCHEN_SINK = still(
    box(Material((0.55, 0.42, 0.30)), (0.66, 0.0, 0.42), (0.58, 1.2, 0.84)),
    box(Material((0.75, 0.74, 0.70)), (0.66, 0.0, 0.86), (0.62, 1.24, 0.05)),
    box(Material((0.30, 0.33, 0.36)), (0.60, 0.0, 0.888), (0.38, 0.62, 0.008)),
    rod(STEEL, (0.86, 0.0, 0.88), (0.86, 0.0, 1.22), 0.020),
    rod(STEEL, (0.86, 0.0, 1.22), (0.66, 0.0, 1.22), 0.020),
    rod(Material((0.45, 0.70, 0.90), emission=0.15), (0.66, 0.0, 1.21), (0.66, 0.0, 0.89), 0.014),
    *(post(_PLATE, (0.62, -0.46, 0.90 + 0.025 * k), (0.30, 0.30, 0.02)) for k in range(5)),
)
_HELD_PLATE = still(rod(_PLATE, (0.02, -0.10, 0.02), (0.02, -0.12, 0.02), 0.15))
_SPONGE = still(box(Material(YELLOW), (0.0, 0.0, 0.05), (0.13, 0.10, 0.06)))


_PAN_AT: Point = (0.58, -0.04, 0.94)


def _cook(t: float) -> Posture:
    """At a stove: a spoon goes round in a pan, the left hand is at its handle."""
    x, y, z = _PAN_AT
    angle = 2.0 * math.pi * 0.9 * t
    return Posture(
        hips=(-0.06, 0.0, 0.94), lean=0.20, nod=0.28, tool=(0.62, 0.10, -0.85),
        right=Arm((x - 0.20 + 0.07 * math.cos(angle), y - 0.06 + 0.09 * math.sin(angle),
                   z + 0.24), OUT, True),
        left=Arm((x - 0.12, 0.26, z + 0.05), DOWN, True),
    )  # fmt: skip


def _stove(*food: ModelPart) -> Prop:
    """A stove with a pan on it and food in the pan."""
    x, y, z = _PAN_AT
    white, pan = Material((0.78, 0.78, 0.76)), Material((0.05, 0.05, 0.06))
    parts = [
        box(white, (x + 0.06, 0.0, 0.44), (0.60, 0.70, 0.88)),
        box(DARK, (x + 0.06, 0.0, 0.89), (0.60, 0.70, 0.02)),
        box(DARK, (x - 0.245, 0.0, 0.42), (0.01, 0.52, 0.40)),
        box(STEEL, (x - 0.27, 0.0, 0.68), (0.03, 0.50, 0.03)),
        *(rod(_KNOB, (x - 0.25, k, 0.80), (x - 0.28, k, 0.80), 0.03)
          for k in (-0.24, -0.08, 0.08, 0.24)),
        *(post(Material((0.20, 0.05, 0.03)), (x + a, b, 0.905), (0.18, 0.18, 0.01))
          for a, b in ((0.22, 0.2), (0.22, -0.2), (-0.04, 0.2))),
        post(pan, (x, y, z - 0.005), (0.36, 0.36, 0.07)),
        rod(pan, (x - 0.10, y + 0.12, z + 0.01), (x - 0.14, 0.34, z + 0.03), 0.018),
    ]  # fmt: skip
    names = ("oven", "frying pan", "pot")
    return Prop("ground", still(*parts, *food), names, is_own=True)


def _in_pan(*pieces: tuple[Colour, Point, Point]) -> tuple[ModelPart, ...]:
    """Pieces of food: colour, place from the middle of the pan, size."""
    x, y, z = _PAN_AT
    return tuple(ball(Material(colour), (x + a, y + b, z + c), size)
                 for colour, (a, b, c), size in pieces)  # fmt: skip


_BITS = _in_pan(
    *((colour, (0.10 * math.cos(2.4 * k), 0.10 * math.sin(2.4 * k), 0.035), (0.09, 0.09, 0.05))
      for k, colour in enumerate(((0.75, 0.15, 0.05), (0.15, 0.42, 0.10), (0.85, 0.62, 0.15),
                                  (0.45, 0.20, 0.08), (0.80, 0.72, 0.50))))
)  # fmt: skip
_EGGS = _in_pan(
    *(((0.85, 0.84, 0.80), (0.07 * s, 0.07 * s, 0.032), (0.17, 0.17, 0.02)) for s in (1.0, -1.0)),
    *(((0.90, 0.55, 0.05), (0.07 * s, 0.07 * s, 0.045), (0.065, 0.065, 0.04)) for s in (1.0, -1.0)),
)
_SAUSAGES = _in_pan(
    *(((0.45, 0.14, 0.06), (0.08 * k, 0.0, 0.055), (0.06, 0.24, 0.06)) for k in (-1.0, 0.0, 1.0))
)
_MEAT = _in_pan(
    *(((0.50, 0.26, 0.10), (0.08 * s, 0.03 * s, 0.05), (0.16, 0.20, 0.07)) for s in (1.0, -1.0))
)
_GREENS = _in_pan(
    *((colour, (0.11 * math.cos(2.4 * k), 0.11 * math.sin(2.4 * k), 0.04), (0.08, 0.06, 0.05))
      for k, colour in enumerate(((0.12, 0.45, 0.10), (0.85, 0.40, 0.08), (0.20, 0.50, 0.12),
                                  (0.80, 0.12, 0.06), (0.15, 0.40, 0.10), (0.85, 0.75, 0.30))))
)  # fmt: skip


_KNOB = Material((0.30, 0.30, 0.32))
_LADLE = still(rod(WOOD, (0.0, 0.0, -0.08), (0.0, 0.0, 0.30), 0.014),
               ball(WOOD, (0.0, 0.0, 0.31), (0.07, 0.05, 0.08)))  # fmt: skip


def _barbecue(t: float) -> Posture:
    """Tongs turn what is on a grill."""
    up, over = pulse(t, 0.9), swing(t, 0.45)
    return Posture(
        hips=(-0.04, 0.0, 0.94), lean=0.16, nod=0.25, tool=(0.75, 0.15, -0.75),
        right=Arm((0.36, -0.12 + 0.10 * over, 1.12 + 0.12 * up), OUT, True),
        left=Arm((0.20, 0.30, 0.98), OUT, True),
    )  # fmt: skip


def _grill(_: float) -> list[ModelPart]:
    parts = [
        post(DARK, (0.70, 0.0, 0.72), (0.60, 0.60, 0.20)),
        post(STEEL, (0.70, 0.0, 0.83), (0.58, 0.58, 0.02)),
        ball(glowing((1.0, 0.30, 0.05), 0.8), (0.70, 0.0, 0.80), (0.50, 0.50, 0.06)),
        *(rod(DARK, (0.70, 0.0, 0.65), (0.70 + 0.28 * math.cos(a), 0.28 * math.sin(a), 0.0), 0.02)
          for a in (0.5, 2.6, 4.7)),
        *(rod(Material((0.45, 0.16, 0.06)), (0.56 + 0.10 * k, 0.02, 0.86),
              (0.56 + 0.10 * k, 0.20, 0.86), 0.028) for k in range(3)),
        *(ball(Material((0.28, 0.10, 0.05)), (0.60 + 0.18 * k, -0.13, 0.86), (0.15, 0.18, 0.05))
          for k in range(2)),
    ]  # fmt: skip
    return parts


_TONGS = still(rod(STEEL, (0.0, 0.0, -0.06), (0.0, 0.02, 0.30), 0.010),
               rod(STEEL, (0.0, 0.0, -0.06), (0.0, -0.04, 0.30), 0.010))  # fmt: skip


def _to_mouth(t: float) -> float:
    return ease(t * 0.6 % 1.0, 0.05, 0.35) - ease(t * 0.6 % 1.0, 0.55, 0.90)


def _eat_plate(t: float) -> Posture:
    """A plate in the left hand, a fork from it to the mouth and back."""
    up = _to_mouth(t)
    start, end = (0.40, -0.22, -0.08), (0.22, -0.06, 0.18)
    x, y, z = (a + up * (b - a) for a, b in zip(start, end, strict=True))
    return Posture(
        left=Arm((0.38, -0.16, -0.14), DOWN), right=Arm((x, y, z), OUT), nod=0.22 - 0.15 * up,
        tool=(-0.30 * up, -0.85, -0.45 + 0.50 * up),
    )  # fmt: skip


def _eat_slice(t: float) -> Posture:
    """Both hands bring a slice to the mouth."""
    up = _to_mouth(t)
    arm = Arm((0.36 - 0.14 * up, -0.06, -0.14 + 0.36 * up), DOWN)
    return Posture(left=arm, right=arm, nod=0.18)


def _dish(*food: ModelPart) -> Prop:
    plate = post(Material(WHITE), (0.08, 0.0, 0.02), (0.30, 0.30, 0.02))
    return Prop("left hand", still(plate, *food), ("plate",), is_own=True)


_FORK = Prop(
    "right hand",
    still(stick(CHROME, -0.06, 0.14, 0.009),
          *(rod(CHROME, (0.0, y, 0.14), (0.0, y, 0.20), 0.006) for y in (0.018, 0.0, -0.018))),
    ("fork",),
)  # fmt: skip
_PASTA = Material((0.85, 0.65, 0.25))
_NOODLES = tuple(
    ball(_PASTA, (0.08 + 0.05 * math.cos(1.9 * k), 0.06 * math.sin(1.9 * k), 0.05 + 0.008 * k),
         (0.13, 0.12, 0.03)) for k in range(6)
)  # fmt: skip
_CAKE = (
    box(Material((0.25, 0.10, 0.04)), (0.08, 0.0, 0.06), (0.10, 0.16, 0.05)),
    box(Material((0.85, 0.80, 0.70)), (0.08, 0.0, 0.095), (0.10, 0.16, 0.02)),
    box(Material((0.25, 0.10, 0.04)), (0.08, 0.0, 0.13), (0.10, 0.16, 0.05)),
    box(Material((0.85, 0.45, 0.50)), (0.08, 0.0, 0.165), (0.105, 0.165, 0.02)),
    ball(Material(RED), (0.08, 0.04, 0.185), (0.035, 0.035, 0.035)),
)
_MEAL = tuple(
    ball(colour, (0.08 + x, y, 0.05), (0.10, 0.10, 0.06))
    for colour, x, y in ((_GREEN, 0.05, 0.06), (Material((0.30, 0.13, 0.06)), -0.03, 0.05),
                         (Material((0.80, 0.62, 0.20)), 0.02, -0.06), (Material(RED), -0.06, -0.04))
)  # fmt: skip
_SALAD = tuple(
    ball(_GREEN if k % 3 else Material(RED), (0.08 + 0.07 * math.cos(2.4 * k),
                                             0.07 * math.sin(2.4 * k), 0.06), (0.08, 0.07, 0.05))
    for k in range(8)
)  # fmt: skip


def _slice() -> tuple[ModelPart, ...]:
    """Half a disc of red flesh with seeds, its green rind below."""
    parts = []
    for k in range(10):
        z = -0.170 + 0.018 * k
        outer = 2.0 * math.sqrt(max(0.185**2 - z * z, 0.0))
        parts.append(box(_GREEN, (0.05, 0.0, z), (0.034, outer, 0.020)))
        if abs(z) < 0.15:
            inner = 2.0 * math.sqrt(0.155**2 - z * z)
            parts.append(box(Material((0.80, 0.10, 0.10)), (0.05, 0.0, z), (0.046, inner, 0.020)))
    seeds = ((-0.08, -0.03), (0.0, -0.06), (0.08, -0.03), (-0.04, -0.10), (0.05, -0.10))
    parts += [ball(DARK, (0.074, y, z), (0.012, 0.016, 0.026)) for y, z in seeds]
    return tuple(parts)


_BLOWN_S = 0.95
_CAKE_AT: Point = (0.72, 0.0, 0.80)


def _blow_out_cake(t: float) -> Posture:
    """Leans to a cake on a table, hands on its edge."""
    near = ease(t, 0.25, 0.80) - 0.5 * ease(t, 1.4, 1.9)
    return Posture(
        hips=(-0.12 * near, 0.0, 0.93 - 0.03 * near), lean=0.15 + 0.60 * near, nod=-0.25 * near,
        left=Arm((0.42, 0.32, 0.84), OUT, True), right=Arm((0.42, -0.32, 0.84), OUT, True),
    )  # fmt: skip


def _lit_cake(t: float) -> list[ModelPart]:
    """A cake on a table; its candles go out one after the other."""
    x, y, z = _CAKE_AT
    parts = [
        box(WOOD, (x + 0.04, y, z - 0.03), (0.72, 1.2, 0.05)),
        *(rod(WOOD, (x + 0.04 + a, b, 0.0), (x + 0.04 + a, b, z - 0.05), 0.03)
          for a in (0.30, -0.30) for b in (0.54, -0.54)),
        post(Material(WHITE), (x, y, z + 0.005), (0.44, 0.44, 0.02)),
        post(Material((0.80, 0.40, 0.48)), (x, y, z + 0.09), (0.36, 0.36, 0.15)),
        post(Material(WHITE), (x, y, z + 0.17), (0.37, 0.37, 0.02)),
    ]  # fmt: skip
    for k in range(6):
        a = 1.047 * k
        cx, cy = x + 0.12 * math.cos(a), y + 0.12 * math.sin(a)
        parts.append(rod(Material(BLUE), (cx, cy, z + 0.17), (cx, cy, z + 0.29), 0.012))
        gone = _BLOWN_S + 0.07 * k
        size = max(1.0 - ease(t, gone - 0.10, gone), 0.01)
        parts.append(ball(glowing((1.0, 0.60, 0.15), 3.0),
                          (cx + 0.05 * ease(t, 0.7, gone), cy, z + 0.30 + 0.04 * size),
                          (0.045 * size, 0.045 * size, 0.10 * size)))  # fmt: skip
    return parts


_STIRRER = Prop("right hand", _LADLE, ("spoon", "wooden spoon", "spatula"))

MEAL_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "cook": _cook, "cook eggs": _cook, "cook sausages": _cook, "cook meat": _cook,
        "cook vegetables": _cook, "wash dishes": _wash_dishes, "barbecue": _barbecue,
        "eat noodles": _eat_plate,
        "eat cake": _eat_plate, "eat meal": _eat_plate, "eat salad": _eat_plate,
        "eat watermelon": _eat_slice, "blow out cake": _blow_out_cake,
    }
)  # fmt: skip
"""At the table and about it → posture over time."""
MEAL_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "wash dishes": (
            Prop("ground", _KITCHEN_SINK, ("sink", "plate"), is_own=True),
            Prop("left hand", _HELD_PLATE),
            Prop("right hand", _SPONGE, ("sponge",)),
        ),
        "cook": (_stove(*_BITS), _STIRRER),
        "cook eggs": (_stove(*_EGGS), _STIRRER),
        "cook sausages": (_stove(*_SAUSAGES), _STIRRER),
        "cook meat": (_stove(*_MEAT), _STIRRER),
        "cook vegetables": (_stove(*_GREENS), _STIRRER),
        "barbecue": (Prop("ground", _grill, ("grill",), is_own=True), Prop("right hand", _TONGS)),
        "eat noodles": (_FORK, _dish(*_NOODLES)),
        "eat cake": (_FORK, _dish(*_CAKE)),
        "eat meal": (_FORK, _dish(*_MEAL)),
        "eat salad": (_FORK, _dish(*_SALAD)),
        "eat watermelon": (Prop("hands", still(*_slice())),),
        "blow out cake": (Prop("ground", _lit_cake),),
    }
)
"""At the table and about it → what is drawn with it."""
