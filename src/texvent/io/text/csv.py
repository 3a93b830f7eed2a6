"""CSV: a header line `t,x,y,p`, then one event per line, times in whole µs, polarity 0/1.

Read too: columns in any order, under the names other programs give them (timestamp, polarity …);
and without a header line in the order x, y, p, t of Metavision's converter. Text holds neither
size nor metadata: texvent writes both beside the file, in `NAME.csv.json`.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import ClassVar

import numpy as np

from texvent.errors import FileFormatError, shown
from texvent.io.block_codec import BlockCodec, FileContents, write_records
from texvent.io.block_writer import FileTarget, WriteBlock
from texvent.io.limits import FormatLimits
from texvent.io.metadata import read_sidecar
from texvent.io.protocol import Columns
from texvent.io.text.rows import parse_table, read_text_blocks, whole_numbers

HEADER = b"t,x,y,p\n"
HEADLESS = ("x", "y", "p", "t")
NAMES = {
    **{name: "t" for name in ("t", "ts", "timestamp", "time", "t_us", "timestamp_us")},
    **{name: "p" for name in ("p", "pol", "polarity")},
    "x": "x",
    "y": "y",
}
"""Names of columns, in lower case."""
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
        """Size and metadata lie beside the file; its first line names the columns."""
        size, metadata = read_sidecar(path)
        order, start = _read_header(path)
        return FileContents(size, metadata, partial(_read_blocks, path, order, start))

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Write the line that names the columns."""
        return write_records(part, HEADER, _encode)


def _encode(columns: Columns) -> bytes:
    lists = [columns[name].tolist() for name in "txyp"]
    return "".join(f"{t},{x},{y},{p}\n" for t, x, y, p in zip(*lists, strict=True)).encode()


def _read_header(path: Path) -> tuple[tuple[str, ...], int]:
    """Order of the columns, and where the first row begins."""
    with path.open("rb") as file:
        line = file.readline(MAX_HEADER)
    words = [word.strip().strip('"').lower() for word in line.decode("latin-1").split(",")]
    if words[0][:1].isdecimal() or words == [""]:
        return HEADLESS, 0
    order = tuple(NAMES.get(word, "") for word in words)
    missing = [name for name in "txyp" if order.count(name) != 1]
    if missing:
        first = ", ".join(words)
        raise FileFormatError(
            f"{path} has no column {shown(missing[0])} (its first line: {shown(first)}); "
            "texvent reads CSV with columns t, x, y, p, or without a header line in the order "
            "x, y, p, t"
        )
    return order, len(line)


def _read_blocks(path: Path, order: tuple[str, ...], start: int) -> Iterator[Columns]:
    with path.open("rb") as file:
        file.seek(start)
        for block in read_text_blocks(file):
            table = parse_table(block, path, delimiter=",")
            if table.size == 0:
                continue
            if table.shape[1] != len(order):
                raise FileFormatError(
                    f"{path} has rows of {table.shape[1]} values, and {len(order)} columns"
                )
            t = table[:, order.index("t")]
            if not (np.abs(t) < STOP_US).all() or (t != np.rint(t)).any():
                raise FileFormatError(f"{path} holds times that are not whole µs")
            pixels = [table[:, order.index(name)] for name in "xyp"]
            whole = whole_numbers(np.stack(pixels, axis=1), path)
            yield {"t": t.astype(np.int64), "x": whole[:, 0], "y": whole[:, 1], "p": whole[:, 2]}
