"""DAT files of Prophesee: one record of 8 bytes per event, little-endian.

    header   lines `% Height 720`, `% Version 2`, `% Width 1280`, then the bytes 12 (or 0) and 8
    record   u32 t (µs) · u32: 13..0 x · 27..14 y · 31..28 polarity

Coordinates below 16384, times below 2^32 µs (71.6 min); files whose counter wrapped are read.
Files of version 1, with other bit fields, are refused.

Source: Prophesee, "DAT File Format".
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import ClassVar

import numpy as np

from texvent.errors import FileFormatError
from texvent.io.block_codec import BlockCodec, FileContents, write_records
from texvent.io.block_writer import Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.byte_blocks import read_records
from texvent.io.clocks import BITS_OF_32, TurningClock
from texvent.io.prophesee.text_header import TextHeader, make_text_header, read_text_header
from texvent.io.reading import ReadOptions

EVENT_TYPES = (0x0C, 0x00)
"""Type byte of contrast events, now and in older files."""
EVENT_BYTES = 8
VERSION = "2"
PIXEL_BITS = 14
PIXEL_MASK = (1 << PIXEL_BITS) - 1
TURN_US = 1 << 32


class DatCodec(BlockCodec):
    """DAT files."""

    name: ClassVar[str] = "dat"
    extensions: ClassVar[tuple[str, ...]] = (".dat",)
    limits: ClassVar[FormatLimits] = FormatLimits("DAT", 1 << PIXEL_BITS, TURN_US)

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """The header states size and metadata."""
        header = _read_header(path)
        size, metadata = header.stored_size(path), header.metadata(path)
        return FileContents(size, metadata, partial(_read_blocks, path, header.length + 2))

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Write the header, and type and length of the records."""
        width, height = target.size
        fields = {"Height": str(height), "Version": VERSION, "Width": str(width)}
        header = make_text_header(fields, target.metadata, end=False)
        return write_records(part, header + bytes((EVENT_TYPES[0], EVENT_BYTES)), _encode)


def _encode(columns: Columns) -> memoryview:
    records = np.empty((len(columns["t"]), 2), dtype="<u4")
    records[:, 0] = columns["t"]
    pixel = columns["y"].astype(np.uint32) << PIXEL_BITS | columns["x"]
    records[:, 1] = columns["p"].astype(np.uint32) << 2 * PIXEL_BITS | pixel
    return records.data.cast("B")


def _read_blocks(path: Path, start: int) -> Iterator[Columns]:
    clock = TurningClock(*BITS_OF_32)
    for block in read_records(path, start, EVENT_BYTES):
        records = np.frombuffer(block, dtype="<u4").reshape(-1, 2)
        pixel = records[:, 1]
        yield {
            "x": (pixel & PIXEL_MASK).astype(np.uint16),
            "y": (pixel >> PIXEL_BITS & PIXEL_MASK).astype(np.uint16),
            "t": clock.unroll(records[:, 0]),
            "p": (pixel >> 2 * PIXEL_BITS).astype(np.uint8),
        }


def _read_header(path: Path) -> TextHeader:
    """The header, if two bytes that announce contrast events follow it."""
    with path.open("rb") as file:
        header = read_text_header(file, path)
        kind = file.read(2)
    if len(kind) < 2:
        raise FileFormatError(f"{path} ends inside its header; the file was cut off")
    if not header.fields:
        raise FileFormatError(f"{path} is not a DAT file: it has no header of `% key value` lines")
    version = header.fields.get("Version", VERSION)
    if version != VERSION:
        raise FileFormatError(f"{path} is DAT version {version[:20]!r}; texvent reads version 2")
    if kind[0] not in EVENT_TYPES or kind[1] != EVENT_BYTES:
        raise FileFormatError(
            f"{path} holds DAT events of type {kind[0]} with {kind[1]} bytes; texvent reads "
            "contrast events: type 12 or 0 with 8 bytes"
        )
    return header
