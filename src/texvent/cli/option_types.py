"""Options as a command line has them: the fields of config dataclasses, their flags and types."""

from __future__ import annotations

import types
import typing
from collections.abc import Iterator
from typing import Any, Literal, NamedTuple

from texvent.options.values import SCALARS, option_help, option_names


class _Required:
    """Type of the marker for an option that has no default."""


REQUIRED: Any = _Required()
"""Default of a config field that the user must give."""


class Option(NamedTuple):
    """One option of a command."""

    name: str
    flags: tuple[str, ...]
    """Such as "-o" and "--out"; of an operand, its name in capitals."""
    hint: Any
    """Type of one value, without None."""
    text: str
    default: Any
    is_operand: bool
    is_list: bool
    is_optional: bool
    """Whether "none" is a value."""

    @property
    def choices(self) -> tuple[Any, ...]:
        """Allowed values, where they are listed."""
        return typing.get_args(self.hint) if typing.get_origin(self.hint) is Literal else ()

    @property
    def metavar(self) -> str:
        """Placeholder of its value in help."""
        if self.choices:
            return "{" + ",".join(map(str, self.choices)) + "}"
        return SCALARS[self.hint].placeholder


def flag_of(name: str) -> str:
    """The flag of an option, such as "--white-level"."""
    return f"--{name.replace('_', '-')}"


def declared_options(config: Any) -> Iterator[Option]:
    """The options of a config instance, whose values are the defaults."""
    owner: type = type(config)
    hints, texts = typing.get_type_hints(owner), option_help(owner)
    for name in option_names(owner):
        hint, is_optional = hints[name], type(None) in typing.get_args(hints[name])
        if typing.get_origin(hint) in (typing.Union, types.UnionType):
            hint = next(one for one in typing.get_args(hint) if one is not type(None))
        is_list = typing.get_origin(hint) is tuple
        is_operand = name in getattr(config, "positional", ())
        short = getattr(config, "short_flags", {}).get(name)
        flags = (*(short or "").split(), flag_of(name))
        yield Option(
            name=name,
            flags=(name.upper(),) if is_operand else flags,
            hint=typing.get_args(hint)[0] if is_list else hint,
            text=texts.get(name, ""),
            default=getattr(config, name),
            is_operand=is_operand,
            is_list=is_list,
            is_optional=is_optional,
        )
