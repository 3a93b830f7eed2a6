"""Parquet, which is read: columns in any order under the names that CSV files have.

Times without a unit are judged as those of arrays. The schema's metadata may hold width, height and
texvent (all metadata as JSON). Needs pyarrow: the extra `parquet`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import FileFormatError
from texvent.io.block_codec import BlockReader, FileContents
from texvent.io.block_writer import Columns
from texvent.io.input_checks import begins_with, reporting_damage
from texvent.io.metadata import metadata_from_json
from texvent.io.reading import ReadOptions, TimeUnit
from texvent.io.tables import ColumnValues, find_columns, spelled

PACKET_EVENTS = 2**18
EXTRA = "parquet"


class ParquetCodec(BlockReader):
    """Apache Parquet tables."""

    name: ClassVar[str] = "parquet"
    extensions: ClassVar[tuple[str, ...]] = (".parquet",)
    takes: ClassVar[tuple[str, ...]] = ("time_unit", "columns")

    def recognises(self, path: Path) -> bool:
        """True if the file begins as Parquet does."""
        return begins_with(path, b"PAR1")

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """The schema states size and metadata."""
        with _open_table(path) as table:
            order = options.names or find_columns(path, table.schema_arrow.names)
            facts = table.schema_arrow.metadata or {}
        size = None
        try:
            if b"width" in facts and b"height" in facts:
                size = int(facts[b"width"]), int(facts[b"height"])
        except ValueError as error:
            raise FileFormatError(f"{path}: its schema states no sensor size") from error
        metadata: dict[str, Any] = {}
        if b"texvent" in facts:
            metadata = metadata_from_json(path, facts[b"texvent"])
        return FileContents(
            size, metadata, partial(_read_blocks, path, order, options, "us" if metadata else None)
        )


@contextmanager
def _open_table(path: Path) -> Iterator[Any]:
    """The file; damage found inside the block becomes a FileFormatError."""
    arrow = require("pyarrow", extra=EXTRA)
    parquet = require("pyarrow.parquet", extra=EXTRA)
    damage = (arrow.ArrowException, OSError, ValueError, KeyError, MemoryError)
    with (
        reporting_damage(path, "a Parquet file", damage),
        parquet.ParquetFile(path, page_checksum_verification=True) as table,
    ):
        yield table


def _read_blocks(
    path: Path, order: Mapping[str, str], options: ReadOptions, own: TimeUnit | None
) -> Iterator[Columns]:
    """Events in the order of the file; `own`: unit of files that texvent wrote."""
    with _open_table(path) as table:
        samples = {name: _ends(table, order[name]) for name in "tp"}
        count, unit = table.metadata.num_rows, spelled(order["t"])[1] or own
        values = ColumnValues(path, count, samples, unit, options)
        for batch in table.iter_batches(PACKET_EVENTS, columns=list(order.values())):
            stored = {
                name: batch[column].to_numpy(zero_copy_only=False) for name, column in order.items()
            }
            yield values.columns(stored)


def _ends(table: Any, column: str) -> NDArray[Any]:
    """Values of the first, middle and last group of rows."""
    last = table.num_row_groups - 1
    groups = sorted({0, max(last // 2, 0), max(last, 0)})
    parts = table.read_row_groups(groups if last >= 0 else [], columns=[column])
    found: NDArray[Any] = parts[column].to_numpy()
    return found
