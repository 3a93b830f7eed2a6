"""The TOML files of `models/data` and `read/data` as tables, traits of nouns, and class ids.

The class id of a noun in label images, boxes and events is the same in every clip and version: new
nouns are added at the end of `truth/class_ids.toml` of texvent, and no number is ever given again.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any


def list_data(folder: str) -> list[Traversable]:
    """The TOML files of a folder of `data`, in alphabetical order."""
    found = (files("texvent_scenes.models") / "data" / folder).iterdir()
    return sorted((one for one in found if one.name.endswith(".toml")), key=lambda one: one.name)


@cache
def read_table(name: str, room: str = "models") -> Mapping[str, Any]:
    """The content of `data/<name>.toml` of a room of scenes."""
    file = files(f"texvent_scenes.{room}") / "data" / f"{name}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def frozen(value: Any) -> Any:
    """A copy with lists as tuples, all the way down."""
    if isinstance(value, Mapping):
        return {name: frozen(one) for name, one in value.items()}
    return tuple(map(frozen, value)) if isinstance(value, list) else value


@cache
def _read() -> Mapping[str, Any]:
    """Trait → its nouns, or its nouns with their values."""
    found: dict[str, Any] = {}
    for file in list_data("traits"):
        found |= read_table(f"traits/{file.name.removesuffix('.toml')}")
    return {
        trait: {noun: value for key, value in nouns.items() for noun in key.split(", ")}
        if isinstance(nouns, Mapping) else nouns
        for trait, nouns in found.items()
    }  # fmt: skip


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
