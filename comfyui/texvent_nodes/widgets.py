"""Options of texvent as inputs of nodes: type, default and help from the dataclasses."""

from __future__ import annotations

import math
import types
import typing
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any, Literal

from texvent.errors import ConfigError
from texvent.options.values import option_help, option_names, with_options

Widget = tuple[Any, dict[str, Any]]
"""Type of an input, or its choices; and what ComfyUI's page knows of it."""
LARGEST_INT = 2**53 - 1
"""Largest whole number that JavaScript holds exactly."""
FLOATS = {"min": -1e12, "max": 1e12}


def widgets(config: Any, names: Iterable[str] = ()) -> dict[str, Widget]:
    """Inputs for options of a config.

    Args:
        config: an instance of a dataclass, whose values are the defaults.
        names: options; default: all.
    """
    hints = typing.get_type_hints(type(config))
    helps = option_help(type(config))
    return {
        name: _widget(config, name, hints[name], helps.get(name, ""))
        for name in names or option_names(type(config))
    }


def with_values(config: Any, values: Mapping[str, Any], *, where: str) -> Any:
    """A copy of `config` with the values of its inputs; an empty text is no value.

    Raises:
        ConfigError: a value of the wrong type, or out of range.
    """
    hints = typing.get_type_hints(type(config))
    given = {}
    for name, value in values.items():
        if hints[name] != _plain_type(hints[name]):
            value = _optional(value, _plain_type(hints[name]), f"{where}: {name}")
        if value is not None:
            given[name] = value
    return with_options(config, given, where=where)


def _widget(config: Any, name: str, hint: Any, help_text: str) -> Widget:
    default, kind = getattr(config, name), _plain_type(hint)
    facts: dict[str, Any] = {"default": default, "tooltip": help_text}
    if typing.get_origin(kind) is Literal:
        return [str(one) for one in typing.get_args(kind)], facts
    if kind is bool:
        return "BOOLEAN", facts
    if hint != kind or kind not in (int, float):
        return "STRING", {**facts, "default": "" if default is None else str(default)}
    # Wide, because the node itself refuses what the option does not take.
    if kind is int:
        return "INT", {**facts, "min": -LARGEST_INT, "max": LARGEST_INT, "step": 1}
    step = 10.0 ** (math.floor(math.log10(abs(default))) - 1) if default else 0.01
    return "FLOAT", {**facts, **FLOATS, "step": step, "round": False}


def _plain_type(hint: Any) -> Any:
    """The type of an optional value where there is one."""
    if typing.get_origin(hint) not in (typing.Union, types.UnionType):
        return hint
    return next(one for one in typing.get_args(hint) if one is not type(None))


def _optional(value: Any, kind: Any, where: str) -> Any:
    """A value that may be left out, from its text."""
    text = str(value).strip()
    if text == "":
        return None
    if kind not in (int, float):
        return text
    try:
        number = Fraction(text)
    except (ValueError, ZeroDivisionError):
        raise ConfigError(f"{where} is {text[:80]!r}; it must be a number, or empty") from None
    return int(number) if number.denominator == 1 else float(number)
