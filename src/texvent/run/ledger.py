"""Notes in a folder by which work resumes: what it was made of, and a ledger of its results.

The ledger has a line of JSON for every result that is begun, and one when it is complete. A line
names the files of its result with their states, so that files which are gone, cut or of another
run are noticed; it says what the result was made of in the words of its command.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, one_line
from texvent.io.atomic import atomic_file
from texvent.runtime.files.file_names import inside
from texvent.settings.provenance import describe_state, is_unchanged


def read_note(path: Path, *, remedy: str) -> Any:
    """Facts that `write_note` wrote; None where there is no such file.

    Raises:
        FileFormatError: it is damaged; `remedy` says what to do.
    """
    if not path.is_file():
        return None
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)}); {remedy}") from error


def write_note(path: Path, facts: Mapping[str, Any]) -> None:
    """Note plain facts in a file, in place of those that are there."""
    with atomic_file(path, overwrite=True) as part:
        part.write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")


MOST_DIFFERENCES, MAX_VALUE = 3, 40
"""Differences that an error names, and characters of a value."""


def describe_differences(old: Any, new: Any, *, name_of: Callable[[str], str] = str) -> str:
    """Differences between two trees of options, at most three; empty if they are equal.

    `name_of` gives an option's name from that in the tree.
    """
    found = list(_differences(old, new, name_of))
    more = len(found) - MOST_DIFFERENCES
    return "; ".join(found[:MOST_DIFFERENCES]) + (f" and {more} more" if more > 0 else "")


def _differences(
    old: Any, new: Any, name_of: Callable[[str], str], name: str = ""
) -> Iterator[str]:
    """Differences between two trees of options, as `name was this, is that`, leaf by leaf."""
    if isinstance(old, Mapping) or isinstance(new, Mapping):
        before, now = (one if isinstance(one, Mapping) else {} for one in (old, new))
        for key in dict.fromkeys((*before, *now)):
            yield from _differences(before.get(key), now.get(key), name_of, str(key))
    elif old != new:
        yield f"{name_of(name)[:40]} was {_value(old)}, is {_value(new)}"


def _value(value: Any) -> str:
    if value is None:
        return "not set"
    text = ", ".join(map(str, value)) if isinstance(value, list) else str(value)
    return text if len(text) <= MAX_VALUE else f"{text[: MAX_VALUE - 3]}..."


FILES = "files"
"""Name, in a line, of the files of a complete result and their states."""


class Ledger:
    """The results of a folder.

    Raises:
        FileFormatError: a line is damaged.
    """

    def __init__(self, path: Path, *, remedy: str) -> None:
        """Read it, if it is there; `remedy` says what to do about a damaged one."""
        self._path = path
        self._rows = {row["key"]: row for row in _read_rows(path, remedy)}

    def __iter__(self) -> Iterator[str]:
        """The keys of all results, also of those that were begun and not completed."""
        return iter(self._rows)

    def row(self, key: str) -> Mapping[str, Any]:
        """The last line of a result; empty where there is none."""
        return self._rows.get(key, {})

    def is_complete(self, key: str) -> bool:
        """True if all files of a complete result are there, and as they were."""
        files = self.row(key).get(FILES)
        folder = self._path.parent
        return files is not None and all(is_unchanged(folder / n, one) for n, one in files.items())

    def begin(self, keys: Iterable[str]) -> None:
        """Note results that are to be made now; durable before it returns.

        Until they are complete again, what is there of them may be replaced.
        """
        self._rows |= {key: {"key": key} for key in keys}
        self.write()

    def forget(self, keys: Iterable[str]) -> None:
        """Drop results; `write` makes it durable."""
        for key in keys:
            del self._rows[key]

    def write(self) -> None:
        """Write a line for each result anew; one that was cut off by a power failure goes."""
        with atomic_file(self._path, overwrite=True) as part:
            text = "".join(f"{json.dumps(row)}\n" for row in self._rows.values())
            part.write_text(text, encoding="utf-8")

    def add(self, key: str, files: Sequence[Path], **facts: Any) -> None:
        """Note that a result is complete; durable before it returns.

        Args:
            key: of the result.
            files: its files and folders, in the folder of the ledger.
            **facts: plain values to keep with it.
        """
        folder = self._path.parent
        states = {one.relative_to(folder).as_posix(): describe_state(one) for one in files}
        self._rows[key] = {"key": key, **facts, FILES: states}
        with self._path.open("a", encoding="utf-8") as file:
            file.write(f"{json.dumps(self._rows[key])}\n")
            file.flush()
            os.fsync(file.fileno())


def _read_rows(path: Path, remedy: str) -> Iterator[dict[str, Any]]:
    """Complete lines; a last one that was cut off by a power failure is not complete."""
    lines = path.read_bytes().split(b"\n") if path.is_file() else []
    for number, line in enumerate(lines[:-1], start=1):
        try:
            row = json.loads(line)
            for name in row.get(FILES) or ():
                inside(path.parent, name)
            yield {**row, "key": str(row["key"])}
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
            if number < len(lines) - 1:
                raise FileFormatError(f"{path} line {number} is damaged; {remedy}") from None
