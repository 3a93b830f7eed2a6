"""CSV: a header line `t,x,y,p`, then one event per line, times in whole µs, polarity 0/1.

Read too: columns in any order, under the names other programs give them (timestamp, polarity …);
and without a header line in the order x, y, p, t of Metavision's converter. Text holds neither
size nor metadata: texvent writes both beside the file, in `NAME.csv.json`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.errors import FileFormatError
from texvent.event_packets import EventPackets
from texvent.io.block_stream import (
    BlockPackets,
    BlockWriter,
    Columns,
    FileTarget,
    RecordSink,
)
from texvent.io.columns import existing_file, stored_or_given_size
from texvent.io.limits import FormatLimits
from texvent.io.sidecar import read_sidecar
from texvent.io.text.rows import parse_table, read_text_blocks, whole_numbers
from texvent.sensor import SensorSize

HEADER = "t,x,y,p\n"
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


class CsvCodec:
    """Comma-separated text."""

    name: ClassVar[str] = "csv"
    extensions: ClassVar[tuple[str, ...]] = (".csv",)
    limits: ClassVar[FormatLimits] = FormatLimits("CSV", 1 << 16, STOP_US)

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of a file, block by block.

        Raises:
            InputError: no such file, or no size is given and none lies beside it.
            FileFormatError: a column is missing, or a row is not whole numbers.
        """
        path = existing_file(path)
        stored, metadata = read_sidecar(path)
        final_size = stored_or_given_size(path, stored, size)
        order, start = _read_header(path)
        blocks = partial(_read_blocks, path, order, start)
        return EventPackets(BlockPackets(path, blocks, final_size, metadata), final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> BlockWriter:
        """Start a file; see `EventCodec.open_writer`."""
        target = FileTarget(path, size, metadata, overwrite)
        return BlockWriter(target, _start, limits=self.limits, sidecar=True)


def _start(part: Path, stack: ExitStack) -> RecordSink:
    file = stack.enter_context(part.open("wb"))
    file.write(HEADER.encode())
    return RecordSink(file, _encode)


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
        shown = ", ".join(words)[:80]
        raise FileFormatError(
            f"{path} has no column {missing[0]!r} (its first line: {shown!r}); texvent reads CSV "
            "with columns t, x, y, p, or without a header line in the order x, y, p, t"
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
