"""Result documents: JSON with a schema, the machine it was measured on, and Markdown tables."""

from __future__ import annotations

import dataclasses
import gzip
import json
import math
import os
import platform
import re
import types
import typing
import zlib
from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

from texvent import __version__
from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.extending import source_commit
from texvent.io.atomic import atomic_file
from texvent.metrics.compare import plain_values

DIGITS = 7
"""Significant digits of the numbers in a compressed document: more than any table shows."""
COMPRESSED = ".gz"


def write_document(path: Path, document: Any, *, overwrite: bool) -> None:
    """Write a result; the file appears when it is complete.

    Args:
        path: the JSON file. A name that ends in .gz compresses it, for results to be published:
            numbers are rounded to `DIGITS`, and equal results give equal bytes.
        document: numbers, texts, mappings and sequences; NaN and infinity become null.
        overwrite: whether an existing file is replaced.

    Raises:
        OutputError: the file exists already, or cannot be written.
    """
    if path.suffix == COMPRESSED:
        text = json.dumps(plain_values(document, digits=DIGITS), ensure_ascii=False)
        content = gzip.compress(f"{text}\n".encode(), mtime=0)
    else:
        text = json.dumps(plain_values(document), indent=2, ensure_ascii=False)
        content = f"{text}\n".encode()
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_bytes(content)


def read_document(path: Path) -> dict[str, Any]:
    """The values of a result.

    Raises:
        InputError: there is no such file.
        FileFormatError: it holds no JSON object.
    """
    try:
        content = path.read_bytes()
        document = json.loads(gzip.decompress(content) if path.suffix == COMPRESSED else content)
    except FileNotFoundError:
        raise InputError(f"there is no result {path}; write one with texvent bench --out") from None
    except (OSError, EOFError, zlib.error, ValueError, RecursionError) as error:
        raise FileFormatError(f"{path} is no JSON document ({one_line(error)})") from error
    if not isinstance(document, dict):
        raise FileFormatError(f"{path} holds {type(document).__name__}, not a JSON object")
    return document


def result_name(file_name: str) -> str:
    """Name of a result's file without .json or .json.gz."""
    return Path(file_name.removesuffix(COMPRESSED)).stem


def restore_nan(value: Any) -> Any:
    """Values read from JSON, with NaN for None."""
    if isinstance(value, Mapping):
        return {key: restore_nan(item) for key, item in value.items()}
    if isinstance(value, list):
        return [restore_nan(item) for item in value]
    return math.nan if value is None else value


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


class MarkdownReport(ABC):
    """A report that notebooks show as its tables."""

    @abstractmethod
    def markdown(self) -> str:
        """All tables."""

    def _repr_mimebundle_(
        self, include: Collection[str] | None = None, exclude: Collection[str] | None = None
    ) -> dict[str, str]:
        """What a notebook shows: the tables."""
        return {"text/plain": repr(self), "text/markdown": self.markdown()}


def markdown_table(titles: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table, one line per row of cells, each of one line and without HTML tags."""
    lines = [titles, ["---"] * len(titles), *rows]
    return "".join(f"| {' | '.join(map(_cell, cells))} |\n" for cells in lines)


def without_tags(text: str) -> str:
    """Markdown in which no HTML tag begins; emphasis and links stay.

    Names of recordings and entries come from files that others may have written.

    Example:
        >>> without_tags("a <b>, p < 0.05")
        'a &lt;b>, p < 0.05'
    """
    return re.sub(r"<(?=[A-Za-z/!?])", "&lt;", text)


def _cell(text: str) -> str:
    one_line = " ".join(text.splitlines())
    return re.sub(r"(?<!\\)\|", r"\|", without_tags(one_line))


PACKAGES = ("numpy", "numba", "opencv-python-headless", "h5py", "torch")
"""Packages whose versions may change a figure."""
CPU_FACTS = Path("/proc/cpuinfo")


def describe_environment() -> dict[str, Any]:
    """Facts that a result's document states, ready for JSON.

    Returns:
        `commit` of the source tree, with "+changes" where files differ from it; of an installed
        package, which has none, its version. Then versions and the device.
    """
    return {
        "commit": source_commit() or f"installed {__version__}",
        "texvent_version": __version__,
        "python": platform.python_version(),
        "packages": {name: version for name in PACKAGES if (version := _version(name))},
        "device": f"{_processor()}, {os.cpu_count()} cores",
        "system": f"{platform.system()} {platform.machine()}",
    }


def _version(package: str) -> str | None:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None


def _processor() -> str:
    """Name of the processor; Linux keeps it in a file, other systems in the platform's answer."""
    if CPU_FACTS.is_file():
        for line in CPU_FACTS.read_text(encoding="utf-8").splitlines():
            name, _, value = line.partition(":")
            if name.strip() == "model name":
                return value.strip()
    return platform.processor() or platform.machine()
