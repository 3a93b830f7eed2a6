"""Files of prompts: one per line, CSV, or JSON lines."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError

PROMPT_COLUMNS = ("prompt", "text", "caption")
"""Names under which a column or key holds the prompt; the first that is there counts."""
EXTENSIONS = (".txt", ".csv", ".jsonl")


@dataclass(frozen=True)
class PromptLine:
    """One prompt of a file."""

    prompt: str
    line: int
    """Where it stands in the file, from 1."""
    name: str | None = None
    """Name for its results, without extension; None lets the caller make one."""
    seed: int | None = None
    """Seed of its own; None means the run's."""


def read_prompts(path: Path) -> tuple[PromptLine, ...]:
    """All prompts of a file.

    Args:
        path: `.txt`, one prompt per line, empty lines skipped; `.csv` with a column `prompt` (or
            `text`, `caption`) and perhaps `name` and `seed`; `.jsonl`, on each line a text or an
            object with those keys.

    Raises:
        InputError: there is no such file, or it holds no prompt.
        FileFormatError: a line cannot be read; the message names it.
    """
    readers = {".txt": _read_text, ".csv": _read_csv, ".jsonl": _read_jsonl}
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise InputError(f"{path} is no file of prompts; its name must end in .txt, .csv or .jsonl")
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise InputError(f"cannot read prompts from {path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise FileFormatError(f"{path} is not UTF-8 text: {error.reason}") from error
    prompts = tuple(reader(path, text))
    if not prompts:
        raise InputError(f"{path} holds no prompt")
    return prompts


def _read_text(path: Path, text: str) -> Iterator[PromptLine]:
    del path
    for number, line in enumerate(text.splitlines(), start=1):
        if line.strip():
            yield PromptLine(line.strip(), number)


def _read_csv(path: Path, text: str) -> Iterator[PromptLine]:
    reader = csv.DictReader(io.StringIO(text), strict=True)
    columns = tuple(reader.fieldnames or ())
    if not set(columns) & set(PROMPT_COLUMNS):
        raise FileFormatError(
            f"{path} has no column {' or '.join(PROMPT_COLUMNS)}; it has: {', '.join(columns)}"
        )
    try:
        for row in reader:
            yield _from_mapping(path, reader.line_num, row)
    except csv.Error as error:
        raise FileFormatError(f"{path} after line {reader.line_num}: {error}") from error


def _read_jsonl(path: Path, text: str) -> Iterator[PromptLine]:
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip():
            continue
        try:
            entry = json.loads(line)
        except ValueError as error:
            raise FileFormatError(f"{path} line {number} is not JSON: {error}") from error
        if isinstance(entry, str):
            entry = {"prompt": entry}
        if not isinstance(entry, Mapping):
            raise FileFormatError(f"{path} line {number} is neither a text nor an object")
        yield _from_mapping(path, number, entry)


def _from_mapping(path: Path, number: int, entry: Mapping[str, Any]) -> PromptLine:
    prompt = next((entry[name] for name in PROMPT_COLUMNS if entry.get(name)), None)
    if not isinstance(prompt, str) or not prompt.strip():
        raise FileFormatError(f"{path} line {number} has no {' or '.join(PROMPT_COLUMNS)}")
    name = entry.get("name") or None
    if name is not None and ("/" in str(name) or str(name).startswith(".")):
        raise FileFormatError(f"{path} line {number}: {name!r} is no name for a file")
    return PromptLine(
        prompt.strip(), number, str(name) if name else None, _seed(path, number, entry.get("seed"))
    )


def _seed(path: Path, number: int, value: Any) -> int | None:
    if value is None or value == "":
        return None
    try:
        seed = int(value)
    except (TypeError, ValueError):
        seed = -1
    if isinstance(value, (bool, float)) or seed < 0:
        raise FileFormatError(
            f"{path} line {number}: seed is {value!r}; it must be a whole number from 0"
        )
    return seed
