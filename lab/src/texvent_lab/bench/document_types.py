"""Is what a JSON document holds of the types that its dataclass states?"""

from __future__ import annotations

import dataclasses
import types
import typing
from collections.abc import Mapping, Sequence
from typing import Any

from texvent.errors import FileFormatError, shown

LARGEST = 2**63
"""Numbers of results are smaller."""


def check_record(record_type: type, values: object, where: str) -> None:
    """Refuse values that no JSON object of a dataclass's fields gives.

    Args:
        record_type: a dataclass of numbers, texts, lists, mappings and dataclasses.
        values: what the document holds; NaN stands for null.
        where: what to call it in messages, such as `scores 3`.

    Raises:
        FileFormatError: a field is missing or of another type.
    """
    if not isinstance(values, Mapping):
        raise FileFormatError(f"{where} is {shown(values)}, not an object")
    for name, hint in typing.get_type_hints(record_type).items():
        if name not in values:
            raise FileFormatError(f"{where} lacks {name}")
        _check(hint, values[name], f"{where}: {name}")


def _check(hint: Any, value: object, where: str) -> None:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if hint is Any:
        return
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        check_record(hint, value, where)
    elif origin in (typing.Union, types.UnionType):
        if value is not None:
            _check(next(one for one in arguments if one is not type(None)), value, where)
    elif origin in (list, Sequence):
        _check_type(value, list, where)
        for one in typing.cast("list[object]", value):
            _check(arguments[0], one, where)
    elif origin is Mapping:
        _check_type(value, dict, where)
        for one in typing.cast("dict[str, object]", value).values():
            _check(arguments[1], one, where)
    elif hint in (int, float):
        _check_number(hint, value, where)
    else:
        _check_type(value, hint, where)


def _check_number(hint: Any, value: object, where: str) -> None:
    kinds = (int,) if hint is int else (int, float)
    if isinstance(value, bool) or not isinstance(value, kinds) or abs(value) >= LARGEST:
        raise FileFormatError(f"{where} holds {shown(value)}, not a {_NAMES[hint]}")


def _check_type(value: object, wanted: type, where: str) -> None:
    if not isinstance(value, wanted):
        raise FileFormatError(f"{where} is {shown(value)}, not {_NAMES[wanted]}")


_NAMES: Mapping[type, str] = {
    int: "whole number",
    float: "number",
    str: "a text",
    bool: "true or false",
    list: "a list",
    dict: "an object",
}
