"""Tables of people in `models/data`: activities, outfits, props."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any


@cache
def read_table(name: str) -> Mapping[str, Any]:
    """The content of `data/<name>.toml`."""
    file = files("texvent.scenes.models") / "data" / f"{name}.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))
