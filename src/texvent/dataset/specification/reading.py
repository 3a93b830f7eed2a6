"""Specifications from TOML and YAML files, and back from what a data set folder stores."""

from __future__ import annotations

import typing
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from texvent._registry import suggest
from texvent.dataset.specification.list_files import read_list
from texvent.dataset.specification.specification import (
    Filters,
    SampleSource,
    Specification,
    Variant,
)
from texvent.errors import ConfigError, InputError, shown
from texvent.options.values import convert, with_options
from texvent.settings.config_files import read_document

_SCALARS = ("name", "description", "license", "seed", "repeats", "samples_per_shard", "previews",
            "store_videos", "allow_classes")  # fmt: skip


def read_specification(path: str | Path) -> Specification:
    """The specification in a file; paths in it count from its folder.

    Args:
        path: a `.toml`, `.yaml` or `.yml` file.

    Raises:
        InputError: the file cannot be read.
        ConfigError: it is no valid specification; the message says what and what is allowed.

    Example:
        >>> import pathlib
        >>> from texvent.dataset import read_specification
        >>> text = "{name: balls, sources: [{prompts: [a red ball bounces, a dog runs]}]}"
        >>> size = pathlib.Path("balls.yaml").write_text(text)
        >>> read_specification("balls.yaml").sources[0].prompts
        ('a red ball bounces', 'a dog runs')
    """
    path = Path(path)
    return specification_from(read_document(path), folder=path.parent, where=str(path))


def specification_from(
    tables: Mapping[str, Any], *, folder: Path, where: str = "specification"
) -> Specification:
    """A specification from plain values, as a file holds them.

    Args:
        tables: names as the fields of `Specification`; `variants` is a table of tables.
        folder: that relative paths count from.
        where: what to call it in messages.

    Raises:
        ConfigError, InputError: as `read_specification`.
    """
    tables = _known(tables, [one.name for one in fields(Specification)], where)
    scalars = {name: tables[name] for name in _SCALARS if name in tables}
    sources = tables.get("sources", ())
    if not isinstance(sources, Sequence) or isinstance(sources, str):
        raise ConfigError(f"{where}: sources is {shown(sources)}; it must be a list of tables")
    try:
        parts = {
            "sources": tuple(
                _source(one, folder, f"{where}: source {number}")
                for number, one in enumerate(sources, start=1)
            ),
            "splits": _table(tables.get("splits", {"train": 1.0}), f"{where}: splits"),
            "options": _options(tables.get("options", {}), f"{where}: options"),
            "variants": _variants(tables.get("variants", {}), where),
            "truth": tables.get("truth", ()),
            "classes": _classes(tables.get("classes", ())),
            "filters": with_options(
                Filters(), _options(tables.get("filters", {}), where), where=f"{where}: filters"
            ),
        }
        empty = Specification(name="none", sources=(SampleSource(prompts=("none",)),))
        return with_options(empty, {"name": "", **scalars, **parts}, where=where)
    except ConfigError as error:
        raise ConfigError(_with_place(str(error), where)) from error


def _with_place(message: str, where: str) -> str:
    return message if message.startswith(where) else f"{where}: {message}"


def _known(value: Any, names: Sequence[str], where: str) -> dict[str, Any]:
    """A table of which all names are known; - counts as _."""
    table = {name.replace("-", "_"): one for name, one in _table(value, where).items()}
    for name in table:
        if name not in names:
            raise ConfigError(f"{where}: unknown {shown(name)}; {suggest(name, tuple(names))}")
    return table


def _table(value: Any, where: str) -> dict[str, Any]:
    if not isinstance(value, Mapping) or not all(isinstance(name, str) for name in value):
        raise ConfigError(f"{where} is {shown(value)}; it must be a table of names and values")
    return dict(value)


def _options(value: Any, where: str) -> dict[str, Any]:
    return {name.replace("-", "_"): one for name, one in _table(value, where).items()}


def _variants(value: Any, where: str) -> tuple[Variant, ...]:
    if not value:
        return (Variant(),)
    if isinstance(value, Sequence) and not isinstance(value, str):  # as `Specification.tables`
        value = {
            str(one.get("name")): {
                **_table(one.get("options", {}), where),
                **{name: one[name] for name in ("seeds",) if name in one},
            }
            for one in map(lambda one: _table(one, f"{where}: variant"), value)
        }
    variants = []
    for name, table in _table(value, f"{where}: variants").items():
        options = _options(table, f"{where}: variant {name}")
        own = {"seeds": options.pop("seeds")} if "seeds" in options else {}
        variant = with_options(Variant(name=name), own, where=f"{where}: variant {name}")
        variants.append(replace(variant, options=options))
    return tuple(variants)


def _classes(value: Any) -> Any:
    """Classes as a file names them; pairs, as `Specification.tables` has them, become a table."""
    is_list = isinstance(value, Sequence) and not isinstance(value, str)
    if is_list and all(isinstance(one, list) and len(one) == 2 for one in value):
        return {str(noun): name for noun, name in value}
    return value


def _source(value: Any, folder: Path, where: str) -> SampleSource:
    table = _known(value, [*(one.name for one in fields(SampleSource)), "classes"], where)
    table = {name: one for name, one in table.items() if one or isinstance(one, int)}
    if "classes" in table:
        if "template" not in table:
            raise ConfigError(f'{where}: classes need a template, such as "a photo of a {{class}}"')
        words = _table(table.get("words", {}), f"{where}: words")
        table["words"] = {**words, "class": table.pop("classes")}
        table.setdefault("label", "{class}")
    for name in ("words", "vary"):
        if name in table:
            table[name] = _table(table[name], f"{where}: {name}")
    if "words" in table:
        words = table["words"].items()
        table["words"] = {word: _words(one, folder, f"{where}: {word}") for word, one in words}
    hints = typing.get_type_hints(SampleSource)
    table = {name: convert(one, hints[name], f"{where}: {name}") for name, one in table.items()}
    for name in ("videos", "scene"):
        if name in table:
            table[name] = tuple(str(folder / one) for one in table[name])
    table |= {name: folder / table[name] for name in ("file", "boxes") if name in table}
    try:
        return SampleSource(**table)
    except ConfigError as error:
        raise ConfigError(_with_place(str(error), where)) from error


def _words(value: Any, folder: Path, where: str) -> tuple[str, ...]:
    """Words of a list, or the lines of a text file."""
    if isinstance(value, str):
        try:
            return tuple(entry.prompt or "" for entry in read_list(folder / value))
        except InputError as error:
            raise ConfigError(
                f"{where} is {shown(value)}: {error}; give a list of words, or a .txt with one "
                "per line"
            ) from error
    is_list = isinstance(value, Sequence)
    if not is_list or not all(isinstance(one, str | int | float) for one in value):
        raise ConfigError(f"{where} is {shown(value)}; it must be a list of texts")
    return tuple(map(str, value))
