"""Parquet: columns t int64 (µs), x uint16, y uint16, p uint8, compressed with zstd.

The schema's metadata holds width, height and texvent (all metadata as JSON). Read too: columns in
any order under the names that CSV files have. Needs pyarrow: the extra `parquet`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent._require import require
from texvent.errors import FileFormatError
from texvent.io.block_codec import BlockCodec, FileContents
from texvent.io.block_writer import FileTarget, FormatLimits, WriteBlock
from texvent.io.input_checks import begins_with, reporting_damage
from texvent.io.metadata import metadata_from_json, metadata_to_json
from texvent.io.protocol import Columns
from texvent.io.reading import ReadOptions, TimeUnit, to_microseconds
from texvent.io.tables import find_columns, spelled

TYPES = {"t": "int64", "x": "uint16", "y": "uint16", "p": "uint8"}
PACKET_EVENTS = 2**18
EXTRA = "parquet"


class ParquetCodec(BlockCodec):
    """Apache Parquet tables."""

    name: ClassVar[str] = "parquet"
    extensions: ClassVar[tuple[str, ...]] = (".parquet",)
    takes: ClassVar[tuple[str, ...]] = ("time_unit", "columns")
    limits: ClassVar[FormatLimits] = FormatLimits("Parquet", 1 << 16, 1 << 63)

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
        return FileContents(size, metadata, partial(_read_blocks, path, order, options.time_unit))

    def check_target(self, target: FileTarget) -> None:
        """Refuse to start without pyarrow."""
        require("pyarrow.parquet", extra=EXTRA)

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Open a table with size and metadata in its schema."""
        arrow = require("pyarrow", extra=EXTRA)
        parquet = require("pyarrow.parquet", extra=EXTRA)
        schema = arrow.schema(
            [(name, getattr(arrow, kind)()) for name, kind in TYPES.items()],
            metadata={
                "width": str(target.size.width),
                "height": str(target.size.height),
                "texvent": metadata_to_json(target.metadata),
            },
        )
        with parquet.ParquetWriter(part, schema, compression="zstd") as file:

            def write(columns: Columns) -> None:
                arrays = [arrow.array(np.asarray(columns[name])) for name in TYPES]
                file.write_table(arrow.Table.from_arrays(arrays, schema=schema))

            yield write


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
    path: Path, order: Mapping[str, str], time_unit: TimeUnit | None
) -> Iterator[Columns]:
    unit = time_unit or spelled(order["t"])[1] or "us"
    with _open_table(path) as table:
        for batch in table.iter_batches(PACKET_EVENTS, columns=list(order.values())):
            columns = {
                name: batch.column(column).to_numpy(zero_copy_only=False)
                for name, column in order.items()
            }
            yield {**columns, "t": to_microseconds(path, columns["t"], unit)}
