"""Kinds of people and their clothes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

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

if TYPE_CHECKING:
    from texvent.scenes.models.animals.four_legged.build import Coat
    from texvent.scenes.models.people.creatures.creature import Creature


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
    """ "", "helmet" or a name of `roles.hats.HATS`."""
    hat_colour: Colour = (0.03, 0.10, 0.45)
    runs: bool = False
    """Whether it runs unless told otherwise."""
    shirts: tuple[Colour, ...] = CLOTH_COLOURS
    hair: Colour | None = None
    """None = as the seed has it."""
    trousers: Colour | None = None
    """None = dark; of a wetsuit the colour of its legs."""
    has_sleeves: bool = False
    """Whether the shirt covers the forearms."""
    gloves: Colour | None = None
    shoes: Colour | None = None
    garments: tuple[tuple[str, Colour | None], ...] = ()
    """Names of `roles.garments.GARMENTS` with their colours; None = as the shirt."""
    stoop: float = 0.0
    """How far the torso is bent forward at any time, radians."""
    bulk: float = 1.0
    """Thickness of torso and limbs relative to an adult's."""
    shells: tuple[Colour, ...] = ()
    """Colours of the metal or plastic that a robot consists of; () = skin and clothes."""
    creature: Creature | None = None
    """The animal whose head, coat and paws it has; then no shirts, and None as the trousers, are
    what is not worn."""


@dataclass(frozen=True)
class Outfit:
    """Surfaces of one person."""

    skin: Material
    hair: Material
    shirt: Material
    legs: Material
    shins: Material
    shoes: Material
    forearms: Material | None = None
    """None = the skin."""
    hands: Material | None = None
    """None = the skin."""
    sleeves: Material | None = None
    """Of the upper arms; None = the shirt."""
    coat: Coat | None = None
    """Of an upright animal."""
    hat: Material | None = None
    garments: Sequence[tuple[str, Material]] = ()
    bulk: float = 1.0


ADULT = PersonKind()
WOMAN = PersonKind(height=0.95, dress="skirt", long_hair=True)
CHILD = PersonKind(height=0.66, head=1.3, dress="shorts")
GIRL = PersonKind(height=0.66, head=1.3, dress="skirt", long_hair=True)
RUNNER = PersonKind(dress="shorts", runs=True)
WORKER = PersonKind(hat="helmet", shirts=(ORANGE,))


def dress_person(kind: PersonKind, *, colour: Colour | None, seed: int) -> Outfit:
    """Choose skin, hair and clothes."""
    if kind.creature is not None:
        return kind.creature.dress(kind, colour=colour, seed=seed)
    if kind.shells:
        return _build_shell(kind, colour=colour, seed=seed)
    flesh = skin(choose(seed, "skin", SKIN_TONES))
    shirt = cloth(paint(colour, seed, "shirt", kind.shirts))
    usual = choose(seed, "trousers", ((0.03, 0.05, 0.12), (0.06, 0.055, 0.05)))
    trousers = cloth(usual if kind.trousers is None else kind.trousers)
    is_skirt = kind.dress == "skirt"
    shoes = DARK if kind.dress != "shorts" else Material((0.6, 0.6, 0.58))
    return Outfit(
        skin=flesh,
        hair=fur(choose(seed, "hair", HAIR_COLOURS) if kind.hair is None else kind.hair),
        shirt=shirt,
        legs=flesh if is_skirt else trousers,
        shins=trousers if kind.dress == "trousers" else flesh,
        shoes=shoes if kind.shoes is None else Material(kind.shoes),
        forearms=shirt if kind.has_sleeves else None,
        hands=Material(kind.gloves) if kind.gloves is not None else None,
        hat=cloth(kind.hat_colour),
        garments=[(name, shirt if hue is None else cloth(hue)) for name, hue in kind.garments],
        bulk=kind.bulk,
    )


def _build_shell(kind: PersonKind, *, colour: Colour | None, seed: int) -> Outfit:
    """All surfaces of one material."""
    shell = Material(paint(colour, seed, "shell", kind.shells))
    return Outfit(
        skin=shell,
        hair=shell,
        shirt=shell,
        legs=shell,
        shins=shell,
        shoes=shell,
        hat=shell,
        garments=[(name, shell) for name, _ in kind.garments],
        bulk=kind.bulk,
    )
