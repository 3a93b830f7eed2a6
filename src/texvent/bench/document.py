"""Result documents: JSON files that state their schema."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError
from texvent.io.atomic import atomic_file


def write_document(path: Path, document: Any, *, overwrite: bool) -> None:
    """Write a result; the file appears when it is complete.

    Args:
        path: the JSON file.
        document: plain values; none is NaN.
        overwrite: whether an existing file is replaced.

    Raises:
        OutputError: the file exists already, or cannot be written.
    """
    with atomic_file(path, overwrite=overwrite) as part:
        text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
        part.write_text(text + "\n", encoding="utf-8")


def read_document(path: Path) -> dict[str, Any]:
    """The values of a result.

    Raises:
        InputError: there is no such file.
        FileFormatError: it holds no JSON object.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise InputError(f"there is no result {path}; write one with texvent bench --out") from None
    except (OSError, ValueError) as error:
        raise FileFormatError(f"{path} is no JSON document ({error})") from error
    if not isinstance(document, dict):
        raise FileFormatError(f"{path} holds {type(document).__name__}, not a JSON object")
    return document
