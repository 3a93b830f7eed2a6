"""YAML of any origin: plain values, of a size that the text shows.

Plain words mean values as in the core schema of YAML 1.2, with _ between digits. In 1.1, which
PyYAML reads, 1:30 is 90, 010 is 8, 1e-3 is a text, a date is none, and no, off and on are true or
false.
"""

from __future__ import annotations

import functools
import re
from collections import Counter
from collections.abc import Sequence
from typing import Any

from texvent.errors import one_line, shown

MOST_VALUES = 100_000
"""Values of a document, those of an alias as often as it is named."""
PLAIN_WORDS = {
    "null": r"~|null|Null|NULL|",
    "bool": r"true|True|TRUE|false|False|FALSE",
    "int": r"[-+]?\d[\d_]*|0o[0-7]+|0x[0-9a-fA-F]+",
    "float": r"[-+]?(\.\d+|\d[\d_]*(\.[\d_]*)?)([eE][-+]?\d+)?|[-+]?\.(?i:inf)|\.(?i:nan)",
    "merge": r"<<",
}
"""Tag → its words; the first that fits counts."""


def load_yaml(text: str | bytes) -> Any:
    """The values of a YAML document; None of an empty one.

    Raises:
        ValueError: it is not valid, names a key twice, is nested too deeply, or its aliases and
            merge keys stand for more than `MOST_VALUES` values.
    """
    import yaml  # only YAML files need it

    try:
        loader = _loader_type()(text)
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


@functools.cache
def _loader_type() -> Any:
    """PyYAML's safe loader, with `PLAIN_WORDS`."""
    import yaml

    loader_type: Any = type("Loader", (yaml.SafeLoader,), {"yaml_implicit_resolvers": {}})

    def whole(loader: Any, node: Any) -> int:
        text = loader.construct_scalar(node).replace("_", "")
        return int(text, 0 if text[:2] in ("0o", "0x") else 10)

    for name, words in PLAIN_WORDS.items():
        tag = f"tag:yaml.org,2002:{name}"
        loader_type.add_implicit_resolver(tag, re.compile(f"(?:{words})$", re.ASCII), None)
    loader_type.add_constructor("tag:yaml.org,2002:int", whole)
    return loader_type


def keys_once(pairs: Sequence[tuple[Any, Any]]) -> dict[Any, Any]:
    """A mapping of pairs; `object_pairs_hook` of JSON that people write.

    Raises:
        ValueError: a key is named twice.
    """
    check_once([key for key, _ in pairs])
    return dict(pairs)


def check_once(names: Sequence[Any]) -> None:
    """Refuse names of which one is there twice.

    Raises:
        ValueError: it says which.
    """
    if len(set(names)) < len(names):
        twice = next(name for name, times in Counter(names).items() if times > 1)
        raise ValueError(f"{shown(twice)} is named twice")


def _count(node: Any, counted: dict[int, int]) -> int:
    """Values of a node, those of aliases as often as they are named; too many of a cycle."""
    if id(node) not in counted:
        counted[id(node)] = MOST_VALUES + 1
        inside = getattr(node, "value", ())
        if isinstance(inside, str):
            inside = ()
        parts = [part for one in inside for part in (one if isinstance(one, tuple) else (one,))]
        check_once([str(one[0].value) for one in inside if isinstance(one, tuple)])
        counted[id(node)] = 1 + sum(_count(part, counted) for part in parts)
    return counted[id(node)]
