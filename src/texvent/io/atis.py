"""ATIS recordings: Event Stream (.es) version 2, and the .bin of N-MNIST and N-Caltech101.

Event Stream, type 1 (change detection), 5 bytes per event, little-endian; it is only read:

    file     `Event Stream` · version 2 0 0 · type 1 · u16 width · u16 height
    event    u8: time since the event before (0..126 µs) << 1 | p · u16 x · u16 y, from the bottom
    0xFF     127 µs pass · 0xFE  reset, read over

Rows count from the bottom, as faery and the format's cameras have it; programs that do not flip
them show the image upside down.

.bin or .bs2, 5 bytes per event:

    byte 0  x · byte 1  y · bytes 2..4  p << 23 | t (µs, 23 bits), big-endian
    y = 240 is no event: from here on 8192 µs are added to all times; so is a turn of the 23 bits

So x is below 256, y below 240, and texvent writes times below 2^23 µs (8.39 s); the additions
are read, not written, because readers disagree about them. The bytes hold no sensor size and
no metadata: texvent writes both beside the file, in `NAME.bin.json`. For files of others the size
is asked for (N-MNIST 34x34; N-Caltech101 240x180).

Source: Neuromorphic Vision, Event Stream specification, version 2.0; Orchard et al., Converting
Static Image Datasets to Spiking Neuromorphic Datasets, 2015.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.errors import FileFormatError, InputError
from texvent.io.block_codec import BlockCodec, BlockReader, FileContents, write_records
from texvent.io.block_writer import UNLIMITED, Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.byte_blocks import read_bytes, read_records
from texvent.io.clocks import TurningClock
from texvent.io.input_checks import begins_with
from texvent.io.metadata import read_sidecar
from texvent.io.reading import ReadOptions
from texvent.sensor import SensorSize

EVENT_BYTES = 5
MAX_SIZE = SensorSize(256, 240)
OVERFLOW_Y = 240
OVERFLOW_US = 8192
STOP_US = 1 << 23


class NMnistCodec(BlockCodec):
    """N-Caltech101 and N-MNIST files."""

    name: ClassVar[str] = "atis"
    extensions: ClassVar[tuple[str, ...]] = (".bin", ".bs2")
    limits: ClassVar[FormatLimits] = FormatLimits("ATIS .bin", MAX_SIZE.width, STOP_US)
    has_sidecar: ClassVar[bool] = True

    def check_target(self, target: FileTarget) -> None:
        """Refuse a sensor that is too high."""
        if target.size.height > MAX_SIZE.height:
            raise InputError(
                f"cannot write {target.path}: ATIS .bin holds sensors up to {MAX_SIZE}, not "
                f"{target.size}; {UNLIMITED} hold it"
            )

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata are in a sidecar file."""
        size, metadata = read_sidecar(path)
        return FileContents(size, metadata, partial(_read_blocks, path))

    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Records begin at once."""
        return write_records(part, b"", _encode)


def _encode(columns: Columns) -> bytes:
    t = columns["t"].astype(np.uint32)
    records = np.empty((len(t), EVENT_BYTES), dtype=np.uint8)
    records[:, 0] = columns["x"]
    records[:, 1] = columns["y"]
    records[:, 2] = columns["p"] << 7 | (t >> 16).astype(np.uint8)
    records[:, 3] = (t >> 8).astype(np.uint8)
    records[:, 4] = t.astype(np.uint8)
    return records.tobytes()


def _read_blocks(path: Path) -> Iterator[Columns]:
    added_us = 0
    clock = TurningClock(STOP_US.bit_length() - 1)
    for block in read_records(path, 0, EVENT_BYTES):
        records = np.frombuffer(block, dtype=np.uint8).reshape(-1, EVENT_BYTES)
        stored = (
            (records[:, 2] & 127).astype(np.int64) << 16
            | records[:, 3].astype(np.int64) << 8
            | records[:, 4]
        )
        t = clock.unroll(stored) + added_us
        columns: dict[str, Any] = {"x": records[:, 0], "y": records[:, 1], "p": records[:, 2] >> 7}
        is_overflow = records[:, 1] == OVERFLOW_Y
        if is_overflow.any():
            count = np.cumsum(is_overflow)
            added_us += OVERFLOW_US * int(count[-1])
            t += OVERFLOW_US * count
            columns = {name: column[~is_overflow] for name, column in columns.items()}
            t = t[~is_overflow]
        yield {**columns, "t": t}


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
    from texvent.io.event_stream2_cpu import decode_events  # brings Numba

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
