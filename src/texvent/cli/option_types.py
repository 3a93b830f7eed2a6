"""The types that options have on the command line: how help names them, how words are read."""

from __future__ import annotations

import types
import typing
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


def metavar(hint: Any) -> str:
    """Placeholder of a flag's value in help; empty for a switch.

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
