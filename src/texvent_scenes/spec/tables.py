"""Frozen dataclasses as tables of plain values: read, checked and written by their field types."""

from __future__ import annotations

import dataclasses
import types
import typing
from collections.abc import Mapping
from functools import cache, wraps
from typing import Annotated, Any, get_args, get_origin

from texvent._registry import suggest
from texvent.errors import ConfigError, shown
from texvent.options.values import convert
from texvent_scenes.spec.limits import Vocabulary


@cache
def field_types(owner: type) -> dict[str, Any]:
    """Field → its type with its limits, of a dataclass."""
    return typing.get_type_hints(owner, include_extras=True)


def inner_type(hint: Any) -> Any:
    """The type of an optional field when it is given; any other type is its own."""
    if get_origin(hint) in (typing.Union, types.UnionType):
        return next(one for one in get_args(hint) if one is not types.NoneType)
    return hint


def plain_type(hint: Any) -> Any:
    """The type of a field when it is given, without its limits."""
    inner = inner_type(hint)
    return get_args(inner)[0] if get_origin(inner) is Annotated else inner


def required_fields(owner: type) -> list[str]:
    """Fields without a default."""
    return [
        one.name
        for one in dataclasses.fields(owner)
        if one.default is dataclasses.MISSING and one.default_factory is dataclasses.MISSING
    ]


def explain_fields(owner: Any) -> None:
    """Let a wrong call of a dataclass be an error of one line, as a wrong table of a file is."""
    build, names = owner.__init__, tuple(one.name for one in dataclasses.fields(owner))
    needed = tuple(required_fields(owner))

    @wraps(build)
    def init(self: Any, *values: Any, **fields: Any) -> None:
        for name in fields:
            if name not in names:
                known = suggest(name, names)
                raise ConfigError(f"{owner.__name__} has no field {shown(name)}; {known}")
        if len(values) > len(names):
            raise ConfigError(f"{owner.__name__} has {len(names)} fields; {len(values)} are given")
        for name in names[: len(values)]:
            if name in fields:
                raise ConfigError(f"{owner.__name__}.{name} is given twice; leave one of them out")
        for name in needed:
            if name not in (*names[: len(values)], *fields):
                raise ConfigError(f"{owner.__name__} has no {name}, which it must have")
        build(self, *values, **fields)

    owner.__init__ = init


def plain_values(value: Any) -> Any:
    """Tables and lists of a dataclass; fields at their defaults are left out."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        members = dataclasses.fields(value)
        named = {one.name: plain_values(getattr(value, one.name)) for one in members}
        usual = {one.name: plain_values(_default(one)) for one in members}
        return {name: one for name, one in named.items() if one != usual[name]}
    if hasattr(value, "tolist"):  # NumPy's arrays and numbers
        value = value.tolist()
    if isinstance(value, Mapping):
        return {name: plain_values(one) for name, one in value.items()}
    return [plain_values(one) for one in value] if isinstance(value, (list, tuple)) else value


def _default(field: dataclasses.Field[Any]) -> Any:
    if field.default_factory is not dataclasses.MISSING:
        return field.default_factory()
    return field.default


def _build(hint: Any, value: Any, where: str, words: Vocabulary) -> Any:
    """`value` as the type `hint`, whose path is `where`; see `build_table`."""
    if value is None and inner_type(hint) is not hint:
        return None
    hint = inner_type(hint)
    if get_origin(hint) is Annotated:
        plain, *limits = get_args(hint)
        built = _build(plain, value, where, words)
        for limit in limits:
            limit.check(built, where, words)
        return built
    if get_origin(hint) is tuple:
        if not isinstance(value, (list, tuple)):
            raise ConfigError(f"{where} is {shown(value)}; it must be a list")
        items = get_args(hint)
        if items[-1] is Ellipsis:
            items = items[:1] * len(value)
        if len(items) != len(value):
            raise ConfigError(f"{where} is {shown(value)}; it must have {len(items)} numbers")
        return tuple(
            _build(item, one, f"{where}[{n}]", words)
            for n, (item, one) in enumerate(zip(items, value, strict=True))
        )
    if dataclasses.is_dataclass(hint):
        return build_table(hint, value, where, words)
    return convert(value, hint, where)


def build_table(owner: Any, value: Any, where: str, words: Vocabulary) -> Any:
    """An instance of a dataclass from the table of its fields.

    Raises:
        ConfigError: a field is unknown, missing, of a wrong type or out of range; the message
            begins with the path of the field.
    """
    kinds, table = field_types(owner), where or "scene"
    if not isinstance(value, Mapping):
        raise ConfigError(f"{table} is {shown(value)}; it must be a table of fields")
    for name in value:
        if name not in kinds:
            raise ConfigError(f"{table} has no field {shown(name)}; {suggest(name, tuple(kinds))}")
    for name in required_fields(owner):
        if name not in value:
            raise ConfigError(f"{table} has no {name}, which it must have")
    prefix = f"{where}." if where else ""
    return owner(
        **{name: _build(kinds[name], one, prefix + name, words) for name, one in value.items()}
    )
