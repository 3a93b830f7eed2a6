"""Result documents: JSON files that state their schema, compressed where the name ends in .gz."""

from __future__ import annotations

import gzip
import json
import math
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError, one_line
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
