"""Words for kinds of things, each shown as a thing that the models know; and words not to be shown.

The report names every substitution: "spaniel → dog".
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.language.vocabulary.kinds.animals import ANIMAL_KINDS
from texvent.scenes.language.vocabulary.kinds.opaque import OPAQUE_COMPOUNDS
from texvent.scenes.language.vocabulary.kinds.plants import FOOD_AND_PLANT_KINDS
from texvent.scenes.language.vocabulary.kinds.things import THING_KINDS

__all__ = ["KINDS", "OPAQUE_COMPOUNDS", "SUBSTITUTES"]

_TABLES = (ANIMAL_KINDS, FOOD_AND_PLANT_KINDS, THING_KINDS)


def _list_words(text: str) -> list[str]:
    return [word for word in (" ".join(one.split()) for one in text.split(",")) if word]


KINDS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        noun: tuple(word for table in _TABLES for word in _list_words(table.get(noun, "")))
        for noun in dict.fromkeys(noun for table in _TABLES for noun in table)
    }
)
"""Noun of the models → singular words for kinds of it."""
SUBSTITUTES: frozenset[tuple[str, str]] = frozenset(
    (noun, word) for noun, words in KINDS.items() for word in words
)
"""(noun, word) of every kind."""
