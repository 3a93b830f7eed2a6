"""Words for kinds of things, each shown as a thing that the models know.

The report names every substitution: "spaniel → dog".
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.kinds.animals import ANIMAL_KINDS
from texvent.scenes.models.kinds.indoors import INDOOR_KINDS
from texvent.scenes.models.kinds.outdoors import OUTDOOR_KINDS
from texvent.scenes.models.kinds.people import PEOPLE_KINDS
from texvent.scenes.models.kinds.plants import FOOD_AND_PLANT_KINDS
from texvent.scenes.models.kinds.things import THING_KINDS
from texvent.scenes.models.kinds.work import WORK_KINDS

__all__ = ["KINDS", "find_kind"]

_TABLES = (
    PEOPLE_KINDS,
    ANIMAL_KINDS,
    FOOD_AND_PLANT_KINDS,
    THING_KINDS,
    INDOOR_KINDS,
    OUTDOOR_KINDS,
    WORK_KINDS,
)


def _list_words(text: str) -> list[str]:
    return [word for word in (" ".join(one.split()) for one in text.split(",")) if word]


KINDS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        noun: tuple(word for table in _TABLES for word in _list_words(table.get(noun, "")))
        for noun in dict.fromkeys(noun for table in _TABLES for noun in table)
    }
)
"""Noun of the models → singular words for kinds of it."""


def find_kind(word: str) -> str | None:
    """The noun that a kind is shown as; None if the word is none.

    Example:
        >>> find_kind("cocker spaniel")
        'dog'
    """
    return next((noun for noun, words in KINDS.items() if word in words), None)
