"""Result documents: JSON with a schema, the machine it was measured on, and Markdown tables."""

from __future__ import annotations

import dataclasses
import gzip
import json
import math
import os
import platform
import re
import zlib
from collections.abc import Iterable, Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any, TypeVar

from texvent import __version__
from texvent.errors import FileFormatError, InputError, one_line
from texvent.extending import source_commit
from texvent.io.atomic import atomic_file
from texvent.metrics.compare import plain_values

DIGITS = 7
"""Significant digits of the numbers in a compressed document: more than any table shows."""
COMPRESSED = ".gz"
Record = TypeVar("Record", bound=Any)


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


def read_records(kind: type[Record], values: Sequence[Mapping[str, Any]]) -> list[Record]:
    """Dataclasses from their fields in a document, where null stands for NaN.

    Args:
        kind: the dataclass; null stays None in a field that may be None.
        values: an object each; other names in it are left out.

    Raises:
        KeyError, TypeError, AttributeError: the document has another layout.
    """
    return [
        kind(
            **{
                field.name: one[field.name] if "None" in str(field.type) else _nan(one[field.name])
                for field in dataclasses.fields(kind)
            }
        )
        for one in values
    ]


def _nan(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _nan(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_nan(item) for item in value]
    return math.nan if value is None else value


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


def options_as_code(text: str) -> str:
    """Markdown whose options are in code font, in which no typesetter makes a dash of two hyphens.

    Example:
        >>> options_as_code("give --table 4, or `texvent --help`")
        'give `--table` 4, or `texvent --help`'
    """
    found = re.compile(r"`[^`]*`|(?<![\w-])--[a-z][\w-]*")
    return found.sub(lambda one: one[0] if one[0].startswith("`") else f"`{one[0]}`", text)


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
