"""Kinds of people and their clothes; parts of hats, garments and props."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, replace
from functools import cache
from types import MappingProxyType
from typing import Any

from texvent.scenes.models.materials import (
    CLOTH_COLOURS,
    DARK,
    HAIR_COLOURS,
    SKIN_TONES,
    Material,
    cloth,
    fur,
    skin,
)
from texvent.scenes.models.part_lines import Placed, read_parts
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.surfaces import FIXED_HUES, PAINT, Painted
from texvent.scenes.models.tables import frozen, read_table
from texvent.scenes.models.variation import choose, paint
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class PersonKind:
    """What sets one kind of person apart: fields of a row of `people` in `data/outfits.toml`."""

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
    garments: tuple[str, ...] = ()
    """Names in `garments` of the table."""


@dataclass(frozen=True)
class Outfit:
    """Surfaces of one person."""

    skin: Material
    hair: Material
    shirt: Material
    legs: Material
    shins: Material
    shoes: Material
    forearms: Material
    hands: Material
    hat: Material


_FIELDS = frozenset(one.name for one in fields(PersonKind))


def _read_kind(row: Mapping[str, Any]) -> PersonKind:
    return PersonKind(**{key: frozen(value) for key, value in row.items() if key in _FIELDS})


ADULT = PersonKind()
KINDS: Mapping[str, PersonKind] = MappingProxyType(
    {noun: _read_kind(row) for noun, row in read_table("outfits")["people"].items()}
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
        kind = replace(kind, **{key: value for key, value in row.items() if key in _FIELDS})
        if colour is not None:
            painted: dict[str, Any] = {
                field: (colour,) if field == "shirts" else colour for field in row["painted"]
            }
            kind = replace(kind, **painted)
    return kind


def dress_person(kind: PersonKind, *, colour: Colour | None, seed: int) -> Outfit:
    """Choose skin, hair and clothes."""
    flesh = skin(choose(seed, "skin", SKIN_TONES))
    shirt = cloth(paint(colour, seed, "shirt", kind.shirts))
    usual = choose(seed, "trousers", ((0.03, 0.05, 0.12), (0.06, 0.055, 0.05)))
    trousers = cloth(usual if kind.trousers is None else kind.trousers)
    shoes = DARK if kind.dress != "shorts" else Material((0.6, 0.6, 0.58))
    return Outfit(
        skin=flesh,
        hair=fur(choose(seed, "hair", HAIR_COLOURS) if kind.hair is None else kind.hair),
        shirt=shirt,
        legs=flesh if kind.dress == "skirt" else trousers,
        shins=trousers if kind.dress == "trousers" else flesh,
        shoes=shoes if kind.shoes is None else Material(kind.shoes),
        forearms=shirt if kind.has_sleeves else flesh,
        hands=flesh if kind.gloves is None else Material(kind.gloves),
        hat=cloth(kind.hat_colour),
    )


def draw_parts(table: str, group: str, name: str, paint: Material | None = None) -> list[ModelPart]:
    """The parts of an entry.

    Args:
        table: "props" or "outfits".
        group: its table of part lists, such as "hats".
        name: of the entry.
        paint: surface of its parts that are of "paint".
    """
    painted = _painted(table)
    if paint is not None:
        painted = replace(painted, made={**painted.made, PAINT: paint})
    return painted.draw(_placed(table, group, name))


@cache
def _placed(table: str, group: str, name: str) -> tuple[Placed, ...]:
    return read_parts(read_table(table)[group][name])[0]


@cache
def _painted(table: str) -> Painted:
    return Painted(FIXED_HUES, read_table(table)["surfaces"])
