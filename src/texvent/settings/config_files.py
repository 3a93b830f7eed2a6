"""Config files: options in TOML or YAML, or those stored in an event file."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

from texvent._registry import suggest
from texvent.errors import ConfigError, InputError, one_line, shown
from texvent.io.files import event_extensions, open_events
from texvent.runtime.files.file_names import usable_path
from texvent.runtime.files.yaml_text import load_yaml

Command = Literal["generate", "simulate"]
TABLES = ("run", "generate", "capture", "interpolate", "simulate")
"""Tables of a config file; options may also be outside them."""


def read_config(path: str | Path, command: Command | None = None) -> dict[str, Any]:
    """Options in a TOML or YAML file, or of the run that made an event file, tables flattened.

    Args:
        path: the file.
        command: of an event file, only options that this command has are taken; None: all.

    Raises:
        InputError: the file cannot be read.
        ConfigError: it is not valid TOML or YAML, holds no options or another table, or sets an
            option twice.
    """
    path = usable_path(path)
    if path.suffix.lower() in event_extensions() - {".txt", ".csv"}:
        return _options_of_run(path, command)
    document = read_document(path)
    for name, value in document.items():
        if isinstance(value, Mapping) and name not in TABLES:
            raise ConfigError(
                f"config file {path}: unknown table {shown(name)}; {suggest(name, TABLES)}"
            )
    return flatten_tables(document, path)


def read_document(path: Path) -> Mapping[str, Any]:
    """The tables of a TOML or YAML file.

    Raises:
        InputError: the file cannot be read.
        ConfigError: it is not valid TOML or YAML, or holds no names and values.
    """
    usable_path(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"cannot read config file {path}: {reason}; check its name") from error
    except UnicodeDecodeError as error:
        raise InputError(f"config file {path} is not UTF-8 text: {one_line(error)}") from error
    try:
        document = _parse(path, text)
    except (tomllib.TOMLDecodeError, ValueError, RecursionError) as error:
        raise ConfigError(f"config file {path} is not valid: {one_line(error)}") from error
    if not isinstance(document, Mapping):
        raise ConfigError(f"config file {path} must hold options by name, such as: seed = 3")
    return document


def flatten_tables(tables: Mapping[str, Any], path: Path) -> dict[str, Any]:
    """Options of tables, or outside them, by name.

    Raises:
        ConfigError: two tables set the same option.
    """
    flat: dict[str, Any] = {}
    for name, value in tables.items():
        for option, item in (value if isinstance(value, Mapping) else {name: value}).items():
            key = str(option).replace("-", "_")
            if key in flat:
                raise ConfigError(f"config file {path} sets {shown(key)} twice")
            flat[key] = item
    return flat


def _options_of_run(path: Path, command: Command | None) -> dict[str, Any]:
    tables = open_events(path).metadata.get("settings")
    if not isinstance(tables, Mapping):
        raise ConfigError(f"{path} does not say with which options it was made; give a TOML file")
    other = {"generate": "capture", "simulate": "generate", None: None}[command]
    return flatten_tables({name: one for name, one in tables.items() if name != other}, path)


def _parse(path: Path, text: str) -> Any:
    if path.suffix.lower() in (".yaml", ".yml"):
        return load_yaml(text) or {}
    if path.suffix.lower() == ".toml":
        return tomllib.loads(text)
    raise ValueError(f"its name must end in .toml, .yaml or .yml, not {shown(path.suffix)}")
