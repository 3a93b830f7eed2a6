"""Traits of nouns, as data: which nouns can be sat on, have headlights, stand at walls.

The files of `data/traits/` hold a table for each trait: a list of nouns, or a value for each of
them.

    seat = ["chair", "sofa"]

    ["seat height"]
    "chair, office chair" = 0.46
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from texvent.scenes.models.tables import list_data, read_table


@cache
def _read() -> Mapping[str, Any]:
    """Trait → its nouns, or its nouns with their values."""
    found: dict[str, Any] = {}
    for file in list_data("traits"):
        traits = read_table(f"traits/{file.name.removesuffix('.toml')}")
        twice = found.keys() & traits.keys()
        if twice:
            raise ValueError(f"{file.name}: {sorted(twice)} are traits of another file too")
        found |= {name: _by_noun(nouns) for name, nouns in traits.items()}
    return found


def _by_noun(nouns: Any) -> Any:
    """A table with a row for each noun of its keys."""
    if not isinstance(nouns, Mapping):
        return nouns
    return {noun: value for key, value in nouns.items() for noun in key.split(", ")}


@cache
def nouns_with(trait: str) -> frozenset[str]:
    """Nouns that have a trait.

    Raises:
        KeyError: no file has the trait.
    """
    return frozenset(_read()[trait])


def trait_value(trait: str, noun: str) -> Any:
    """A noun's value of a trait that is a table; None where it has none."""
    return _read()[trait].get(noun)


def trait_values(trait: str) -> Mapping[str, Any]:
    """Noun → value of a trait that is a table."""
    values: Mapping[str, Any] = _read()[trait]
    return values
