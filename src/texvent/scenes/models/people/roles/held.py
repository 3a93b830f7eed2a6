"""What people of a trade or a sport have with them, unless their act or the prompt says otherwise.

Anchors are those of `people.anchors`. A thing in a hand is left out where the hand is busy.
"""

from __future__ import annotations

from collections.abc import Mapping
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
)
from texvent.scenes.models.people import props
from texvent.scenes.models.people.acts.prop_shapes import Prop
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, blade, box, limb, post, rod, spike


def _in(anchor: str, *parts: ModelPart, same: tuple[str, ...] = ()) -> Prop:
    return Prop(anchor, lambda _: parts, same)


def _stick(material: Material, low: float, high: float, radius: float) -> ModelPart:
    return rod(material, (0.0, 0.0, low), (0.0, 0.0, high), radius)


def _upright_board(colour: Material, long: float, wide: float) -> Prop:
    """A board carried under the left arm, its nose ahead."""
    low, high = (-0.5 * long, 0.34, -0.02), (0.5 * long, 0.34, 0.06)
    return _in(
        "torso",
        blade(colour, low, high, chord=(0.0, 0.0, wide), thickness=(0.0, 0.07, 0.0)),
        limb(
            Material((0.55, 0.03, 0.02)),
            (low[0] + 0.1, 0.36, low[2]),
            (high[0] - 0.1, 0.36, high[2]),
            0.02,
        ),
        same=("surfboard", "snowboard", "skateboard"),
    )


def _glove(colour: Point) -> tuple[Prop, Prop]:
    glove = ball(Material(colour), (0.04, 0.0, 0.0), (0.24, 0.19, 0.20))
    return _in("right hand", glove), _in("left hand", glove)


_LEATHER = Material((0.16, 0.06, 0.02))
_TENNIS = Prop(
    "right hand", props.RACKET, ("tennis racket", "badminton racket", "ping-pong paddle")
)
_BAT = Prop("right hand", props.BAT, ("baseball bat", "cricket bat"))
_CLUB = Prop("right hand", props.CLUB, ("golf club",))
_MITT = _in(
    "left hand",
    ball(_LEATHER, (0.05, 0.0, 0.03), (0.09, 0.24, 0.26)),
    *(limb(_LEATHER, (0.05, y, 0.08), (0.07, 1.3 * y, z), 0.032)
      for y, z in ((-0.09, 0.20), (-0.03, 0.24), (0.03, 0.24), (0.09, 0.20))),
    ball(Material((0.07, 0.025, 0.01)), (0.09, 0.0, 0.04), (0.05, 0.15, 0.16)),
    same=("baseball glove",),
)  # fmt: skip
_HOCKEY_STICK = _in(
    "right hand",
    _stick(WOOD, -0.35, 0.95, 0.020),
    rod(Material(DARK.colour), (0.0, 0.0, 0.95), (0.30, 0.0, 1.02), 0.04, side_radius=0.02),
    same=("hockey stick",),
)
_SKATES = _in(
    "ground",
    *(box(CHROME, (0.03, y, 0.012), (0.34, 0.02, 0.024)) for y in (0.08, -0.08)),
    same=("ice skate",),
)
_LADLE = _in(
    "right hand",
    _stick(WOOD, -0.10, 0.26, 0.014),
    ball(WOOD, (0.0, 0.0, 0.30), (0.08, 0.06, 0.08)),
    same=("spoon", "knife"),
)
_TRAY = _in(
    "left hand",
    post(Material((0.5, 0.5, 0.52)), (0.10, 0.02, 0.06), (0.44, 0.44, 0.02)),
    *(
        post(Material((0.75, 0.55, 0.15)), (x, y, 0.14), (0.07, 0.07, 0.15))
        for x, y in ((0.05, 0.08), (0.17, -0.06))
    ),
    same=("tray", "plate", "glass", "cup"),
)
_CANE = _in(
    "right hand",
    rod(WOOD, (0.10, 0.0, 0.02), (0.30, 0.0, -0.80), 0.016),
    limb(WOOD, (0.02, 0.0, 0.03), (0.14, 0.0, 0.03), 0.018),
    same=("crutch",),
)
_SWORD = _in(
    "right hand",
    _stick(Material(DARK.colour), -0.12, 0.06, 0.02),
    box(CHROME, (0.0, 0.0, 0.48), (0.06, 0.015, 0.80)),
    box(Material(YELLOW), (0.0, 0.0, 0.07), (0.20, 0.04, 0.03)),
    same=("sword",),
)
_SHIELD = _in(
    "left hand",
    ball(Material(RED), (0.08, 0.08, 0.0), (0.08, 0.52, 0.66)),
    ball(Material(YELLOW), (0.12, 0.08, 0.0), (0.05, 0.16, 0.18)),
    same=("shield",),
)
_WRENCH = _in(
    "right hand",
    _stick(STEEL, -0.10, 0.28, 0.018),
    ball(STEEL, (0.0, 0.0, 0.32), (0.11, 0.03, 0.12)),
    same=("wrench",),
)
_TOOLBOX = _in(
    "left hand",
    box(Material(RED), (0.0, 0.0, -0.24), (0.42, 0.18, 0.22)),
    limb(STEEL, (-0.12, 0.0, -0.06), (0.12, 0.0, -0.06), 0.014),
    same=("chest",),
)
_PITCHFORK = _in(
    "right hand",
    _stick(WOOD, -0.60, 0.80, 0.018),
    *(rod(STEEL, (x, 0.0, 0.80), (x, 0.0, 1.10), 0.010) for x in (-0.08, 0.0, 0.08)),
    rod(STEEL, (-0.09, 0.0, 0.80), (0.09, 0.0, 0.80), 0.014),
    same=("pitchfork", "shovel", "rake"),
)
_CROOK = _in(
    "right hand",
    _stick(WOOD, -0.85, 0.80, 0.020),
    limb(WOOD, (0.0, 0.0, 0.80), (0.12, 0.0, 0.90), 0.02),
    limb(WOOD, (0.12, 0.0, 0.90), (0.20, 0.0, 0.76), 0.02),
)
_SCEPTRE = _in(
    "right hand",
    _stick(Material(YELLOW), -0.25, 0.35, 0.018),
    ball(Material(YELLOW), (0.0, 0.0, 0.40), (0.11, 0.11, 0.11)),
)
_WAND = _in(
    "right hand",
    _stick(WOOD, -0.05, 0.36, 0.012),
    ball(glowing((0.6, 0.8, 1.0), 2.0), (0.0, 0.0, 0.38), (0.06, 0.06, 0.06)),
)
_RIFLE = _in(
    "torso",
    rod(DARK, (0.20, -0.24, 0.10), (0.24, 0.16, 0.46), 0.022),
    box(WOOD, (0.19, -0.22, 0.11), (0.06, 0.16, 0.10)),
    box(DARK, (0.21, -0.04, 0.24), (0.05, 0.05, 0.14)),
)
_BOUQUET = _in(
    "hands",
    *(
        ball(Material(c), (0.08 + x, y, z), (0.09, 0.09, 0.09))
        for c, x, y, z in (
            (WHITE, 0.0, 0.06, 0.06),
            ((0.75, 0.25, 0.35), 0.05, 0.0, 0.08),
            (WHITE, 0.0, -0.06, 0.06),
            ((0.75, 0.25, 0.35), 0.04, 0.05, 0.0),
            ((0.06, 0.25, 0.04), 0.0, 0.0, -0.02),
        )
    ),
    same=("bouquet", "flower", "rose"),
)
_LASSO = _in(
    "right hand",
    *(
        limb(Material((0.50, 0.34, 0.14)), a, b, 0.014)
        for a, b in (
            ((0.0, 0.12, -0.12), (0.0, -0.12, -0.12)),
            ((0.0, -0.12, -0.12), (0.0, -0.12, -0.42)),
            ((0.0, -0.12, -0.42), (0.0, 0.12, -0.42)),
            ((0.0, 0.12, -0.42), (0.0, 0.12, -0.12)),
            ((0.03, 0.10, -0.10), (0.03, -0.10, -0.38)),
        )
    ),
    same=("rope",),
)
_BRUSH = _in(
    "right hand",
    _stick(WOOD, -0.08, 0.16, 0.012),
    rod(Material(RED), (0.0, 0.0, 0.16), (0.0, 0.0, 0.24), 0.02),
    same=("brush", "paintbrush"),
)
_PALETTE = _in(
    "left hand",
    ball(WOOD, (0.14, 0.0, 0.05), (0.34, 0.26, 0.025)),
    *(
        ball(Material(c), (0.14 + x, y, 0.07), (0.07, 0.07, 0.03))
        for c, x, y in (
            (RED, 0.08, 0.05),
            (BLUE, 0.0, 0.08),
            (YELLOW, -0.08, 0.04),
            (WHITE, 0.08, -0.05),
        )
    ),
)
_CAMERA = _in(
    "hands",
    box(DARK, (0.06, 0.0, 0.04), (0.10, 0.18, 0.12)),
    rod(STEEL, (0.10, 0.0, 0.04), (0.20, 0.0, 0.04), 0.045),
    same=("photo camera", "video camera"),
)
_AXE = _in(
    "right hand",
    _stick(WOOD, -0.30, 0.55, 0.018),
    box(STEEL, (0.08, 0.0, 0.52), (0.20, 0.03, 0.14)),
    same=("axe", "saw", "chainsaw"),
)
_BROOM = _in(
    "right hand",
    _stick(WOOD, -0.50, 0.80, 0.014),
    spike(Material(YELLOW), (0.0, 0.0, 1.02), (0.0, 0.0, 0.72), 0.15),
    same=("broom", "mop"),
)
_MICROPHONE = _in(
    "right hand",
    _stick(DARK, -0.08, 0.12, 0.02),
    ball(STEEL, (0.0, 0.0, 0.15), (0.075, 0.075, 0.075)),
    same=("microphone",),
)
_GUITAR = props.PROPS["play guitar"][0]
_VIOLIN = props.PROPS["play violin"]
_FISHING = props.PROPS["fish"][0]
_BOW = _in(
    "left hand",
    *(
        limb(WOOD, a, b, 0.028)
        for a, b in (
            ((0.0, 0.0, -0.75), (0.20, 0.0, -0.35)),
            ((0.20, 0.0, -0.35), (0.22, 0.0, 0.35)),
            ((0.22, 0.0, 0.35), (0.0, 0.0, 0.75)),
        )
    ),
    rod(Material(WHITE), (0.0, 0.0, -0.75), (0.0, 0.0, 0.75), 0.008),
    same=("bow",),
)
_FOIL = _in(
    "right hand",
    rod(CHROME, (0.0, 0.0, 0.0), (0.95, 0.0, 0.12), 0.010),
    ball(STEEL, (0.06, 0.0, 0.0), (0.05, 0.12, 0.12)),
    same=("sword",),
)
_RUGBY = _in(
    "right hand",
    ball(_LEATHER, (0.08, 0.02, 0.05), (0.30, 0.18, 0.18)),
    same=("american football",),
)
_BASKET = _in(
    "right hand",
    ball(Material(ORANGE), (0.12, 0.0, 0.06), (0.25, 0.25, 0.25)),
    same=("basketball", "ball"),
)
_CLIPBOARD = _in(
    "left hand",
    box(WOOD, (0.08, 0.0, 0.08), (0.03, 0.22, 0.30)),
    box(Material(WHITE), (0.062, 0.0, 0.07), (0.01, 0.20, 0.26)),
)
_FLASK = _in(
    "right hand",
    spike(Material((0.05, 0.35, 0.75)), (0.02, 0.0, -0.06), (0.02, 0.0, 0.16), 0.075),
    rod(Material((0.6, 0.7, 0.72)), (0.02, 0.0, 0.08), (0.02, 0.0, 0.18), 0.022),
)
_PICKAXE = _in(
    "right hand",
    _stick(WOOD, -0.30, 0.55, 0.018),
    limb(STEEL, (-0.25, 0.0, 0.48), (0.0, 0.0, 0.56), 0.025),
    limb(STEEL, (0.0, 0.0, 0.56), (0.25, 0.0, 0.48), 0.025),
    same=("axe", "hammer"),
)
_HAMMER = _in(
    "right hand",
    _stick(WOOD, -0.08, 0.30, 0.018),
    box(STEEL, (0.0, 0.0, 0.32), (0.18, 0.07, 0.08)),
    same=("hammer",),
)
_STETHOSCOPE = _in(
    "torso",
    limb(DARK, (0.09, 0.07, 0.50), (0.14, 0.04, 0.26), 0.013),
    limb(DARK, (0.09, -0.07, 0.50), (0.14, 0.02, 0.26), 0.013),
    ball(CHROME, (0.155, 0.03, 0.22), (0.03, 0.055, 0.055)),
    same=("stethoscope",),
)
_MAIL = _in(
    "torso",
    box(_LEATHER, (0.0, 0.26, 0.0), (0.34, 0.12, 0.26)),
    limb(_LEATHER, (0.10, 0.16, 0.10), (0.09, -0.14, 0.48), 0.02),
    same=("handbag",),
)
_PARCEL = _in(
    "hands", box(Material((0.40, 0.24, 0.11)), (0.18, 0.0, 0.06), (0.34, 0.42, 0.30)), same=("box",)
)
_BRIEFCASE = _in(
    "right hand",
    box(DARK, (0.0, 0.0, -0.24), (0.42, 0.11, 0.30)),
    same=("suitcase", "handbag", "briefcase"),
)
_WHISTLE = _in("chest", ball(Material(YELLOW), (0.02, 0.0, 0.0), (0.05, 0.05, 0.05)))
_RUCKSACK_POLE = _in("right hand", _stick(STEEL, -0.85, 0.10, 0.012))
HOLDS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        "surfer": (_upright_board(Material((0.78, 0.74, 0.62)), 2.0, 0.52),),
        "snowboarder": (_upright_board(Material((0.10, 0.30, 0.60)), 1.5, 0.30),),
        "skateboarder": (_upright_board(_LEATHER, 0.8, 0.22),),
        "skier": props.PROPS["ski"],
        "baseball batter": (_BAT,),
        "catcher": (_MITT,),
        "baseball player": (_MITT,),
        "cricketer": (_BAT,),
        "golfer": (_CLUB,),
        "tennis player": (_TENNIS,),
        "boxer": _glove(RED),
        "goalkeeper": _glove((0.70, 0.55, 0.05)),
        "hockey player": (_HOCKEY_STICK, _SKATES),
        "ice skater": (_SKATES,),
        "basketball player": (_BASKET,),
        "american football player": (_RUGBY,),
        "fencer": (_FOIL,),
        "archer": (_BOW,),
        "chef": (_LADLE,),
        "waiter": (_TRAY,),
        "waitress": (_TRAY,),
        "elderly man": (_CANE,),
        "elderly woman": (_CANE,),
        "elderly person": (_CANE,),
        "knight": (_SWORD, _SHIELD),
        "samurai": (_SWORD,),
        "pirate": (_SWORD,),
        "mechanic": (_WRENCH,),
        "plumber": (_WRENCH, _TOOLBOX),
        "carpenter": (_HAMMER,),
        "blacksmith": (_HAMMER,),
        "miner": (_PICKAXE,),
        "lumberjack": (_AXE,),
        "farmer": (_PITCHFORK,),
        "shepherd": (_CROOK,),
        "king": (_SCEPTRE,),
        "wizard": (_WAND,),
        "soldier": (_RIFLE,),
        "bride": (_BOUQUET,),
        "cowboy": (_LASSO,),
        "painter": (_BRUSH, _PALETTE),
        "photographer": (_CAMERA,),
        "tourist": (_CAMERA,),
        "janitor": (_BROOM,),
        "singer": (_MICROPHONE,),
        "guitarist": (_GUITAR,),
        "violinist": tuple(_VIOLIN),
        "fisherman": (_FISHING,),
        "doctor": (_STETHOSCOPE, _CLIPBOARD),
        "scientist": (_FLASK,),
        "postman": (_MAIL,),
        "courier": (_PARCEL,),
        "businessman": (_BRIEFCASE,),
        "hiker": (_RUCKSACK_POLE,),
        "referee": (_WHISTLE,),
        "conductor": (
            _in("right hand", rod(Material(WHITE), (0.0, 0.0, 0.0), (0.40, 0.0, 0.05), 0.010)),
        ),
        "magician": (_in("right hand", rod(DARK, (0.0, 0.0, 0.0), (0.36, 0.0, 0.05), 0.013)),),
    }
)
"""Noun of a role → what it has with it."""
