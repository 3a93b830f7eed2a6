"""Trainings from TOML and YAML files."""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

from texvent.errors import ConfigError, shown
from texvent.options.values import with_options
from texvent.settings.config_files import read_document

Config = TypeVar("Config")


def read_training(path: Path, config: Config) -> Config:
    """The training in a file; paths in it count from its folder.

    Args:
        path: a `.toml`, `.yaml` or `.yml` file.
        config: the defaults of the task, a dataclass; its tables are dataclasses too.

    Raises:
        InputError: the file cannot be read.
        ConfigError: an unknown name, or a value that does not fit.
    """
    return with_tables(config, read_document(path), folder=path.parent, where=str(path))


def with_tables(config: Config, tables: Mapping[str, Any], *, folder: Path, where: str) -> Config:
    """A copy of a config with values replaced, in its tables too.

    Args:
        config: the defaults.
        tables: name → value; of a table, name → value again.
        folder: that relative paths count from.
        where: what to call them in messages.

    Raises:
        ConfigError: as `read_training`.
    """
    hints = typing.get_type_hints(type(config))
    values: dict[str, Any] = {}
    for name, value in tables.items():
        name = name.replace("-", "_")
        inner = getattr(config, name, None)
        if dataclasses.is_dataclass(inner):
            if not isinstance(value, Mapping):
                raise ConfigError(f"{where}: {name} is {shown(value)}; it must be a table")
            inner = with_tables(inner, value, folder=folder, where=f"{where}: {name}")
            config = dataclasses.replace(config, **{name: inner})  # type: ignore[type-var]
        elif Path in (hints.get(name), *typing.get_args(hints.get(name))):
            values[name] = str(folder / str(value))
        else:
            values[name] = value
    return with_options(config, values, where=where)
