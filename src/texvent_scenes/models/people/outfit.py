"""Kinds of people, their clothes, and what activities need: instruments, tools, balls."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache, partial
from itertools import cycle
from types import MappingProxyType
from typing import Any, TypeAlias

from texvent_scenes.models.materials import (
    BLUE,
    CLOTH_COLOURS,
    DARK,
    HAIR_COLOURS,
    MATERIALS,
    ORANGE,
    RED,
    SKIN_TONES,
    YELLOW,
    Material,
    cloth,
    fur,
    repaint,
    shade,
    skin,
    striped,
)
from texvent_scenes.models.people.prop_motions import PropMotion, read_motion
from texvent_scenes.models.protocol import ModelPart, choose, paint
from texvent_scenes.models.shapes import ball, bounds
from texvent_scenes.models.surfaces import FIXED_HUES, PAINT, Painted
from texvent_scenes.models.tables import frozen, nouns_with, read_table, trait_value
from texvent_scenes.rendered_scene import Colour


@dataclass(frozen=True)
class PersonKind:
    """Kind of person: fields of a row of `people` in `data/outfits.toml`."""

    height: float = 1.0
    """Relative to an adult of 1.75 m."""
    head: float = 1.0
    """Head size relative to the body: children have large heads."""
    dress: str = "trousers"
    """ "trousers", "skirt", "shorts"."""
    long_hair: bool = False
    hat: str = ""
    """Name in `hats` of the table, or ""."""
    hat_colour: Colour = (0.03, 0.10, 0.45)
    runs: bool = False
    """Whether it runs unless told otherwise."""
    shirts: tuple[Colour, ...] = CLOTH_COLOURS
    hair: Colour | None = None
    """None = as the seed has it."""
    trousers: Colour | None = None
    """None = dark."""
    fabric: str = ""
    """Material of the shirt, one of `MATERIALS`; "" = plain cloth."""
    leg_fabric: str = ""
    """The same of the trousers."""
    pattern: Colour | None = None
    """Second colour of a pattern of these; None = one that contrasts."""
    has_sleeves: bool = False
    """Whether the shirt covers the forearms."""
    gloves: Colour | None = None
    shoes: Colour | None = None
    boots: Colour | None = None
    """Colour of what covers the shins; None = shoes."""
    garments: tuple[str, ...] = ()
    """Names in `garments` of the table."""


_FIELDS = frozenset(one.name for one in fields(PersonKind))


ADULT = PersonKind()
KINDS: Mapping[str, PersonKind] = MappingProxyType(
    {
        noun: PersonKind(**{key: frozen(one) for key, one in row.items() if key in _FIELDS})
        for noun, row in read_table("outfits")["people"].items()
    }
)
"""Noun → what it wears."""
CLOTHES: Mapping[str, Mapping[str, Any]] = read_table("outfits")["worn"]
"""Noun of clothes that show on a body and not as a thing of their own → what they change."""


Worn: TypeAlias = tuple[str, Colour | None, str, Colour | None]
"""A noun of `CLOTHES`, its colour, None for the usual one, its material, or "", and the second
colour of a pattern, None for one that contrasts."""


_DARKER = 0.3
"""Colour of a material in clothes, as a multiple of its usual one."""


def can_be_worn(noun: str) -> bool:
    """Whether people wear it."""
    return noun in CLOTHES or trait_value("worn", noun) is not None


def put_on(kind: PersonKind, worn: Iterable[Worn]) -> PersonKind:
    """A kind of person in what it wears."""
    worn = tuple(worn)
    is_dressed = any(CLOTHES[noun].get("dress") == "skirt" for noun, *_ in worn)
    for noun, said, material, other in worn:
        row = CLOTHES[noun]
        own = MATERIALS[material].colour if material else None
        own = own and shade(own, _DARKER)  # no bare skin
        colour = said or own or frozen(row.get("usual"))
        changed = {key: frozen(value) for key, value in row.items() if key in _FIELDS}
        if noun in nouns_with("top") and kind.dress == "skirt" and not is_dressed:
            changed.setdefault("dress", "trousers")  # a dress of that colour is no sweater
        garments = (*kind.garments, *changed.pop("garments", ()))
        for field, part in (("fabric", "shirts"), ("leg_fabric", "trousers")):
            if material and part in row["painted"]:
                changed |= {field: material, "pattern": other}
        kind = replace(kind, garments=garments, **changed)
        if colour is not None:
            painted: dict[str, Any] = {
                field: (colour,) if field == "shirts" else colour for field in row["painted"]
            }
            kind = replace(kind, **painted)
    return kind


def dress_person(kind: PersonKind, *, colour: Colour | None, seed: int) -> Painted:
    """Skin, hair and clothes of one person: surfaces of the parts of a figure."""
    flesh = skin(choose(seed, "skin", SKIN_TONES))
    dyed = paint(colour, seed, "shirt", kind.shirts)
    shirt = MATERIALS[kind.fabric].in_colour(dyed, kind.pattern) if kind.fabric else cloth(dyed)
    usual = choose(seed, "trousers", ((0.03, 0.05, 0.12), (0.06, 0.055, 0.05)))
    dyed = usual if kind.trousers is None else kind.trousers
    trousers = (
        MATERIALS[kind.leg_fabric].in_colour(dyed, kind.pattern) if kind.leg_fabric else cloth(dyed)
    )
    shoes = DARK if kind.dress != "shorts" else Material((0.6, 0.6, 0.58))
    legs = flesh if kind.dress == "skirt" else trousers
    shins = trousers if kind.dress == "trousers" else flesh
    made = {
        "skin": flesh,
        "lips": Material(shade(flesh.colour, 0.45)),
        "hair": fur(choose(seed, "hair", HAIR_COLOURS) if kind.hair is None else kind.hair),
        "shirt": shirt,
        "pelvis": shirt if kind.dress == "skirt" else legs,
        "legs": legs,
        "shins": shins if kind.boots is None else Material(kind.boots),
        "shoes": shoes if kind.shoes is None else Material(kind.shoes),
        "forearms": shirt if kind.has_sleeves else flesh,
        "hands": flesh if kind.gloves is None else Material(kind.gloves),
        PAINT: cloth(kind.hat_colour),
    }
    return Painted(FIXED_HUES, read_table("outfits")["surfaces"], made)


@cache
def draw_shape(name: str) -> Sequence[ModelPart]:
    """The parts of a shape of `data/props.toml`."""
    table = read_table("props")
    return Painted(FIXED_HUES, table["surfaces"]).draw_lines(table["shapes"][name])


_SOLES = frozenset({"soles", "left sole", "right sole", "deck"})
"""Places of what is under the feet: skis, boards."""
Draw = Callable[..., Sequence[ModelPart]]
"""Parts at a time, s; of several things, with their number as "count"."""


@dataclass(frozen=True)
class Prop:
    """Something that goes with a place of the body."""

    anchor: str
    """Place of `anchors.locate`; "ground" = body coordinates, `_SOLES` = below the feet."""
    draw: Draw
    """Its shapes at a time, s, in the axes of that place, m."""
    nouns: tuple[str, ...] = ()
    """Nouns that are the same thing: where the scene shows one, the prop is left out."""
    name: str = ""
    """Name of its shape."""
    is_own: bool = False
    """Whether it is drawn in place of a named one, not left out for it."""
    count: int = 1
    """Number of its nouns' things."""
    under: tuple[tuple[str, Draw], ...] = ()
    """Nouns, and its shapes where one is said: a bench with cupboards is a counter."""

    @property
    def is_below(self) -> bool:
        """Whether who has it stands by it or on it."""
        return self.anchor == "ground" or self.anchor in _SOLES

    @property
    def thickness_m(self) -> float:
        """Height to which it raises the soles, m."""
        return -float(bounds(self.draw(0.0))[0][2]) if self.anchor in _SOLES else 0.0

    def as_said(self, count: int, colour: Colour | None, noun: str = "") -> Prop:
        """The prop as a noun, in a colour, None for its own, and in a number if it has several."""
        if noun in (drawn := dict(self.under)):
            return replace(self, draw=drawn[noun], under=()).as_said(count, colour)
        many = count if self.count > 1 else 1
        draw = partial(self.draw, count=count) if many != self.count else self.draw
        if colour is None:
            return replace(self, draw=draw, count=many)
        return replace(self, draw=lambda time_s: repaint(draw(time_s), colour), count=many)


_BASKETBALL = striped(ORANGE, (0.05, 0.03, 0.02), 2.0)
_BALL_M = 0.24
_DRIBBLE_HZ, _JUGGLE_HZ = 1.6, 1.1
"""Bounces of a ball, rounds of a juggler's hand and turns of a rope per second: rates of the
activities."""


def _dribbled(time_s: float) -> list[ModelPart]:
    """Between the right hand and the ground: free flight after each bounce, pushed down again."""
    # The hand has it at the start of each cycle and is lowest in the middle, when it bounces.
    share = (time_s * _DRIBBLE_HZ) % 1.0
    height = 0.12 + 0.72 * abs(math.cos(math.pi * share)) ** 1.3
    return [ball(_BASKETBALL, (0.66, -0.30, height), (_BALL_M,) * 3)]


def _juggled(time_s: float, count: int = 3) -> list[ModelPart]:
    """Balls in turn from hand to hand, each in free flight half of the time."""
    parts = []
    for index, colour in zip(range(count), cycle((RED, YELLOW, BLUE))):
        share = (0.5 * time_s * _JUGGLE_HZ + index / count) % 1.0
        half, into = divmod(2.0 * share, 1.0)
        across = 0.22 * (1.0 if half < 1.0 else -1.0) * (1.0 - 2.0 * into)
        rise = 4.0 * into * (1.0 - into)
        parts.append(ball(Material(colour), (0.42, across, 1.14 + 0.62 * rise), (0.12,) * 3))
    return parts


_MOVING: Mapping[str, Draw] = MappingProxyType(
    {
        "dribbled ball": _dribbled,
        "juggled balls": _juggled,
    }
)
"""Shape → how it is drawn, if it moves in its place."""


def _draw_moving(motion: PropMotion, shape: str, time_s: float) -> Sequence[ModelPart]:
    """A shape as its motion has it at that instant."""
    return motion.place(draw_shape(shape), time_s)


def _draw_both(shape: str, other: str, time_s: float) -> Sequence[ModelPart]:
    """Two shapes, which rest."""
    return [*draw_shape(shape), *draw_shape(other)]


def _read_prop(row: Mapping[str, Any]) -> Prop:
    draw, motion = _MOVING.get(row["shape"]), read_motion(row)
    if draw is None:
        shape = row["shape"]
        draw = partial(_draw_moving, motion, shape) if motion else lambda _: draw_shape(shape)
    nouns = tuple(row.get("nouns", ()))
    own, count = row.get("is_own", False), row.get("count", 1)
    under = tuple(
        (noun, partial(_draw_both, row["shape"], shape))
        for noun, shape in row.get("under", {}).items()
    )
    return Prop(row["at"], draw, nouns, row["shape"], own, count, under)


PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        activity: tuple(map(_read_prop, row["props"]))
        for activity, row in read_table("activities").items()
        if "props" in row
    }
)
"""Activity → what is drawn with it."""
HOLDS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        noun: tuple(
            prop
            for one in row["holds"]
            for prop in (PROPS[one["of"]] if "of" in one else (_read_prop(one),))
        )
        for noun, row in read_table("outfits")["people"].items()
        if "holds" in row
    }
)
"""Noun of a person → what it has with it, unless its act or the scene says otherwise."""


def list_props(activity: str, size: float = 1.0) -> tuple[Prop, ...]:
    """Props of an activity; `size` is that of the body, relative to an adult."""
    props = PROPS.get(activity, ())
    is_between = len(props) > 1 and any(one.anchor == "hands" for one in props)
    return tuple(_scaled(one, size, is_between=is_between) for one in props)


def _scaled(prop: Prop, size: float, *, is_between: bool) -> Prop:
    """Prop at the size of the body if the body stands at it or wears it, but not in a hand.

    There too if something is between the hands, as what is poured from one into the other.
    """
    if size == 1.0 or not (is_between or prop.is_below or prop.anchor == "torso"):
        return prop

    def scale(draw: Draw) -> Draw:
        return lambda time_s, **said: [
            part.at(size * part.to_body) for part in draw(time_s, **said)
        ]

    under = tuple((noun, scale(one)) for noun, one in prop.under)
    return replace(prop, draw=scale(prop.draw), under=under)
