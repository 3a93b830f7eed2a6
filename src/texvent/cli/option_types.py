"""Options as a command line has them: the fields of config dataclasses, their flags and types."""

from __future__ import annotations

import argparse
import re
import types
import typing
from collections.abc import Iterable
from typing import Any, Literal, NamedTuple

from texvent.errors import shown
from texvent.options.values import SCALARS, option_help, option_names, types_of

REQUIRED: Any = object()
"""Default of a config field that the user must give."""
LONGEST_HELP = 120
"""Characters of an option's help that an error repeats."""


class Option(NamedTuple):
    """One option of a command."""

    name: str
    flags: tuple[str, ...]
    """Such as "-o" and "--out"; of an operand, its name in capitals."""
    hint: Any = str
    """Type of one value, without None."""
    text: str = ""
    default: Any = None
    is_operand: bool = False
    is_list: bool = False
    is_optional: bool = False
    """Whether "none" is a value."""

    @property
    def choices(self) -> dict[str, Any]:
        """Allowed values by their words, where they are listed."""
        is_listed = typing.get_origin(self.hint) is Literal
        return {str(one): one for one in typing.get_args(self.hint)} if is_listed else {}

    @property
    def brief(self) -> str:
        """Its help, up to the first full stop before a capital."""
        return re.split(r"(?<=[.!?])\s+(?=[A-Z])", self.text, maxsplit=1)[0]

    @property
    def purpose(self) -> str:
        """Its help, as long as errors repeat it."""
        return self.text[:200].rstrip(".")

    def read(self, word: str) -> Any:
        """A word as a value.

        Raises:
            argparse.ArgumentTypeError: it is none.
        """
        if word in self.choices:
            return self.choices[word]
        # As a text "none" may be a name: --interpolate none.
        if self.is_optional and self.hint is not str and word.lower() == "none":
            return None
        if self.choices:
            allowed = ", ".join(self.choices)
            raise argparse.ArgumentTypeError(f"{shown(word)} is not allowed; allowed: {allowed}")
        kind = SCALARS[self.hint]
        try:
            return kind.read(word)
        except (ValueError, ArithmeticError):
            brief = self.brief.rstrip(".")
            more = f" ({brief})" if 0 < len(brief) <= LONGEST_HELP else ""
            message = f"{shown(word)} is not {kind.words}{more}"
            raise argparse.ArgumentTypeError(message) from None


def flag_of(name: str) -> str:
    """The flag of an option, such as "--white-level"."""
    return f"--{name.replace('_', '-')}"


def declared_options(*configs: Any) -> Iterable[Option]:
    """The options of config instances, whose values are the defaults."""
    for config in configs:
        owner: type = type(config)
        hints, texts = types_of(owner), option_help(owner)
        short = getattr(config, "short_flags", {})
        for name in option_names(owner):
            hint, is_optional = hints[name], type(None) in typing.get_args(hints[name])
            if typing.get_origin(hint) in (typing.Union, types.UnionType):
                hint = next(one for one in typing.get_args(hint) if one is not type(None))
            is_list = typing.get_origin(hint) is tuple
            is_operand = name in getattr(config, "positional", ())
            yield Option(
                name,
                (name.upper(),) if is_operand else (*short.get(name, "").split(), flag_of(name)),
                typing.get_args(hint)[0] if is_list else hint,
                texts.get(name, ""),
                getattr(config, name),
                is_operand,
                is_list,
                is_optional,
            )
