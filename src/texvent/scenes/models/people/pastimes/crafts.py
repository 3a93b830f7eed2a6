"""Crafts, chores and games with things that come along: a potter's wheel, cards, a remote.

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
from texvent.scenes.models.people.acts.music import SEAT_M, STOOL
from texvent.scenes.models.people.acts.prop_shapes import Prop, stick, still
from texvent.scenes.models.people.daily import DAILY
from texvent.scenes.models.people.gestures import Movement
from texvent.scenes.models.people.posture import ANKLE, DOWN, OUT, Arm, Leg, Posture, solve
from texvent.scenes.models.people.timing import ease, pulse, swing
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, box, post, rod
from texvent.scenes.scene import Colour

_GREEN = Material((0.08, 0.40, 0.10))
_CLAY = Material((0.45, 0.22, 0.12))
_WHEEL: Point = (0.56, 0.0, 0.62)
"""Middle of a potter's wheel."""


def _pot_m(t: float, share: float) -> float:
    """Radius of a pot at a share of its height: it grows and narrows at the neck."""
    belly = 0.13 + 0.03 * swing(t, 0.4)
    return belly * (0.72 + 0.45 * math.sin(2.6 * share) - 0.28 * share * share)


def _make_pottery(t: float) -> Posture:
    """Seated astride a turning wheel, both hands at the sides of the pot."""
    x, _, z = _WHEEL
    share = 0.5 + 0.40 * swing(t, 0.4)
    side = _pot_m(t, share) + 0.035
    leg = Leg((0.46, 0.34, ANKLE), (1.0, 0.8, 0.2))
    return Posture(
        hips=(0.0, 0.0, SEAT_M), lean=0.38, nod=0.25,
        left=Arm((x - 0.02, side, z + 0.06 + 0.34 * share), OUT, True),
        right=Arm((x - 0.02, -side, z + 0.06 + 0.34 * share), OUT, True), left_leg=leg,
        right_leg=leg,
    )  # fmt: skip


def _pot(t: float) -> list[ModelPart]:
    x, y, z = _WHEEL
    angle = 2.0 * math.pi * 0.9 * t
    parts = [
        STOOL,
        post(Material((0.30, 0.31, 0.33)), (x, y, 0.5 * z), (0.40, 0.40, z)),
        post(STEEL, (x, y, z + 0.02), (0.46, 0.46, 0.04)),
    ]
    for k in range(9):
        wide = 2.0 * _pot_m(t, k / 8.0)
        parts.append(post(_CLAY, (x, y, z + 0.06 + 0.042 * k), (wide, wide, 0.044)))
    for k in range(3):
        a = angle + 2.094 * k
        parts.append(ball(DARK, (x + 0.20 * math.cos(a), y + 0.20 * math.sin(a), z + 0.045),
                          (0.06, 0.06, 0.02)))  # fmt: skip
    return parts


def _sharpen(t: float) -> Posture:
    """A knife goes to and fro along a steel."""
    stroke = swing(t, 0.9)
    return Posture(
        left=Arm((0.34, -0.02, -0.14), DOWN), nod=0.30, look=-0.05,
        right=Arm((0.38, -0.08 - 0.02 * stroke, -0.02 + 0.12 * stroke), OUT),
        tool=(0.25, -0.85, 0.45 - 0.20 * stroke),
    )  # fmt: skip


def _count_money(t: float) -> Posture:
    """The right hand takes one note after the other from those in the left hand."""
    off = pulse(t, 0.9)
    return Posture(
        left=Arm((0.36, -0.14, -0.06), DOWN), nod=0.35, tool=(0.0, 0.1, 1.0),
        right=Arm((0.38, -0.14 + 0.20 * off, -0.04 + 0.05 * math.sin(math.pi * off)), OUT),
    )  # fmt: skip


def _shuffle(t: float) -> Posture:
    """Cards spring from one hand to the other."""
    far = 0.11 + 0.06 * pulse(t, 0.8)
    return Posture(
        left=Arm((0.38, far, 1.05 - 0.4 * far), DOWN, True), nod=0.40,
        right=Arm((0.38, -far, 1.10 + 0.8 * far), OUT, True), tool=(0.0, 0.0, 1.0),
    )  # fmt: skip


def _cards(t: float) -> list[ModelPart]:
    """A pack in each hand and cards on their way between them."""
    hands = solve(_with_legs(_shuffle(t))).hands
    (ax, ay, az), (bx, by, bz) = hands[1], hands[0]
    parts = [box(Material(WHITE), (x + 0.07, y, z), (0.11, 0.04, 0.16))
             for x, y, z in (hands[0], hands[1])]  # fmt: skip
    for k in range(7):
        u = (1.6 * t + k / 7.0) % 1.0
        bow = 0.22 * u * (1.0 - u)
        place = (ax + 0.07 + u * (bx - ax), ay + u * (by - ay), az + u * (bz - az) + bow)
        parts.append(box(Material(RED if k % 2 else WHITE), place, (0.11, 0.10, 0.008)))
    return parts


def _with_legs(posture: Posture) -> Posture:
    """A posture of the arms as that of who stands."""
    return Posture(**{**posture.__dict__, "left_leg": Leg(), "right_leg": Leg()})


def _bent(t: float) -> float:
    return pulse(t, 0.45)


def _bend_metal(t: float) -> Posture:
    """Both hands force the ends of a bar together."""
    bend = _bent(t)
    shake = 0.012 * swing(t, 3.0)
    side = 0.36 - 0.12 * bend
    return Posture(
        hips=(0.0, 0.0, 0.91), lean=0.10 + 0.12 * bend, nod=0.20 * bend,
        left=Arm((0.36, side, 1.14 + shake), OUT, True),
        right=Arm((0.36, -side, 1.14 - shake), OUT, True),
        left_leg=Leg((0.08, 0.18, ANKLE)), right_leg=Leg((-0.08, 0.18, ANKLE)),
    )  # fmt: skip


def _bar(t: float) -> list[ModelPart]:
    bend = _bent(t)
    middle: Point = (0.40, 0.0, 1.14 - 0.30 * bend)
    parts = []
    for side in (1.0, -1.0):
        hand = (0.40, side * (0.36 - 0.12 * bend), 1.14)
        end: Point = tuple(a + 1.35 * (b - a) for a, b in zip(middle, hand, strict=True))  # type: ignore[assignment]
        parts.append(rod(STEEL, middle, end, 0.026))
    return parts


def _do_laundry(t: float) -> Posture:
    """On the knees, the right hand puts clothes from a basket into a washing machine."""
    into = pulse(t, 0.6)
    leg = Leg((-0.34, 0.11, 0.08), (1.0, 0.1, -0.5), 2.4)
    x, y, z = 0.44, -0.02 - 0.52 * into, 0.40 + 0.28 * math.sin(math.pi * into) + 0.12 * into
    return Posture(
        hips=(0.0, 0.0, 0.48), lean=0.20, turn=-0.5 * into, nod=0.25, look=-0.3 * into,
        left=Arm((0.42, 0.20, 0.40), DOWN, True), right=Arm((x, y, z), OUT, True),
        left_leg=leg, right_leg=leg,
    )  # fmt: skip


_MACHINE = still(
    box(Material(WHITE), (0.12, -0.74, 0.46), (0.56, 0.62, 0.92)),
    rod(STEEL, (0.40, -0.74, 0.48), (0.43, -0.74, 0.48), 0.22),
    rod(DARK, (0.43, -0.74, 0.48), (0.435, -0.74, 0.48), 0.17),
    box(Material((0.45, 0.48, 0.52)), (0.405, -0.74, 0.82), (0.01, 0.50, 0.10)),
    post(Material(YELLOW), (0.46, 0.18, 0.14), (0.44, 0.44, 0.28)),
    *(ball(Material(colour), (0.46 + x, 0.18 + y, 0.29), (0.20, 0.18, 0.12))
      for colour, x, y in ((BLUE, 0.07, 0.06), (RED, -0.06, 0.07), (WHITE, 0.0, -0.08))),
)  # fmt: skip
_CLOTH = still(ball(Material(BLUE), (0.03, 0.0, -0.05), (0.20, 0.13, 0.24)))


def _play_wii(t: float) -> Posture:
    """Stands before a screen and swings a remote."""
    stroke = swing(t, 0.85)
    return Posture(
        hips=(0.0, 0.0, 0.90), lean=0.12, turn=0.35 * stroke,
        right=Arm((0.36, 0.12 - 0.28 * stroke, 0.05 + 0.26 * stroke), OUT),
        left=Arm((0.26, 0.14, -0.24), DOWN), tool=(0.9, 0.35 - 0.6 * stroke, 0.35 + 0.4 * stroke),
        left_leg=Leg((0.12, 0.16, ANKLE)), right_leg=Leg((-0.12, 0.16, ANKLE)),
    )  # fmt: skip


_REMOTE = still(box(Material(WHITE), (0.0, 0.0, 0.05), (0.045, 0.055, 0.24)),
                box(Material(BLUE), (0.0, 0.0, 0.10), (0.05, 0.03, 0.04)))  # fmt: skip
SCREEN = still(
    box(DARK, (1.75, 0.0, 1.05), (0.08, 1.25, 0.76)),
    box(glowing((0.25, 0.55, 0.85), 0.8), (1.706, 0.0, 1.05), (0.01, 1.15, 0.66)),
    ball(Material(RED), (1.69, 0.22, 0.98), (0.02, 0.16, 0.20)),
    ball(Material(YELLOW), (1.69, -0.25, 1.16), (0.02, 0.16, 0.16)),
    box(WOOD, (1.78, 0.0, 0.34), (0.36, 1.3, 0.62)),
)
"""A television with a game on it, ahead of who plays."""


_VASE: Point = (0.58, 0.10, 0.84)
_STEMS = ((RED, 0.05, 0.02), (YELLOW, -0.06, 0.05), (WHITE, 0.01, -0.06), (RED, -0.04, -0.03))


def _arranging(t: float) -> tuple[float, Point]:
    """How far a flower is from the table to the vase, and where the right hand is."""
    share = ease(t % 2.2, 0.2, 1.0) - ease(t % 2.2, 1.4, 2.1)
    x, y, z = _VASE
    start, end = (0.46, -0.36, z + 0.08), (x - 0.02, y - 0.06, z + 0.44)
    a, b, c = (p + share * (q - p) for p, q in zip(start, end, strict=True))
    return share, (a, b, c + 0.16 * math.sin(math.pi * share))


def _arrange_flowers(t: float) -> Posture:
    """The right hand puts one flower after the other into a vase on a table."""
    _, hand = _arranging(t)
    x, y, z = _VASE
    return Posture(
        hips=(-0.04, 0.0, 0.94), lean=0.20, nod=0.25, tool=(0.2, -0.1, 1.0),
        left=Arm((x - 0.04, y + 0.12, z + 0.20), OUT, True), right=Arm(hand, OUT, True),
    )  # fmt: skip


def _flower(colour: Colour, foot: Point, head: Point) -> list[ModelPart]:
    petals = [ball(Material(colour), (head[0], head[1] + 0.045 * math.cos(a),
                                      head[2] + 0.045 * math.sin(a)), (0.05, 0.06, 0.06))
              for a in (0.0, 1.26, 2.51, 3.77, 5.03)]  # fmt: skip
    return [rod(_GREEN, foot, head, 0.008), *petals, ball(Material(YELLOW), head, (0.06,) * 3)]


def _bouquet(t: float) -> list[ModelPart]:
    """A table, a vase with flowers, and the flower in the hand."""
    x, y, z = _VASE
    parts = [
        box(WOOD, (x + 0.04, 0.0, z - 0.03), (0.62, 1.1, 0.05)),
        *(rod(WOOD, (x + 0.04 + a, b, 0.0), (x + 0.04 + a, b, z - 0.05), 0.03)
          for a in (0.26, -0.26) for b in (0.50, -0.50)),
        post(Material((0.30, 0.50, 0.70)), (x, y, z + 0.13), (0.14, 0.14, 0.26)),
    ]  # fmt: skip
    for colour, a, b in _STEMS:
        parts += _flower(colour, (x, y, z + 0.20), (x + 2.0 * a, y + 2.0 * b, z + 0.46 + a))
    _, (hx, hy, hz) = _arranging(t)
    return parts + _flower(RED, (hx + 0.04, hy, hz - 0.16), (hx + 0.06, hy - 0.02, hz + 0.16))


def _type_on_lap(t: float) -> Posture:
    """Both hands on the keys of a laptop on the lap."""

    def arm(phase: float) -> Arm:
        return Arm((0.36, -0.08 + 0.09 * swing(t, 0.7, phase), -0.16 + 0.09 * swing(t, 1.1, phase)),
                   DOWN)  # fmt: skip

    return Posture(
        left=arm(0.0), right=arm(0.5), nod=0.30 + 0.12 * swing(t, 0.5), look=0.2 * swing(t, 0.4)
    )


_LAPTOP = still(
    box(STEEL, (0.06, 0.0, -0.05), (0.28, 0.40, 0.02)),
    box(STEEL, (0.21, 0.0, 0.09), (0.02, 0.40, 0.27), lean=0.25),
    box(glowing((0.35, 0.5, 0.75), 0.9), (0.198, 0.0, 0.09), (0.01, 0.36, 0.23), lean=0.25),
)


def _drawn_up(t: float) -> float:
    """How far up the bed its blanket reaches, m from the middle."""
    return 0.10 + 0.42 * (ease(t % 2.6, 0.2, 1.3) - ease(t % 2.6, 1.9, 2.5))


def _make_bed(t: float) -> Posture:
    """Bent over a bed from its side, both hands draw the blanket up."""
    y = _drawn_up(t)
    return Posture(
        hips=(-0.08, 0.25 * y, 0.90), lean=0.62, nod=0.1,
        left=Arm((0.64, y + 0.02, 0.62), OUT, True),
        right=Arm((0.60, y - 0.28, 0.62), OUT, True), left_leg=Leg((0.10, 0.14, ANKLE)),
        right_leg=Leg((-0.10, 0.14, ANKLE)),
    )  # fmt: skip


def _bed(t: float) -> list[ModelPart]:
    end = _drawn_up(t) + 0.04
    return [
        box(WOOD, (0.96, 0.0, 0.22), (1.10, 2.04, 0.26)),
        box(WOOD, (0.96, 1.03, 0.30), (1.10, 0.07, 0.60)),
        box(Material(WHITE), (0.96, 0.0, 0.42), (1.06, 1.98, 0.18)),
        *(ball(Material(WHITE), (x, 0.74, 0.55), (0.44, 0.34, 0.18)) for x in (0.70, 1.22)),
        box(Material(BLUE), (0.96, 0.5 * (end - 0.99), 0.53), (1.14, end + 0.99, 0.05)),
        box(Material(BLUE), (0.40, 0.5 * (end - 0.99), 0.40), (0.04, end + 0.99, 0.28)),
    ]


_SPADE = still(stick(WOOD, -0.42, 0.62, 0.018), box(STEEL, (0.0, 0.0, 0.74), (0.05, 0.22, 0.30)))
_EARTH = Material((0.20, 0.11, 0.06))
_SAPLING = still(
    ball(_EARTH, (0.98, 0.30, 0.02), (0.62, 0.56, 0.22)),
    ball(_EARTH, (0.80, -0.34, 0.02), (0.42, 0.36, 0.26)),
    rod(WOOD, (0.98, 0.30, 0.05), (0.98, 0.30, 0.95), 0.030),
    *(ball(_GREEN, (0.98 + x, 0.30 + y, z), (0.38, 0.36, 0.34))
      for x, y, z in ((0.0, 0.0, 1.22), (0.14, 0.06, 1.02), (-0.12, 0.08, 1.04),
                      (0.02, -0.14, 1.0))),
)  # fmt: skip


def _lift_trophy(t: float) -> Posture:
    """Both hands raise a cup from the chest to above the head."""
    up = ease(t, 0.2, 0.9) - 0.35 * pulse(t, 0.8) * ease(t, 0.9, 1.1)
    left, right = (Arm((0.36 - 0.16 * up, side * 0.10, 1.12 + 0.66 * up), OUT, True)
                   for side in (1.0, -1.0))  # fmt: skip
    return Posture(left=left, right=right, nod=-0.25 * up)


_GOLD = Material((0.85, 0.60, 0.10))
_TROPHY = still(
    post(DARK, (0.03, 0.0, -0.10), (0.16, 0.16, 0.06)),
    rod(_GOLD, (0.03, 0.0, -0.08), (0.03, 0.0, 0.04), 0.025),
    *(post(_GOLD, (0.03, 0.0, 0.05 + 0.035 * k), (0.10 + 0.025 * k,) * 2 + (0.037,))
      for k in range(6)),
    *(rod(_GOLD, (0.03, s * 0.11, 0.06), (0.03, s * 0.17, 0.20), 0.014) for s in (1.0, -1.0)),
)  # fmt: skip

CRAFT_MOVEMENTS: Mapping[str, Movement] = MappingProxyType(
    {
        "make pottery": _make_pottery, "sharpen knife": _sharpen, "count money": _count_money,
        "shuffle cards": _shuffle, "bend metal": _bend_metal, "do laundry": _do_laundry,
        "arrange flowers": _arrange_flowers, "plant tree": DAILY["dig"],
        "make bed": _make_bed,
        "type on lap": _type_on_lap, "play wii": _play_wii, "lift trophy": _lift_trophy,
    }
)  # fmt: skip
"""Craft → posture over time."""

_NOTE = Material((0.25, 0.50, 0.28))
_KNIFE = still(stick(DARK, -0.06, 0.08, 0.018), box(CHROME, (0.0, 0.0, 0.22), (0.055, 0.010, 0.28)))
_STEEL = still(rod(DARK, (0.0, 0.0, -0.08), (0.0, 0.0, 0.06), 0.020),
               rod(STEEL, (0.0, 0.0, 0.06), (0.0, 0.0, 0.36), 0.012))  # fmt: skip

CRAFT_PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "make pottery": (Prop("ground", _pot, ("potter wheel",), is_own=True),),
        "sharpen knife": (Prop("right hand", _KNIFE, ("knife",)), Prop("left hand", _STEEL)),
        "count money": (
            Prop("left hand", still(*(box(_NOTE, (0.03 + 0.008 * k, 0.0, 0.06), (0.006, 0.22, 0.11))
                                      for k in range(4)))),
            Prop("right hand", still(box(_NOTE, (0.03, 0.0, 0.05), (0.006, 0.22, 0.11)))),
        ),
        "shuffle cards": (Prop("ground", _cards),),
        "bend metal": (Prop("ground", _bar),),
        "do laundry": (
            Prop("ground", _MACHINE, ("washing machine", "clothesline"), is_own=True),
            Prop("right hand", _CLOTH),
        ),
        "type on lap": (Prop("hands", _LAPTOP, ("laptop",), is_own=True),),
        "make bed": (Prop("ground", _bed, ("bed",), is_own=True),),
        "plant tree": (
            Prop("right hand", _SPADE, ("shovel", "spade")),
            Prop("ground", _SAPLING, ("tree",), is_own=True),
        ),
        "arrange flowers": (Prop("ground", _bouquet, ("vase", "table")),),
        "play wii": (
            Prop("right hand", _REMOTE, ("remote", "game controller")),
            Prop("ground", SCREEN, ("tv",), is_own=True, is_shared=True),
        ),
        "lift trophy": (Prop("hands", _TROPHY, ("trophy",)),),
    }
)  # fmt: skip
"""Craft → what is drawn with it."""
