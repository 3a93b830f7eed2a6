"""CSV: a header line `t,x,y,p`, then one event per line, times in whole µs, polarity 0/1.

Read too: columns in any order, under the names other programs give them (timestamp, polarity …);
and without a header line in the order x, y, p, t of Metavision's converter. Text holds neither
size nor metadata: texvent writes both beside the file, in `NAME.csv.json`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown
from texvent.io.arrays.npz import find_columns
from texvent.io.block_codec import BlockCodec, FileContents, write_records
from texvent.io.block_writer import FileTarget, FormatLimits, WriteBlock
from texvent.io.metadata import read_sidecar
from texvent.io.protocol import Columns
from texvent.io.text.event_camera_dataset import parse_table, read_text_blocks, whole_numbers

HEADER = b"t,x,y,p\n"
HEADLESS = ("x", "y", "p", "t")
STOP_US = 1 << 53
"""Up to here float64, which the parser uses, keeps every µs (285 years)."""
MAX_HEADER = 4096


class CsvCodec(BlockCodec):
    """Comma-separated text."""

    name: ClassVar[str] = "csv"
    extensions: ClassVar[tuple[str, ...]] = (".csv",)
    limits: ClassVar[FormatLimits] = FormatLimits("CSV", 1 << 16, STOP_US)
    has_sidecar: ClassVar[bool] = True

    def inspect(self, path: Path) -> FileContents:
        """Size and metadata are in a sidecar file; its first line names the columns."""
        size, metadata = read_sidecar(path)
        columns = _read_header(path)
        return FileContents(size, metadata, partial(_read_blocks, path, columns))

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Write the line that names the columns."""
        return write_records(part, HEADER, _encode)


def _encode(columns: Columns) -> bytes:
    lists = [columns[name].tolist() for name in "txyp"]
    return "".join(f"{t},{x},{y},{p}\n" for t, x, y, p in zip(*lists, strict=True)).encode()


@dataclass(frozen=True)
class _Table:
    """Where the columns are, and where the first row begins."""

    names: tuple[str, ...]
    """Column names of the file, in their order."""
    places: Mapping[str, int]
    """t, x, y, p → number of the column."""
    start: int
    has_header: bool

    @property
    def rows(self) -> str:
        """Expected form of a row, for messages."""
        return f"rows of numbers `{','.join(self.names)[:60]}`, polarity 0/1 or -1/+1"


def _read_header(path: Path) -> _Table:
    """The columns that the first line names, or those of a file without such a line."""
    with path.open("rb") as file:
        line = file.readline(MAX_HEADER)
    words = [word.strip().strip('"').lower() for word in line.decode("latin-1").split(",")]
    if words[0][:1].isdecimal() or words == [""]:
        return _Table(HEADLESS, {name: HEADLESS.index(name) for name in "txyp"}, 0, False)
    found = find_columns(path, words)
    places = {name: words.index(found[name]) for name in "txyp"}
    return _Table(tuple(words), places, len(line), True)


def _read_blocks(path: Path, columns: _Table) -> Iterator[Columns]:
    with path.open("rb") as file:
        file.seek(columns.start)
        for block in read_text_blocks(file):
            table = parse_table(block, path, delimiter=",", rows=columns.rows)
            if table.size == 0:
                continue
            if table.shape[1] != len(columns.names):
                raise FileFormatError(
                    f"{path} has rows of {table.shape[1]} values, and {len(columns.names)} columns"
                )
            values = {name: table[:, place] for name, place in columns.places.items()}
            _check_values(path, columns, values)
            whole = whole_numbers(np.stack([values[name] for name in "xyp"], axis=1), path)
            t = values["t"].astype(np.int64)
            yield {"t": t, "x": whole[:, 0], "y": whole[:, 1], "p": whole[:, 2]}


def _check_values(path: Path, columns: _Table, values: Mapping[str, NDArray[np.float64]]) -> None:
    """Refuse columns in another order or unit.

    Raises:
        FileFormatError: see above; the message says which are expected.
    """
    t, p = values["t"], values["p"]
    wrong = p[~np.isin(p, (-1, 0, 1))]
    if wrong.size and not columns.has_header:
        raise FileFormatError(
            f"{path} does not name its columns, so they are x, y, p, t; but the third, polarity, "
            f"holds {wrong[0]:g}: put a first line with their names, such as t,x,y,p"
        )
    fractions = t[~((np.abs(t) < STOP_US) & (t == np.rint(t)))]
    if fractions.size:
        raise FileFormatError(
            f"{path} holds times that are not whole µs, such as {shown(fractions[0])} in column "
            f"{shown(columns.names[columns.places['t']])}; times in CSV are whole µs, not seconds "
            "or ms: multiply and round them first"
        )
