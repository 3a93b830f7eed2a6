"""Class ids of nouns in label images, boxes and events: the same in every clip and version.

New nouns are added at the end of `class_ids.toml`, and no number is given to another noun.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from importlib.resources import files
from types import MappingProxyType

BACKGROUND = 0
"""Class of what is no object: ground, sky, walls, scenery without an id."""
UNNAMED = 1000
"""Class of an object whose name is not known."""
FIRST_OTHER = 2001
"""Numbers of names that are no nouns of the embedded generator begin here."""


_FILE = files(__package__) / "class_ids.toml"
_NAMES: list[str] = tomllib.loads(_FILE.read_text(encoding="utf-8"))["nouns"].split(",")
CLASS_IDS: Mapping[str, int] = MappingProxyType(
    {" ".join(name.split()): number for number, name in enumerate(_NAMES, start=1)}
)
"""Noun → class id, 1, 2, ..., of nouns that are gone too."""


def class_ids_of(names: Iterable[str]) -> dict[str, int]:
    """The class ids of names; those of no noun are numbered in alphabetical order.

    Args:
        names: class names, such as "car".

    Returns:
        Name → class id.

    Example:
        >>> class_ids_of(["zeppelin", "dirigible"])
        {'dirigible': 2001, 'zeppelin': 2002}
    """
    asked = set(names)
    others = enumerate(sorted(asked - CLASS_IDS.keys()), start=FIRST_OTHER)
    known = {name: CLASS_IDS[name] for name in sorted(asked & CLASS_IDS.keys())}
    return known | {name: number for number, name in others}
