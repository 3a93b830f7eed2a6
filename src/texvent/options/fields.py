"""The options that a config dataclass declares or once had: names, former names and help."""

from __future__ import annotations

import ast
import dataclasses
import inspect
import itertools
import textwrap
import warnings
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple, cast

from texvent.errors import ConfigError, shown


class RenamedOptionWarning(FutureWarning):
    """An option was given by its former name, which works for one more release."""


def renamed(default: Any, *, was: str, was_switch: bool = False) -> Any:
    """A field whose option had another name in the release before.

    Args:
        default: of the option.
        was: its former name.
        was_switch: the former option was on or off, which are 1 and 0 of this one.

    Example:
        >>> @dataclasses.dataclass(frozen=True)
        ... class Example:
        ...     deflicker: bool = renamed(False, was="flicker_guard")
        >>> former_names([Example])
        {'flicker_guard': 'deflicker'}
    """
    return dataclasses.field(default=default, metadata={"was": was, "was_switch": was_switch})


class RemovedOption(NamedTuple):
    """An option that a config dataclass had before; its class attribute `removed` lists them."""

    value: Any
    """The one value that says what now holds always: taken and left out."""
    reason: str
    """What to say of other values, behind a semicolon."""


def removed_options(config_types: Iterable[type]) -> dict[str, RemovedOption]:
    """Name → option, of those that config dataclasses had before."""
    return {
        name: option
        for config_type in config_types
        for name, option in getattr(config_type, "removed", {}).items()
    }


def option_names(config_type: type) -> tuple[str, ...]:
    """Names of the options of a config dataclass, in order."""
    return tuple(field.name for field in dataclasses.fields(config_type))


def option_help(config_type: type) -> dict[str, str]:
    """Option name → the text under its field, on one line; also what `--help` shows."""
    texts: dict[str, str] = {}
    for owner in reversed(config_type.__mro__):
        if not dataclasses.is_dataclass(owner):
            continue
        body = cast("ast.ClassDef", ast.parse(textwrap.dedent(inspect.getsource(owner))).body[0])
        for field, text in itertools.pairwise(body.body):
            if (
                isinstance(field, ast.AnnAssign)
                and isinstance(field.target, ast.Name)
                and isinstance(text, ast.Expr)
                and isinstance(text.value, ast.Constant)
            ):
                texts[field.target.id] = " ".join(str(text.value.value).split())
    return texts


def former_names(config_types: Iterable[type]) -> dict[str, str]:
    """Former name → name, of the options that have one."""
    return {
        field.metadata["was"]: field.name
        for config_type in config_types
        for field in dataclasses.fields(config_type)
        if "was" in field.metadata
    }


def former_switches(config_types: Iterable[type]) -> set[str]:
    """Options, by their names of today, that are numbers now and were switches before."""
    return {
        field.name
        for config_type in config_types
        for field in dataclasses.fields(config_type)
        if field.metadata.get("was_switch")
    }


def with_current_names(
    options: Mapping[str, Any], config_types: Iterable[type], *, where: str
) -> dict[str, Any]:
    """The options by their names of today; a former name is taken with a `RenamedOptionWarning`.

    A removed option is left out, as files of former releases have it.

    Args:
        options: name → value.
        config_types: config dataclasses that declare the options.
        where: what to call the source of the options in messages.

    Raises:
        ConfigError: an option is given by both of its names, or a removed one has another value
            than what now holds always.
    """
    config_types = tuple(config_types)
    former, removed = former_names(config_types), removed_options(config_types)
    switches = former_switches(config_types)
    current: dict[str, Any] = {}
    for name, value in options.items():
        if name in removed:
            if value != removed[name].value:
                raise ConfigError(
                    f"{where}: {name} {shown(value)} was removed; {removed[name].reason}"
                )
            continue
        now = former.get(name, name)
        if now != name:
            if now in options:
                raise ConfigError(
                    f"{where}: {shown(name)} is the former name of {now!r}, which is given too; "
                    f"leave {shown(name)} out"
                )
            warnings.warn(
                f"{where}: option {shown(name)} is now {now!r}; the former name goes with the next "
                "release",
                RenamedOptionWarning,
                stacklevel=2,
            )
            if now in switches and isinstance(value, bool):
                value = float(value)
        current[now] = value
    return current
