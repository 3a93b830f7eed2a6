"""The types that options have on the command line: how help names them, how words are read."""

from __future__ import annotations

import types
import typing
from collections.abc import Iterable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, Literal

from texvent.options.values import parse_fraction

SCALARS: dict[Any, tuple[str, Any]] = {
    int: ("INT", int),
    float: ("FLOAT", float),
    str: ("TEXT", str),
    Path: ("PATH", Path),
    Fraction: ("RATE", parse_fraction),
}
"""Type → its name in help, and what reads it from a word."""


class _Required:
    """Type of the marker for an option that has no default."""


REQUIRED: Any = _Required()
"""Default of a config field that the user must give."""


def without_none(hint: Any) -> Any:
    """The type of an optional value, as given where there is one."""
    if typing.get_origin(hint) not in (typing.Union, types.UnionType):
        return hint
    return next(one for one in typing.get_args(hint) if one is not type(None))


def is_optional_switch(hint: Any) -> bool:
    """Whether an option is on, off or not said."""
    return bool(hint == (bool | None))


def spell_switches(words: Sequence[str], config_types: Iterable[type]) -> list[str]:
    """The words with switches that may be on, off or not said as the parser reads them.

    Example:
        >>> from texvent.config import InterpolateConfig
        >>> spell_switches(["a.mp4", "--no-motion-floor"], [InterpolateConfig])
        ['a.mp4', '--motion-floor=False']
    """
    spelt: dict[str, str] = {}
    for config_type in config_types:
        for name, hint in typing.get_type_hints(config_type).items():
            if is_optional_switch(hint):
                flag = name.replace("_", "-")
                spelt |= {f"--{flag}": f"--{flag}=True", f"--no-{flag}": f"--{flag}=False"}
    return [spelt.get(word.replace("_", "-"), word) for word in words]


def metavar(hint: Any) -> str:
    """What help puts behind a flag for its value; nothing for a switch.

    Example:
        >>> metavar(float | None), metavar(Literal["x", "y"]), metavar(tuple[int, ...])
        ('FLOAT', '{x,y}', '[INT ...]')
    """
    hint = without_none(hint)
    if hint is bool:
        return ""
    if typing.get_origin(hint) is Literal:
        return "{" + ",".join(map(str, typing.get_args(hint))) + "}"
    if typing.get_origin(hint) is tuple:
        return f"[{metavar(typing.get_args(hint)[0])} ...]"
    return SCALARS[hint][0]
