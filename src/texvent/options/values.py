"""Options of config dataclasses: names, help, and values, which are converted to their types.

Parts with options are one text: `background-activity:window_us=5000,support=2`.
"""

from __future__ import annotations

import ast
import dataclasses
import functools
import inspect
import itertools
import re
import textwrap
import types
import typing
from collections.abc import Callable, Mapping
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, NamedTuple, TypeVar

from texvent._registry import Registry, suggest
from texvent.errors import ConfigError, InputError, TexventError, shown
from texvent.options.arrays import as_number

WORDS = {"true": True, "false": False, "none": None}


def make_part(
    registry: Registry, text: str, options: Mapping[str, Any] = MappingProxyType({})
) -> Any:
    """An instance of a part whose options are the fields of its dataclass.

    Args:
        registry: its kind.
        text: its name, or `name:option=value,option=value`.
        options: more of them.

    Raises:
        ConfigError: unknown name or option, or a value of another type or out of range.
        TexventError: the part, of another package, is no dataclass.
    """
    name, written = read_part(text)
    part_type = registry.load(name)
    if not (isinstance(part_type, type) and dataclasses.is_dataclass(part_type)):
        raise TexventError(
            f"{registry.kind} {name!r} is {shown(part_type)}, no dataclass; the package that adds "
            "it must make it one, whose fields are its options"
        )
    hints = types_of(part_type)
    allowed = tuple(field.name for field in dataclasses.fields(part_type) if field.init)
    values = {}
    for option, value in {**written, **options}.items():
        if option not in allowed:
            raise ConfigError(f"{name} has no option {shown(option)}; {suggest(option, allowed)}")
        values[option] = convert(value, hints[option], f"{name}: {option}")
    missing = [
        field.name
        for field in dataclasses.fields(part_type)
        if field.name not in values and _is_needed(field)
    ]
    if missing:
        words = ",".join(f"{option}=VALUE" for option in missing)
        raise ConfigError(f"{name} needs {', '.join(missing)}; write {name}:{words}")
    return part_type(**values)


def read_part(text: str) -> tuple[str, dict[str, Any]]:
    """Name and options of a text.

    Raises:
        ConfigError: an option without a value, or given twice.

    Example:
        >>> read_part("drop-events:share=0.1,seen=true")
        ('drop-events', {'share': 0.1, 'seen': True})
    """
    name, _, rest = text.partition(":")
    options: dict[str, Any] = {}
    for part in rest.split(",") if rest else []:
        option, equals, value = (word.strip() for word in part.partition("="))
        if not equals or not option or not value or option in options:
            raise ConfigError(
                f"{shown(text)} is no part with options; write NAME or NAME:OPTION=VALUE,..., each "
                "option once"
            )
        options[option] = _value(value)
    return name.strip(), options


def _value(text: str) -> Any:
    """A word as a number, a truth value or itself."""
    if text.lower() in WORDS:
        return WORDS[text.lower()]
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def _is_needed(field: dataclasses.Field[Any]) -> bool:
    missing = dataclasses.MISSING
    return field.init and field.default is missing and field.default_factory is missing


Config = TypeVar("Config")
types_of: Callable[[type], dict[str, Any]] = functools.cache(typing.get_type_hints)
"""Types of a dataclass's fields by their names; Python compiles each anew whenever it is asked."""
MAX_DIGITS = 100
"""Characters of a number; a Unix time in ns has 19."""
_HUGE = r"[eE][+-]?[\d_]{4,}"
"""Exponents of which the exact number would fill the memory."""


def with_options(config: Config, options: Mapping[str, Any], *, where: str) -> Config:
    """A copy of `config` with some options replaced, each converted to its declared type.

    Args:
        config: an instance of a config dataclass.
        options: name → value; text such as "30000/1001" is accepted where the type allows.
        where: what to call the source of the options in messages, such as "config file run.toml".

    Raises:
        ConfigError: an unknown name, a value of the wrong type, or one out of range.
    """
    config_type = type(config)
    names = option_names(config_type)
    hints = types_of(config_type)
    converted: dict[str, Any] = {}
    for name, value in options.items():
        if name not in names:
            raise ConfigError(f"{where}: unknown option {shown(name)}; {suggest(name, names)}")
        converted[name] = convert(value, hints[name], f"{where}: {name}")
    return dataclasses.replace(config, **converted)  # type: ignore[type-var]


def plain(value: Any) -> Any:
    """A config (or a nesting of them) as JSON- and TOML-ready values, without None entries."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        named = {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
        return plain(named)
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items() if item is not None}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, Fraction):
        return int(value) if value.denominator == 1 else str(value)
    if isinstance(value, Path):
        return str(value)
    return value


def convert(value: Any, hint: Any, where: str) -> Any:
    """`value` as type `hint`; bool, int, float, str, Path, Fraction, Literal and unions of them.

    For a tuple of any number of those, one alone is taken too. Values of other types are taken as
    they are.

    Raises:
        ConfigError: it is of another type; the message begins with `where`.
    """
    try:
        value = as_number(value)
    except (TypeError, InputError):
        raise ConfigError(f"{where} is {shown(value)}; give a plain number or text") from None
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is Literal:
        if value not in arguments:
            allowed = tuple(str(argument) for argument in arguments)
            raise ConfigError(f"{where} is {shown(value)}; {suggest(value, allowed)}")
        return value
    if origin is tuple and arguments[-1] is Ellipsis:
        several = value if isinstance(value, (list, tuple)) else (value,)
        return tuple(convert(one, arguments[0], where) for one in several)
    if origin in (typing.Union, types.UnionType):
        if value is None and type(None) in arguments:
            return None
        return convert(value, next(one for one in arguments if one is not type(None)), where)
    try:
        return SCALARS[hint].convert(value)
    except KeyError:
        return value
    except (TypeError, ValueError, ArithmeticError):
        raise ConfigError(f"{where} is {shown(value)}; it must be {SCALARS[hint].words}") from None


def _bool(value: Any) -> bool:
    if not isinstance(value, bool):
        raise TypeError
    return value


def _int(value: Any) -> int:
    if isinstance(value, bool) or int(value) != value:
        raise TypeError
    return int(value)


def _float(value: Any) -> float:
    if isinstance(value, (bool, str)):
        raise TypeError
    return float(value)


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value


def parse_fraction(value: Any) -> Fraction:
    """A rate from 24, 29.97, "29.97" or "30000/1001", exactly as written in decimal."""
    if isinstance(value, bool):
        raise TypeError
    value = as_number(value)
    text = str(value) if isinstance(value, (float, Decimal)) else value
    if isinstance(text, str) and (len(text) > MAX_DIGITS or re.search(_HUGE, text)):
        raise ValueError(text[:MAX_DIGITS])
    return Fraction(text)


class Scalar(NamedTuple):
    """A type that options have."""

    placeholder: str
    """Its name in help."""
    words: str
    convert: Callable[[Any], Any]
    """Takes a value of a file or of Python."""
    read: Callable[[str], Any]
    """Takes a word of a command line."""


SCALARS: Mapping[Any, Scalar] = {
    bool: Scalar("", "true or false", _bool, _bool),
    int: Scalar("INT", "a whole number", _int, int),
    float: Scalar("FLOAT", "a number", _float, float),
    str: Scalar("TEXT", "text", _text, str),
    Path: Scalar("PATH", "a path", Path, Path),
    Fraction: Scalar(
        "RATE", "a rate such as 24, 29.97 or 30000/1001", parse_fraction, parse_fraction
    ),
}


def option_names(config_type: type) -> tuple[str, ...]:
    """Names of the options of a config dataclass, in order."""
    return tuple(field.name for field in dataclasses.fields(config_type))


@functools.cache
def option_help(config_type: type) -> Mapping[str, str]:
    """Option name → the text under its field, on one line; also what `--help` shows."""
    texts: dict[str, str] = {}
    for owner in reversed(config_type.__mro__):
        if not dataclasses.is_dataclass(owner):
            continue
        body = typing.cast(
            "ast.ClassDef", ast.parse(textwrap.dedent(inspect.getsource(owner))).body[0]
        )
        for field, text in itertools.pairwise(body.body):
            if (
                isinstance(field, ast.AnnAssign)
                and isinstance(field.target, ast.Name)
                and isinstance(text, ast.Expr)
                and isinstance(text.value, ast.Constant)
            ):
                texts[field.target.id] = " ".join(str(text.value.value).split())
    return texts
