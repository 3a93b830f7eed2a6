"""YAML of any origin: plain values, of a size that the text shows."""

from __future__ import annotations

from collections import Counter
from typing import Any

from texvent.errors import one_line, shown

MOST_VALUES = 100_000
"""Values of a document, those of an alias as often as it is named."""


def load_yaml(text: str | bytes) -> Any:
    """The values of a YAML document; None of an empty one.

    Raises:
        ValueError: it is not valid, names a key twice, is nested too deeply, or its aliases and
            merge keys stand for more than `MOST_VALUES` values.
    """
    import yaml  # only YAML files need it

    try:
        loader = yaml.SafeLoader(text)
        try:
            node = loader.get_single_node()
            if _count(node, {}) > MOST_VALUES:
                raise ValueError(f"its aliases stand for more than {MOST_VALUES:,} values")
            return None if node is None else loader.construct_document(node)
        finally:
            loader.dispose()
    except (yaml.YAMLError, OverflowError) as error:
        raise ValueError(one_line(error)) from error
    except RecursionError as error:
        raise ValueError("it is nested too deeply") from error


def _count(node: Any, counted: dict[int, int]) -> int:
    """Values of a node, those of aliases as often as they are named; too many of a cycle."""
    if id(node) not in counted:
        counted[id(node)] = MOST_VALUES + 1
        inside = getattr(node, "value", ())
        if isinstance(inside, str):
            inside = ()
        parts = [part for one in inside for part in (one if isinstance(one, tuple) else (one,))]
        keys = Counter(str(one[0].value) for one in inside if isinstance(one, tuple))
        twice = [key for key, times in keys.items() if times > 1]
        if twice:
            raise ValueError(f"{shown(twice[0])} is named twice")
        counted[id(node)] = 1 + sum(_count(part, counted) for part in parts)
    return counted[id(node)]
