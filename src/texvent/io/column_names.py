"""How programs call the columns of events: in CSV, Parquet and NumPy archives."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from texvent.errors import FileFormatError, shown

SPELLINGS = {
    "t": ("t", "ts", "timestamp", "timestamps", "time", "times", "t_us", "timestamp_us"),
    "x": ("x", "xs"),
    "y": ("y", "ys"),
    "p": ("p", "ps", "pol", "polarity", "polarities"),
}
"""Column → its names, in lower case."""


def find_columns(path: Path, names: Iterable[str], *, kind: str = "column") -> dict[str, str]:
    """t, x, y, p → the name that a file gives each.

    Args:
        path: the file, for messages.
        names: all names in the file, with capitals or without.
        kind: what the names are of, such as "array".

    Raises:
        FileFormatError: a column is missing or there twice; the message says what is accepted.
    """
    names, found = list(names), {}
    for column, spellings in SPELLINGS.items():
        matching = [name for name in names if name.lower() in spellings]
        if len(matching) != 1:
            what = f"{len(matching)} {kind}s" if matching else f"no {kind}"
            others = " or ".join(spellings[1:4])
            raise FileFormatError(
                f"{path} has {what} {column!r} (it has: {shown(', '.join(names) or 'none')}); "
                f"texvent reads {kind}s t, x, y, p; {column} may be called {others}"
            )
        found[column] = matching[0]
    return found
