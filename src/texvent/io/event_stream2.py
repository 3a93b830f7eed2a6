"""Event Stream (.es) version 2 of ATIS and other cameras; it is only read.

Type 1 (change detection), 5 bytes per event, little-endian:

    file     `Event Stream` · version 2 0 0 · type 1 · u16 width · u16 height
    event    u8: time since the event before (0..126 µs) << 1 | p · u16 x · u16 y, from the bottom
    0xFF     127 µs pass · 0xFE  reset, read over

Rows count from the bottom, as faery and the format's cameras have it; programs that do not flip
them show the image upside down.

Source: Neuromorphic Vision, Event Stream specification, version 2.0.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import ClassVar

import numpy as np

from texvent.errors import FileFormatError
from texvent.io.block_codec import BlockReader, FileContents
from texvent.io.block_writer import Columns
from texvent.io.byte_blocks import read_bytes
from texvent.io.input_checks import begins_with
from texvent.io.metadata import read_sidecar
from texvent.io.reading import ReadOptions

EVENT_BYTES = 5
MAGIC = b"Event Stream"
VERSION = b"\x02\x00\x00"
TYPE = 1
TYPES = {0: "generic", 1: "dvs", 2: "atis", 3: "asynchronous", 4: "color"}
HEADER_BYTES = len(MAGIC) + len(VERSION) + 1 + 4


class EventStream2Codec(BlockReader):
    """Event Stream files of change-detection events."""

    name: ClassVar[str] = "es"
    extensions: ClassVar[tuple[str, ...]] = (".es",)

    def recognises(self, path: Path) -> bool:
        """True if the file begins as Event Stream files do."""
        return begins_with(path, MAGIC)

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """The header states the size; metadata is in a sidecar file."""
        width, height = _read_size(path)
        _, metadata = read_sidecar(path)
        return FileContents((width, height), metadata, partial(_read_stream, path, height - 1))


def _read_size(path: Path) -> tuple[int, int]:
    with path.open("rb") as file:
        header = file.read(HEADER_BYTES)
    if not header.startswith(MAGIC):
        raise FileFormatError(
            f"{path} is not an Event Stream: it does not begin with {MAGIC.decode()!r}"
        )
    if len(header) < HEADER_BYTES - 4:
        raise FileFormatError(f"{path} ends inside its header; the file was cut off")
    version, kind = header[12:15], header[15]
    if version[0] != VERSION[0]:
        raise FileFormatError(f"{path} is Event Stream version {version[0]}; texvent reads 2")
    if kind != TYPE:
        raise FileFormatError(
            f"{path} holds Event Stream events of type {kind} ({TYPES.get(kind, 'unknown')}); "
            "texvent reads type 1 (dvs)"
        )
    if len(header) < HEADER_BYTES:
        raise FileFormatError(f"{path} ends inside its header; the file was cut off")
    return int.from_bytes(header[16:18], "little"), int.from_bytes(header[18:20], "little")


def _read_stream(path: Path, top: int) -> Iterator[Columns]:
    from texvent.io.event_stream2_coding import decode_events  # brings Numba

    rest = b""
    now = 0
    for block in read_bytes(path, HEADER_BYTES):
        data = np.frombuffer(rest + block, dtype=np.uint8)
        room = len(data) // EVENT_BYTES
        x, p = np.empty(room, dtype=np.uint16), np.empty(room, dtype=np.uint8)
        y, t = np.empty(room, dtype=np.int64), np.empty(room, dtype=np.int64)
        count, used, now = decode_events(data, (now, top), (x, y, t, p))
        rest = data[used:].tobytes()
        yield {"x": x[:count], "y": y[:count], "t": t[:count], "p": p[:count]}
    if rest:
        raise FileFormatError(f"{path} ends inside an event; the file was cut off")
