"""DAT files of Prophesee: one record of 8 bytes per event, little-endian.

    header   lines `% Height 720`, `% Version 2`, `% Width 1280`, then the bytes 12 (or 0) and 8
    record   u32 t (µs) · u32: 13..0 x · 27..14 y · 31..28 polarity

Coordinates below 16384, times below 2^32 µs (71.6 min); files whose counter wrapped are read.
Files of version 1, with other bit fields, are refused.

Source: Prophesee, "DAT File Format".
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.event_packets import EventPackets
from texvent.io.columns import existing_file, stored_or_given_size
from texvent.io.limits import FormatLimits
from texvent.io.prophesee.text_header import TextHeader, make_text_header, read_text_header
from texvent.io.prophesee.word_coding import Columns, WordPackets, WordWriter
from texvent.sensor import SensorSize

EVENT_TYPES = (0x0C, 0x00)
"""Type byte of contrast events, now and in older files."""
EVENT_BYTES = 8
VERSION = "2"
PLACE_BITS = 14
PLACE_MASK = (1 << PLACE_BITS) - 1
TURN_US = 1 << 32


class DatCodec:
    """DAT files."""

    name: ClassVar[str] = "dat"
    extensions: ClassVar[tuple[str, ...]] = (".dat",)
    limits: ClassVar[FormatLimits] = FormatLimits("DAT", 1 << PLACE_BITS, TURN_US)

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of a file, block by block.

        Raises:
            InputError: no such file, or it stores no sensor size and none is given.
            FileFormatError: the file is damaged or of another format.
        """
        path = existing_file(path)
        header = _read_header(path)
        metadata = header.metadata(path)
        final_size = stored_or_given_size(path, header.stored_size(path), size)
        packets = WordPackets(
            path,
            start=header.length + 2,
            decoder=DatDecoder,
            size=final_size,
            metadata=metadata,
        )
        return EventPackets(packets, final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> WordWriter:
        """Start a file; see `EventCodec.open_writer`."""
        fields = {"Height": str(size.height), "Version": VERSION, "Width": str(size.width)}
        return WordWriter(
            path,
            header=make_text_header(fields, metadata, end=False),
            encoder=DatEncoder,
            limits=self.limits,
            size=size,
            overwrite=overwrite,
        )


class DatEncoder:
    """Makes records of events."""

    def start(self) -> bytes:
        """Type and length of the records."""
        return bytes((EVENT_TYPES[0], EVENT_BYTES))

    def encode(self, columns: Columns) -> memoryview:
        """Records of the events in columns x, y, t, p."""
        records = np.empty((len(columns["t"]), 2), dtype="<u4")
        records[:, 0] = columns["t"]
        place = columns["y"].astype(np.uint32) << PLACE_BITS | columns["x"]
        records[:, 1] = columns["p"].astype(np.uint32) << 2 * PLACE_BITS | place
        return records.data.cast("B")


class DatDecoder:
    """Makes events of records; it adds a turn where the 32 bits of the time wrap."""

    def __init__(self) -> None:
        self.word = np.dtype("<u8")
        self._last_us = 0

    def decode(self, words: NDArray[Any]) -> Columns:
        """Columns x, y, t, p of the events in these records."""
        records = words.view("<u4").reshape(-1, 2)
        place = records[:, 1]
        return {
            "x": (place & PLACE_MASK).astype(np.uint16),
            "y": (place >> PLACE_BITS & PLACE_MASK).astype(np.uint16),
            "t": self._unwrap(records[:, 0].astype(np.int64)),
            "p": (place >> 2 * PLACE_BITS).astype(np.uint8),
        }

    def _unwrap(self, times: NDArray[np.int64]) -> NDArray[np.int64]:
        """Times without the falls of more than half a turn."""
        turns, last = divmod(self._last_us, TURN_US)
        falls = times[:-1] - times[1:] > TURN_US // 2
        if last - int(times[0]) > TURN_US // 2:
            turns += 1
        times += turns * TURN_US
        if falls.any():
            times[1:] += np.cumsum(falls) * TURN_US
        self._last_us = int(times[-1])
        return times


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
