"""Filter of words that go, until the tables of models have lost them: deleted then."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any, TypeVar

Value = TypeVar("Value")


@cache
def _lists() -> Mapping[str, Any]:
    text = (files("texvent.scenes.read") / "data" / "kept.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def kept(kind: str, table: Mapping[str, Value]) -> dict[str, Value]:
    """Entries of a table that stay; assets stay too."""
    names, gone = set(_lists()[kind]), set(_lists().get(f"gone {kind}", ()))
    return {
        name: one for name, one in table.items() if name in names or (gone and name not in gone)
    }
