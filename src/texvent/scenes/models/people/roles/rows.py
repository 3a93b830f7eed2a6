"""How rows of the tables of roles are written: colours, suits and the noun of a role."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from texvent.scenes.models.materials import WHITE
from texvent.scenes.models.people.outfit import ADULT, WOMAN, PersonKind
from texvent.scenes.models.people.person import build_person
from texvent.scenes.models.protocol import Noun
from texvent.scenes.scene import Colour

NAVY: Colour = (0.015, 0.025, 0.10)
DARK: Colour = (0.02, 0.02, 0.024)
CREAM: Colour = (0.72, 0.66, 0.52)
BROWN: Colour = (0.16, 0.08, 0.03)
TAN: Colour = (0.42, 0.29, 0.14)
OLIVE: Colour = (0.10, 0.12, 0.04)
GREY: Colour = (0.30, 0.30, 0.31)
STEEL: Colour = (0.42, 0.43, 0.45)
SCRUBS: Colour = (0.08, 0.36, 0.36)
SILVER_HAIR: Colour = (0.55, 0.55, 0.54)
DENIM: Colour = (0.05, 0.11, 0.26)
PURPLE: Colour = (0.22, 0.03, 0.28)
BARE: Colour = (0.50, 0.28, 0.17)
"""Of a swimmer's chest."""


def suit(colour: Colour, **changes: object) -> PersonKind:
    """Shirt, sleeves and trousers in one colour."""
    kind = replace(ADULT, shirts=(colour,), trousers=colour, has_sleeves=True)
    return replace(kind, **changes)  # type: ignore[arg-type]


def wears(*names: str, colour: Colour | None = None) -> tuple[tuple[str, Colour | None], ...]:
    """Garments in one colour; None = as the shirt."""
    return tuple((name, colour) for name in names)


def role(
    name: str, kind: PersonKind, *same: str, plurals: tuple[str, ...] = (), motion: str = "walk"
) -> Noun:
    """The noun of a role; `motion` is what it does unless the prompt says otherwise."""
    speed = {"ski": 6.0, "snowboard": 6.0, "skate": 3.0, "crawl": 0.3}.get(motion, 1.3)
    return Noun(name, partial(build_person, kind), "ground", speed, motion, same, plurals)


LADY = replace(WOMAN, dress="trousers")
PLAYER = replace(ADULT, dress="shorts")
WHITE_COAT = suit(WHITE, trousers=(0.05, 0.06, 0.10), garments=wears("long coat"))
APRON = (("apron", WHITE),)
