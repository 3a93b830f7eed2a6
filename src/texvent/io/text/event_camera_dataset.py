"""Text rows `t x y p` (seconds, pixels, 0/1): the Event Camera Dataset's events.txt.

The rows hold neither the sensor size nor how the events were made, so texvent writes both into
`NAME.txt.json` beside the text, and reads the size from there. Any other file needs the size
from the caller; it is never guessed from the largest coordinate.


Times are written with exactly six decimals: whole µs, read back unchanged.

Source: Mueggler et al., The Event-Camera Dataset and Simulator, IJRR 2017.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import ClassVar

from texvent.io.block_codec import BlockCodec, FileContents, write_records
from texvent.io.block_writer import FileTarget, WriteBlock
from texvent.io.limits import FormatLimits
from texvent.io.metadata import read_sidecar
from texvent.io.protocol import Columns
from texvent.io.text.rows import (
    STOP_US,
    make_rows,
    parse_rows,
    read_text_blocks,
    warn_of_wrong_unit,
)


class EcdCodec(BlockCodec):
    """Event Camera Dataset text."""

    name: ClassVar[str] = "ecd"
    extensions: ClassVar[tuple[str, ...]] = (".txt",)
    limits: ClassVar[FormatLimits] = FormatLimits("ECD text", 1 << 16, STOP_US)
    has_sidecar: ClassVar[bool] = True

    def inspect(self, path: Path) -> FileContents:
        """Size and metadata lie beside the file."""
        size, metadata = read_sidecar(path)
        return FileContents(size, metadata, partial(_read, path))

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Rows begin at once."""
        return write_records(part, b"", make_rows)


def _read(path: Path) -> Iterator[Columns]:
    return warn_of_wrong_unit(_read_blocks(path), path)


def _read_blocks(path: Path) -> Iterator[Columns]:
    with path.open("rb") as file:
        for block in read_text_blocks(file):
            yield parse_rows(block, path)
