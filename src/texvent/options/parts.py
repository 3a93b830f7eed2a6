"""Parts with options in one text: `background-activity:window_us=5000,support=2`."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from texvent._registry import Registry, suggest
from texvent.errors import ConfigError, TexventError, shown
from texvent.options.values import convert, types_of

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
