"""The TOML files of `models/data` as tables."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any


def list_data(folder: str) -> list[Traversable]:
    """The TOML files of a folder of `data`, in alphabetical order."""
    found = (files("texvent.scenes.models") / "data" / folder).iterdir()
    return sorted((one for one in found if one.name.endswith(".toml")), key=lambda one: one.name)


@cache
def read_table(name: str) -> Mapping[str, Any]:
    """The content of `data/<name>.toml`."""
    file = files("texvent.scenes.models") / "data" / f"{name}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def frozen(value: Any) -> Any:
    """Lists as tuples, all the way down."""
    return tuple(map(frozen, value)) if isinstance(value, list) else value
