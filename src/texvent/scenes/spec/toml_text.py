"""TOML for people: a table for each object, its motions and relations on one line each."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

LONGEST_LINE = 100
"""Characters of a list on one line; the items of a longer one have lines of their own."""


def toml_text(data: Mapping[str, Any]) -> str:
    """TOML 1.0 of tables, lists, text, numbers and booleans.

    Example:
        >>> print(toml_text({"objects": [{"noun": "car", "motions": [{"kind": "drive"}]}]}))
        [[objects]]
        noun = "car"
        motions = [{ kind = "drive" }]
        <BLANKLINE>
    """
    plain = {name: one for name, one in data.items() if not _is_table(one) and not _is_tables(one)}
    blocks = [_fields(plain)] if plain else []
    for name, one in data.items():
        if name not in plain:
            title = f"[{name}]" if _is_table(one) else f"[[{name}]]"
            blocks += [f"{title}\n{_fields(each)}" for each in ([one] if _is_table(one) else one)]
    return "\n".join(blocks)


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and all(map(_is_table, value)) and bool(value)


def _fields(table: Mapping[str, Any]) -> str:
    return "".join(_field(name, value) for name, value in table.items())


def _field(name: str, value: Any) -> str:
    line = f"{name} = {_inline(value)}\n"
    if len(line) <= LONGEST_LINE or not isinstance(value, list):
        return line
    items = "".join(f"    {_inline(one)},\n" for one in value)
    return f"{name} = [\n{items}]\n"


def _inline(value: Any) -> str:
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{name} = {_inline(one)}' for name, one in value.items())} }}"
    if isinstance(value, list):
        return f"[{', '.join(map(_inline, value))}]"
    # JSON and TOML write booleans, numbers and text alike, but for one control character.
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
