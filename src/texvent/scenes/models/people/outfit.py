"""Kinds of people and their clothes."""

from __future__ import annotations

from dataclasses import dataclass

from texvent.scenes.models.materials import (
    CLOTH_COLOURS,
    DARK,
    HAIR_COLOURS,
    ORANGE,
    SKIN_TONES,
    Material,
    cloth,
    fur,
    skin,
)
from texvent.scenes.models.variation import choose, paint
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class PersonKind:
    """What sets one kind of person apart."""

    height: float = 1.0
    """Relative to an adult of 1.75 m."""
    head: float = 1.0
    """Head size relative to the body: children have large heads."""
    dress: str = "trousers"
    """ "trousers", "skirt", "shorts"."""
    long_hair: bool = False
    hat: str = ""
    """ "", "helmet"."""
    runs: bool = False
    """Whether it runs unless told otherwise."""
    shirts: tuple[Colour, ...] = CLOTH_COLOURS


@dataclass(frozen=True)
class Outfit:
    """Surfaces of one person."""

    skin: Material
    hair: Material
    shirt: Material
    legs: Material
    shins: Material
    shoes: Material


ADULT = PersonKind()
WOMAN = PersonKind(height=0.95, dress="skirt", long_hair=True)
CHILD = PersonKind(height=0.66, head=1.3, dress="shorts")
GIRL = PersonKind(height=0.66, head=1.3, dress="skirt", long_hair=True)
RUNNER = PersonKind(dress="shorts", runs=True)
WORKER = PersonKind(hat="helmet", shirts=(ORANGE,))


def dress_person(kind: PersonKind, *, colour: Colour | None, seed: int) -> Outfit:
    """Choose skin, hair and clothes."""
    flesh = skin(choose(seed, "skin", SKIN_TONES))
    shirt = cloth(paint(colour, seed, "shirt", kind.shirts))
    trousers = cloth(choose(seed, "trousers", ((0.03, 0.05, 0.12), (0.06, 0.055, 0.05))))
    legs = shirt if kind.dress == "skirt" else trousers
    return Outfit(
        skin=flesh,
        hair=fur(choose(seed, "hair", HAIR_COLOURS)),
        shirt=shirt,
        legs=flesh if kind.dress == "skirt" else legs,
        shins=trousers if kind.dress == "trousers" else flesh,
        shoes=DARK if kind.dress != "shorts" else Material((0.6, 0.6, 0.58)),
    )
