"""Kinds of people, their clothes, and what activities need: instruments, tools, balls."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache, partial
from types import MappingProxyType
from typing import Any

from texvent_scenes.models.materials import (
    BLUE,
    CLOTH_COLOURS,
    DARK,
    HAIR_COLOURS,
    ORANGE,
    RED,
    SKIN_TONES,
    YELLOW,
    Material,
    cloth,
    fur,
    shade,
    skin,
    striped,
)
from texvent_scenes.models.people.prop_motions import PropMotion, read_motion
from texvent_scenes.models.protocol import ModelPart, choose, paint
from texvent_scenes.models.shapes import ball
from texvent_scenes.models.surfaces import FIXED_HUES, PAINT, Painted
from texvent_scenes.models.tables import frozen, read_table
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


def put_on(kind: PersonKind, worn: Iterable[tuple[str, Colour | None]]) -> PersonKind:
    """A kind of person in what it wears.

    Args:
        kind: the person.
        worn: nouns of `CLOTHES` with their colours; None = the usual one.
    """
    for noun, said in worn:
        row = CLOTHES[noun]
        colour = said or frozen(row.get("usual"))
        changed = {key: frozen(value) for key, value in row.items() if key in _FIELDS}
        garments = (*kind.garments, *changed.pop("garments", ()))
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
    shirt = cloth(paint(colour, seed, "shirt", kind.shirts))
    usual = choose(seed, "trousers", ((0.03, 0.05, 0.12), (0.06, 0.055, 0.05)))
    trousers = cloth(usual if kind.trousers is None else kind.trousers)
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


Draw = Callable[[float], Sequence[ModelPart]]


@dataclass(frozen=True)
class Prop:
    """Something that goes with a place of the body."""

    anchor: str
    """Place of `anchors.locate`; "ground" = body coordinates."""
    draw: Draw
    """Its shapes at a time, s, in the axes of that place, m."""
    nouns: tuple[str, ...] = ()
    """Nouns that are the same thing: where the scene shows one, the prop is left out."""
    name: str = ""
    """Name of its shape."""
    is_own: bool = False
    """Whether it is drawn in place of a named one, not left out for it."""


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


def _juggled(time_s: float) -> list[ModelPart]:
    """Three balls in turn from hand to hand, each in free flight half of the time."""
    parts = []
    for index, colour in enumerate((RED, YELLOW, BLUE)):
        cycle = (time_s * _JUGGLE_HZ + index / 1.5) / 2.0 % 1.0
        half, into = divmod(2.0 * cycle, 1.0)
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


def _read_prop(row: Mapping[str, Any]) -> Prop:
    draw, motion = _MOVING.get(row["shape"]), read_motion(row)
    if draw is None:
        shape = row["shape"]
        draw = partial(_draw_moving, motion, shape) if motion else lambda _: draw_shape(shape)
    nouns = tuple(row.get("nouns", ()))
    return Prop(row["at"], draw, nouns, row["shape"], row.get("is_own", False))


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
    return tuple(_scaled(prop, size) for prop in PROPS.get(activity, ()))


def _scaled(prop: Prop, size: float) -> Prop:
    """Prop at the size of the body if the body stands at it or wears it, but not in a hand."""
    if size == 1.0 or prop.anchor not in ("ground", "torso"):
        return prop

    def draw(time_s: float) -> list[ModelPart]:
        return [part.at(size * part.to_body) for part in prop.draw(time_s)]

    return replace(prop, draw=draw)
