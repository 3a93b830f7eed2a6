"""What activities need: instruments, tools, balls and boards, drawn with the person."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from texvent.scenes.models.materials import (
    BLUE,
    CHROME,
    DARK,
    ORANGE,
    RED,
    STEEL,
    WHITE,
    WOOD,
    YELLOW,
    Material,
    glowing,
    striped,
)
from texvent.scenes.models.objects.receptacles import CUPS
from texvent.scenes.models.people.acts.at_head import AT_HEAD_PROPS
from texvent.scenes.models.people.acts.chores import CHORE_PROPS
from texvent.scenes.models.people.acts.everyday import EVERYDAY_PROPS
from texvent.scenes.models.people.acts.exercises import EXERCISE_PROPS
from texvent.scenes.models.people.acts.music import MUSIC_PROPS
from texvent.scenes.models.people.acts.pairs import PAIR_PROPS
from texvent.scenes.models.people.acts.play import PLAY_PROPS
from texvent.scenes.models.people.acts.prop_shapes import Draw, Prop, disc, stick, still
from texvent.scenes.models.people.pastimes.care import CARE_PROPS
from texvent.scenes.models.people.pastimes.crafts import CRAFT_PROPS
from texvent.scenes.models.people.pastimes.feats import FEAT_PROPS
from texvent.scenes.models.people.pastimes.meals import MEAL_PROPS
from texvent.scenes.models.people.sports import BOARD_STANCE, DRIBBLE_HZ, JUGGLE_HZ
from texvent.scenes.models.people.work.bench import TABLE_M, usual_bench
from texvent.scenes.models.people.work.tools import TOOLS
from texvent.scenes.models.people.work.verbs import HANDWORK
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, blade, box, post, rod, spike

BAT_REACH, RACKET_REACH, CLUB_REACH = 0.66, 0.48, 0.80
"""From the right palm to where a bat, a racket and a club meet the ball, m."""
_LEATHER = Material((0.10, 0.035, 0.02))
_PALE = Material((0.55, 0.34, 0.14))


BAT = still(stick(_PALE, -0.10, 0.30, 0.016), stick(_PALE, 0.28, 0.80, 0.034))
RACKET = still(
    stick(DARK, -0.08, 0.26, 0.016),
    disc(Material(RED), (0.0, 0.0, RACKET_REACH), (0.27, 0.36), 0.024),
    disc(Material((0.7, 0.7, 0.62)), (0.0, 0.0, RACKET_REACH), (0.22, 0.30), 0.030),
)
CLUB = still(stick(STEEL, -0.16, 0.80, 0.011), box(DARK, (0.04, 0.0, 0.80), (0.12, 0.05, 0.06)))
_SHOVEL = still(stick(WOOD, -0.42, 0.62, 0.018), box(STEEL, (0.0, 0.0, 0.74), (0.05, 0.22, 0.30)))
_BROOM = still(
    stick(WOOD, -0.50, 0.86, 0.014),
    spike(Material(YELLOW), (0.0, 0.0, 1.06), (0.0, 0.0, 0.76), 0.15),
)
_AXE = still(stick(WOOD, -0.12, 0.62, 0.018), box(STEEL, (0.08, 0.0, 0.60), (0.18, 0.03, 0.14)))
_BLOCK = still(
    post(Material((0.22, 0.13, 0.07)), (1.12, 0.0, 0.17), (0.44, 0.44, 0.34)),
    post(Material((0.55, 0.38, 0.20)), (1.12, 0.0, 0.345), (0.40, 0.40, 0.012)),
    rod(Material((0.40, 0.25, 0.12)), (1.12, 0.0, 0.35), (1.12, 0.0, 0.62), 0.10),
)
_CUP = still(post(Material(WHITE), (0.03, 0.0, 0.02), (0.09, 0.09, 0.13)))
_PHONE = still(box(DARK, (0.02, 0.0, 0.05), (0.02, 0.08, 0.17)))
_SCREEN = still(
    box(DARK, (0.03, 0.0, 0.06), (0.02, 0.08, 0.17)),
    box(glowing((0.35, 0.5, 0.75), 0.8), (0.019, 0.0, 0.06), (0.006, 0.07, 0.15)),
)
_MICROPHONE = still(stick(DARK, -0.08, 0.10, 0.018), ball(STEEL, (0.0, 0.0, 0.12), (0.06,) * 3))
_STICK = still(rod(_PALE, (-0.05, 0.0, 0.0), (0.34, 0.0, 0.0), 0.012))
_GLOVE = still(ball(Material(RED), (0.03, 0.0, 0.0), (0.20, 0.16, 0.17)))
_SPOON = still(
    stick(CHROME, -0.06, 0.12, 0.008), ball(CHROME, (0.0, 0.0, 0.14), (0.04, 0.03, 0.06))
)
_BOWL = still(ball(Material((0.55, 0.60, 0.68)), (0.06, 0.0, 0.02), (0.20, 0.20, 0.12)))
_PAD = still(box(Material(WHITE), (0.04, 0.04, 0.03), (0.24, 0.20, 0.02)))
_PEN = still(stick(Material(BLUE), -0.02, 0.12, 0.008))
_BOOK = still(
    box(Material(RED), (0.02, 0.09, 0.04), (0.03, 0.18, 0.26), lean=0.25),
    box(Material(RED), (0.02, -0.09, 0.04), (0.03, 0.18, 0.26), lean=0.25),
    box(Material(WHITE), (0.0, 0.088, 0.045), (0.02, 0.165, 0.24), lean=0.25),
    box(Material(WHITE), (0.0, -0.088, 0.045), (0.02, 0.165, 0.24), lean=0.25),
)
_CAMERA = still(
    box(DARK, (0.04, 0.0, 0.04), (0.09, 0.16, 0.11)),
    rod(STEEL, (0.08, 0.0, 0.04), (0.16, 0.0, 0.04), 0.04),
)
_BARBELL = still(
    rod(STEEL, (0.03, -0.80, 0.0), (0.03, 0.80, 0.0), 0.016),
    *(rod(DARK, (0.03, y, 0.0), (0.03, y + 0.10, 0.0), 0.20) for y in (0.60, -0.70)),
)
_GUITAR = still(
    blade(_PALE, (0.20, -0.32, -0.05), (0.20, 0.02, 0.10), chord=(-0.1, -0.12, 0.26),
          thickness=(0.10, 0.0, 0.0)),
    blade(_PALE, (0.20, -0.10, 0.04), (0.21, 0.16, 0.16), chord=(-0.1, -0.10, 0.20),
          thickness=(0.09, 0.0, 0.0)),
    ball(DARK, (0.245, -0.02, 0.08), (0.02, 0.09, 0.09)),
    rod(_LEATHER, (0.23, 0.06, 0.12), (0.28, 0.56, 0.34), 0.020),
    rod(DARK, (0.28, 0.56, 0.34), (0.29, 0.68, 0.39), 0.032),
)  # fmt: skip
_VIOLIN = still(
    blade(_LEATHER, (0.08, 0.12, 0.47), (0.34, 0.27, 0.47), chord=(-0.09, 0.17, 0.0),
          thickness=(0.0, 0.0, 0.06)),
    rod(DARK, (0.32, 0.26, 0.48), (0.50, 0.36, 0.48), 0.014),
)  # fmt: skip
_BOW = still(stick(_LEATHER, -0.05, 0.60, 0.009))
_FLUTE = still(
    rod(CHROME, (0.06, 0.10, -0.01), (0.10, -0.60, -0.05), 0.020),
    *(ball(DARK, (0.085, -0.18 - 0.07 * k, -0.01 - 0.003 * k), (0.03, 0.03, 0.03))
      for k in range(5)),
)  # fmt: skip
_BRASS = Material((0.80, 0.55, 0.12))
_TRUMPET = still(
    rod(_BRASS, (0.02, 0.0, -0.01), (0.52, 0.0, -0.12), 0.022),
    rod(_BRASS, (0.16, 0.0, -0.10), (0.36, 0.0, -0.15), 0.030),
    spike(_BRASS, (0.66, 0.0, -0.15), (0.36, 0.0, -0.09), 0.12),
)


def _drum(x: float, y: float, z: float, wide: float) -> list[ModelPart]:
    return [post(Material(RED), (x, y, z - 0.10), (wide, wide, 0.22)),
            post(Material(WHITE), (x, y, z + 0.015), (0.98 * wide, 0.98 * wide, 0.02))]  # fmt: skip


_DRUMS = still(
    *_drum(0.56, 0.24, 0.68, 0.36), *_drum(0.56, -0.24, 0.68, 0.36),
    rod(Material(RED), (0.66, -0.001, 0.30), (0.98, 0.001, 0.30), 0.30),
    post(Material(YELLOW), (0.66, 0.62, 1.02), (0.46, 0.46, 0.02)),
    rod(STEEL, (0.66, 0.62, 0.0), (0.66, 0.62, 1.02), 0.012),
    post(Material(YELLOW), (0.66, -0.62, 1.02), (0.46, 0.46, 0.02)),
    rod(STEEL, (0.66, -0.62, 0.0), (0.66, -0.62, 1.02), 0.012),
    post(DARK, (-0.05, 0.0, 0.20), (0.34, 0.34, 0.40)),
)  # fmt: skip
_STOOL = post(DARK, (-0.05, 0.0, 0.20), (0.36, 0.36, 0.40))
_PIANO = still(
    _STOOL, box(DARK, (0.78, 0.0, 0.52), (0.36, 1.40, 1.02)),
    box(DARK, (0.54, 0.0, 0.63), (0.30, 1.40, 0.08)),
    box(Material(WHITE), (0.50, 0.0, 0.675), (0.20, 1.24, 0.02)),
    *(box(DARK, (0.53, -0.56 + 0.16 * k, 0.69), (0.12, 0.06, 0.03)) for k in range(8)),
)  # fmt: skip
_DESK = still(
    _STOOL, box(WOOD, (0.66, 0.0, 0.64), (0.60, 1.10, 0.04)),
    *(rod(WOOD, (x, y, 0.0), (x, y, 0.63), 0.025) for x in (0.42, 0.90) for y in (0.5, -0.5)),
    box(STEEL, (0.58, 0.0, 0.672), (0.26, 0.38, 0.02)),
    box(STEEL, (0.745, 0.0, 0.80), (0.02, 0.38, 0.26), lean=0.25),
    box(glowing((0.35, 0.5, 0.75), 0.9), (0.732, 0.0, 0.80), (0.01, 0.34, 0.22), lean=0.25),
)  # fmt: skip
_ROD = still(stick(DARK, -0.20, 1.9, 0.012),
              rod(Material(WHITE), (0.0, 0.0, 1.88), (1.0, 0.0, 0.9), 0.006))  # fmt: skip
_PADDLE = still(
    stick(WOOD, -0.85, 0.85, 0.016),
    *(disc(Material(ORANGE), (0.0, 0.0, z), (0.20, 0.44), 0.03) for z in (0.98, -0.98)),
)


def _board(size: Point, material: Material, wheels: bool = False) -> Draw:
    """A board under both feet, its nose ahead."""
    long, wide, thick = size
    top = BOARD_STANCE
    parts = [
        box(material, (0.0, 0.0, top - 0.5 * thick), (0.72 * long, wide, thick)),
        ball(material, (0.36 * long, 0.0, top - 0.5 * thick), (0.30 * long, wide, thick)),
        ball(material, (-0.36 * long, 0.0, top - 0.5 * thick), (0.30 * long, wide, thick)),
    ]
    if wheels:
        parts += [
            rod(Material(WHITE), (x, y, 0.03), (x, y + 0.04, 0.03), 0.03)
            for x in (0.26 * long, -0.26 * long)
            for y in (0.34 * wide, -0.34 * wide - 0.04)
        ]
    return still(*parts)


_SKIS = still(
    *(
        part
        for y in (0.12, -0.12)
        for part in (
            box(Material(RED), (0.10, y, 0.02), (1.60, 0.09, 0.025)),
            rod(Material(RED), (0.90, y, 0.02), (1.02, y, 0.10), 0.02),
        )
    )
)
_POLE = still(stick(STEEL, -0.04, 0.85, 0.012))
_LEFT_POLE = still(rod(STEEL, (0.03, 0.0, 0.03), (-0.62, 0.10, -0.55), 0.012))


def _dribbled(t: float) -> list[ModelPart]:
    """Between the right hand and the ground; free flight after each bounce, pushed down again."""
    share = (t * DRIBBLE_HZ) % 1.0
    # The hand has it at the start of each cycle and is lowest in the middle, when it bounces.
    height = 0.12 + 0.72 * abs(math.cos(math.pi * share)) ** 1.3
    surface = striped(ORANGE, (0.05, 0.03, 0.02), 2.0)
    return [ball(surface, (0.66, -0.30, height), (0.24, 0.24, 0.24))]


def _juggled(t: float) -> list[ModelPart]:
    """Three balls in turn from hand to hand, each in free flight half of the time."""
    parts = []
    for index, colour in enumerate((RED, YELLOW, BLUE)):
        cycle = (t * JUGGLE_HZ + index / 1.5) / 2.0 % 1.0
        half, into = divmod(2.0 * cycle, 1.0)
        side = 1.0 if half < 1.0 else -1.0
        across = 0.22 * side * (1.0 - 2.0 * into)
        rise = 4.0 * into * (1.0 - into)
        parts.append(ball(Material(colour), (0.42, across, 1.14 + 0.62 * rise), (0.12,) * 3))
    return parts


_PULLED = still(rod(Material((0.62, 0.48, 0.28)), (-0.16, 0.0, -0.02), (3.2, 0.0, 0.10), 0.026))
IN_HAND = (
    "apple", "orange", "pear", "banana", "tomato", "carrot", "bread", "sandwich", "hamburger",
    "hot dog", "pizza", "donut", "cupcake", "ice cream", "cheese", "sausage", "lollipop", "corn",
    "cucumber", "cookie", "strawberry", "cherry", "lemon", "pizza slice", "croissant",
    "chocolate bar", "waffle", "sushi",
)  # fmt: skip
"""Food that is eaten from the hand."""
_SURFBOARD = _board((2.0, 0.52, 0.07), Material(WHITE))
PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        **AT_HEAD_PROPS,
        **EXERCISE_PROPS,
        **PLAY_PROPS,
        **MUSIC_PROPS,
        **PAIR_PROPS,
        **CHORE_PROPS,
        **EVERYDAY_PROPS,
        **FEAT_PROPS,
        **CARE_PROPS,
        **CRAFT_PROPS,
        **MEAL_PROPS,
        "punch": (),
        "swing bat": (Prop("right hand", BAT, ("baseball bat", "cricket bat")),),
        "swing racket": (
            Prop("right hand", RACKET, ("tennis racket", "badminton racket", "ping-pong paddle")),
        ),
        "swing club": (Prop("right hand", CLUB, ("golf club",)),),
        "dribble": (Prop("ground", _dribbled, ("ball", "basketball", "football", "volleyball")),),
        "juggle": (Prop("ground", _juggled, ("ball",)),),
        "box": (Prop("right hand", _GLOVE), Prop("left hand", _GLOVE)),
        "lift": (Prop("hands", _BARBELL, ("barbell", "dumbbell")),),
        "surf": (Prop("ground", _SURFBOARD, ("surfboard",)),),
        "skate": (Prop("ground", _board((0.86, 0.22, 0.03), _LEATHER, True), ("skateboard",)),),
        "snowboard": (Prop("ground", _board((1.5, 0.28, 0.04), Material(BLUE)), ("snowboard",)),),
        "ski": (
            Prop("ground", _SKIS, ("ski",), is_own=True),
            Prop("right hand", _POLE),
            Prop("left hand", _LEFT_POLE),
        ),
        "row": (Prop("right hand", _PADDLE, ("paddle", "oar")),),
        "play guitar": (Prop("torso", _GUITAR, ("guitar", "electric guitar", "ukulele")),),
        "play drums": (
            Prop("ground", _DRUMS, ("drum", "drum kit")),
            Prop("right hand", _STICK),
            Prop("left hand", _STICK),
        ),
        "play piano": (Prop("ground", _PIANO, ("piano", "grand piano", "music keyboard")),),
        "play violin": (Prop("torso", _VIOLIN, ("violin",), is_own=True), Prop("right hand", _BOW)),
        "play flute": (Prop("mouth", _FLUTE, ("flute",), is_own=True),),
        "play trumpet": (
            Prop("mouth", _TRUMPET, ("trumpet", "saxophone", "clarinet", "trombone"), is_own=True),
        ),
        "pull": (Prop("hands", _PULLED, ("rope", "chain", "hose"), is_own=True),),
        "type": (Prop("ground", _DESK, ("laptop", "keyboard", "desk", "table")),),
        "write": (
            Prop("left hand", _PAD, ("page",)),
            Prop("right hand", _PEN, ("pen", "pencil")),
        ),
        "read": (Prop("hands", _BOOK, ("book", "closed book", "newspaper")),),
        "eat": (
            Prop("right hand", _SPOON, IN_HAND),
            Prop("left hand", _BOWL, ("bowl", *IN_HAND)),
        ),
        "drink": (Prop("right hand", _CUP, CUPS),),
        "phone": (Prop("right hand", _PHONE, ("cell phone",)),),
        "text": (Prop("right hand", _SCREEN, ("cell phone",)),),
        "photograph": (Prop("hands", _CAMERA, ("photo camera", "cell phone")),),
        "sing": (Prop("right hand", _MICROPHONE, ("microphone",)),),
        "dig": (Prop("right hand", _SHOVEL, ("shovel", "spade")),),
        "sweep": (Prop("right hand", _BROOM, ("broom",)),),
        "chop wood": (Prop("right hand", _AXE, ("axe",)), Prop("ground", _BLOCK)),
        "knit": (
            Prop("right hand", still(*TOOLS["needles"].parts)),
            Prop("hands", still(box(Material(RED), (0.02, 0.0, -0.13), (0.03, 0.22, 0.26)))),
        ),
        "fish": (Prop("right hand", _ROD, ("fishing rod",)),),
    }
)
"""Activity → what is drawn with it."""


def list_props(kind: str, size: float = 1.0) -> tuple[Prop, ...]:
    """What comes with an activity; hand work that nothing is named for has a table or a board.

    `size` is that of the body, relative to an adult.
    """
    work = HANDWORK.get(kind)
    if kind in PROPS or work is None:
        return tuple(_scaled(prop, size) for prop in PROPS.get(kind, ()))
    tool = (hand_tool(work.tool),) if work.tool in TOOLS else ()
    if work.place == "hands":
        return tool
    ahead = usual_bench(work).spot[0]
    if work.side == "front":
        return (*tool, _panel(ahead, size, has_holes=work.pattern == "drill"))
    if work.pattern == "scribble":
        return (*tool, table(size * (ahead - _INSET_M), size * TABLE_M), _paper(ahead, size))
    return (*tool, table(size * (ahead - _INSET_M), size * TABLE_M))


def _scaled(prop: Prop, size: float) -> Prop:
    """What the body stands at or wears is as large as the body; what a hand holds is not."""
    if size == 1.0 or prop.anchor not in ("ground", "torso"):
        return prop

    def draw(time_s: float) -> list[ModelPart]:
        return [part.at(size * part.to_body) for part in prop.draw(time_s)]

    return replace(prop, draw=draw)


def hand_tool(name: str) -> Prop:
    """A tool in the right hand: a name of `tools.TOOLS`."""
    return Prop("right hand", still(*TOOLS[name].parts))


def _paper(ahead: float, size: float) -> Prop:
    """A drawing on the table: a sheet with a house, a sun and a line of ground."""
    x, z = size * ahead, size * TABLE_M
    sheet = box(Material(WHITE), (x + 0.02, 0.0, z + 0.004), (0.34, 0.46, 0.008))
    ends = (
        ((-0.08, 0.18), (-0.08, -0.18)), ((-0.08, 0.10), (0.03, 0.10)), ((-0.08, -0.04),
        (0.03, -0.04)), ((0.03, 0.10), (0.11, 0.03)), ((0.11, 0.03), (0.03, -0.04)),
        ((0.03, 0.10), (0.03, -0.04)),
    )  # fmt: skip
    lines = [
        rod(DARK, (x + a, b, z + 0.009), (x + c, d, z + 0.009), 0.005) for (a, b), (c, d) in ends
    ]
    sun = post(Material(YELLOW), (x + 0.12, -0.15, z + 0.009), (0.07, 0.07, 0.006))
    return Prop("ground", still(sheet, *lines, sun), furniture="paper")


def _panel(ahead: float, size: float, *, has_holes: bool = False) -> Prop:
    """An upright board before the body: how far its face is for an adult, m."""
    x, high = size * ahead, size * 1.15
    board = box(Material((0.62, 0.60, 0.55)), (x + 0.02, 0.0, high), (0.03, 1.1, 0.9))
    legs = (rod(WOOD, (x + 0.06, y, 0.0), (x + 0.06, y, 1.3 * high), 0.025) for y in (0.5, -0.5))
    holes = (
        rod(DARK, (x - 0.001, y, high + up), (x + 0.01, y, high + up), 0.032)
        for y, up in ((0.22, 0.14), (0.24, -0.16), (-0.24, 0.16), (-0.22, -0.14), (0.0, 0.26))
    )
    return Prop("ground", still(board, *legs, *(holes if has_holes else ())), furniture="board")


_INSET_M = 0.28
"""From the near edge of a table to where one works on it."""
_TABLE_DEEP, _TABLE_WIDE = 0.62, 1.0


def table(near: float, top: float) -> Prop:
    """A table before the body: where its near edge is and how high its top, m."""
    middle = near + 0.5 * _TABLE_DEEP
    x, y = 0.5 * _TABLE_DEEP - 0.05, 0.5 * _TABLE_WIDE - 0.05
    legs = (
        rod(WOOD, (middle + a * x, b * y, 0.0), (middle + a * x, b * y, top - 0.04), 0.025)
        for a in (1.0, -1.0)
        for b in (1.0, -1.0)
    )
    board = box(WOOD, (middle, 0.0, top - 0.02), (_TABLE_DEEP, _TABLE_WIDE, 0.04))
    return Prop("ground", still(board, *legs), furniture="table")
