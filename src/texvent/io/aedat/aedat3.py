"""AEDAT3.1, cAER's format: text lines, then packets of events, little-endian. DVS128Gesture's.

    packet   i16 type 1 · i16 source · i32 event size 8 · i32 time offset 4 · i32 time turns ·
             i32 capacity · i32 events · i32 valid events
    event    u32: 31..17 x · 16..2 y · 1 polarity · 0 valid · u32 time, µs, 31 bits

Coordinates below 32768. The time counter turns after 2^31 µs; `time turns` of the packet counts
this, so long recordings are whole. The sensor's size follows from the camera named in
`#Source 1: DVS128` (or from `#Size: WIDTHxHEIGHT`), or is asked for. Packets of other types
(frames, IMU samples, triggers) and events marked invalid are skipped.

Source: iniVation, AEDAT 3.1 file format.
"""

from __future__ import annotations

import os
import re
import struct
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import BinaryIO, ClassVar

import numpy as np

from texvent.errors import FileFormatError
from texvent.io.aedat.header import (
    AEDAT3_END,
    AEDAT3_MAGIC,
    AedatHeader,
    read_aedat_header,
)
from texvent.io.block_codec import BlockReader, FileContents
from texvent.io.input_checks import begins_with
from texvent.io.protocol import Columns
from texvent.sensor import SENSORS

EVENT = np.dtype([("place", "<u4"), ("t", "<u4")])
POLARITY_TYPE = 1
TIME_BITS = 31
TIME_MASK = (1 << TIME_BITS) - 1
MAX_EVENTS = 1 << 24
"""More events than this in a packet are damage: cAER's packets hold thousands."""
CAMERAS = {"DVS128": "dvs128", "DAVIS240C": "davis240c", "DAVIS346": "davis346"}
"""Names of cameras in `#Source` lines → sensors."""
_HEAD = struct.Struct("<2h6i")


class Aedat3Codec(BlockReader):
    """AEDAT3.1."""

    name: ClassVar[str] = "aedat3"
    extensions: ClassVar[tuple[str, ...]] = (".aedat",)

    def recognises(self, path: Path) -> bool:
        """True if the file begins as AEDAT3.1 does."""
        return begins_with(path, AEDAT3_MAGIC.encode())

    def inspect(self, path: Path) -> FileContents:
        """The header states size and metadata."""
        header = read_aedat_header(path, AEDAT3_MAGIC, AEDAT3_END)
        if header.lines[-1] != AEDAT3_END:
            raise FileFormatError(f"{path}: its header does not end with {AEDAT3_END}")
        size, metadata = _stored_size(path, header), header.metadata(path)
        return FileContents(size, metadata, partial(_read_blocks, path, header.length))


def _stored_size(path: Path, header: AedatHeader) -> tuple[int, int] | None:
    text = header.value("Size")
    if text is not None:
        match = re.fullmatch(r"(\d{1,9})x(\d{1,9})", text)
        if match is None:
            raise FileFormatError(f"{path}: its header states a size of {text[:40]!r}")
        return int(match[1]), int(match[2])
    sensor = CAMERAS.get((header.value("Source 1") or "").upper())
    if sensor is None:
        return None
    size = SENSORS[sensor].size
    return size.width, size.height


def _read_blocks(path: Path, start: int) -> Iterator[Columns]:
    with path.open("rb") as file:
        left = os.fstat(file.fileno()).st_size - start
        file.seek(start)
        while left > 0:
            head = _read_head(file, path, left)
            kind, _, event_bytes, time_offset, turns, _, count, _ = head
            left -= _HEAD.size + event_bytes * count
            if kind != POLARITY_TYPE:
                file.seek(event_bytes * count, os.SEEK_CUR)
                continue
            if (event_bytes, time_offset) != (EVENT.itemsize, 4) or turns < 0:
                raise FileFormatError(
                    f"{path} holds a packet of events of {event_bytes} bytes, not 8; it is damaged"
                )
            events = np.frombuffer(file.read(event_bytes * count), dtype=EVENT)
            events = events[(events["place"] & 1) == 1]
            place = events["place"]
            yield {
                "x": (place >> 17).astype(np.uint16),
                "y": (place >> 2 & 0x7FFF).astype(np.uint16),
                "t": (events["t"].astype(np.int64) & TIME_MASK) + (turns << TIME_BITS),
                "p": (place >> 1 & 1).astype(np.uint8),
            }


def _read_head(file: BinaryIO, path: Path, left: int) -> tuple[int, ...]:
    """The numbers at the beginning of a packet that fits into the `left` bytes."""
    data = file.read(_HEAD.size)
    if len(data) < _HEAD.size:
        raise FileFormatError(f"{path} ends inside a packet; the file was cut off")
    head: tuple[int, ...] = _HEAD.unpack(data)
    _, _, event_bytes, _, _, capacity, count, _ = head
    if event_bytes <= 0 or not 0 <= count <= min(capacity, MAX_EVENTS):
        raise FileFormatError(
            f"{path} holds a packet of {count} events of {event_bytes} bytes; it is damaged"
        )
    if event_bytes * count > left - _HEAD.size:
        raise FileFormatError(f"{path} ends inside a packet; the file was cut off")
    return head
