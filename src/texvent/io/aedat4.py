"""AEDAT4, the format of iniVation's DV software: packets of events, LZ4-compressed by default.

    file     `#!AER-DAT4.0` CR LF · table IOHE · packets · table FTAB (list of packets)
    packet   i32 stream · i32 bytes · table EVTS, compressed

Coordinates are i2: sensors up to 32768 pixels a side. Times are i8 µs. Packets hold 10 ms, as
DV's do, so that its player can seek. How the events were made lies in the XML of the header, as
attribute `texvent`. The first stream of events is read; frames, IMU samples and triggers beside
it are read over. The list of packets is not needed for reading: a file whose recording stopped
before the list was written (position -1) is read too.

Source: iniVation, AEDAT 4.0 file format; tables in `aedat4_tables`.
"""

from __future__ import annotations

import itertools
import os
import struct
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, ClassVar

import numpy as np

from texvent.errors import FileFormatError
from texvent.events import EventPackets
from texvent.io.aedat4_packing import LZ4, NONE, ZSTD, Packing, packing_of
from texvent.io.aedat4_tables import (
    UNKNOWN,
    PacketEntry,
    StreamInfo,
    make_events,
    make_header,
    make_info,
    make_list,
    read_events,
    read_info,
)
from texvent.io.block_stream import BlockPackets, BlockWriter, Columns, FileTarget
from texvent.io.columns import (
    existing_file,
    metadata_from_json,
    metadata_to_json,
    stored_or_given_size,
)
from texvent.io.flatbuffer import Table
from texvent.io.limits import FormatLimits
from texvent.io.magic import begins_with
from texvent.sensor import SensorSize

MAGIC = b"#!AER-DAT4.0\r\n"
PACKET_US = 10_000
"""Time per packet, µs."""
EVENTS = "EVTS"
_HEAD = struct.Struct("<ii")


class Aedat4Codec:
    """AEDAT4 with LZ4."""

    name: ClassVar[str] = "aedat4"
    extensions: ClassVar[tuple[str, ...]] = (".aedat4",)
    packing: ClassVar[Packing] = LZ4
    limits: ClassVar[FormatLimits] = FormatLimits("AEDAT4", 1 << 15, 1 << 63)

    def recognises(self, path: Path) -> bool:
        """True if the file begins as AEDAT4 does."""
        return begins_with(path, MAGIC)

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of a file, packet by packet.

        Raises:
            InputError: no such file, or it stores no sensor size and none is given.
            FileFormatError: the file is damaged, of another format or without events.
            MissingDependencyError: it is compressed with Zstandard, which is not installed.
        """
        path = existing_file(path)
        header = _read_header(path)
        attributes = header.stream.attributes
        final_size = stored_or_given_size(path, _stored_size(path, attributes), size)
        metadata: dict[str, Any] = {}
        if "texvent" in attributes:
            metadata = metadata_from_json(path, attributes["texvent"])
        elif attributes.get("source"):
            metadata = {"source": attributes["source"]}
        blocks = partial(_read_blocks, path, header)
        return EventPackets(BlockPackets(path, blocks, final_size, metadata), final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> BlockWriter:
        """Start a file; see `EventCodec.open_writer`."""
        packing_of(self.packing.code)
        xml = make_info(size, self.packing.name, metadata_to_json(metadata))
        target = FileTarget(path, size, metadata, overwrite)
        start = partial(Aedat4Sink, packing=self.packing, xml=xml)
        return BlockWriter(target, start, limits=self.limits)


class Aedat4NoneCodec(Aedat4Codec):
    """AEDAT4 without compression: quick to write, 16 bytes per event."""

    name: ClassVar[str] = "aedat4-none"
    extensions: ClassVar[tuple[str, ...]] = ()
    packing: ClassVar[Packing] = NONE


class Aedat4ZstdCodec(Aedat4Codec):
    """AEDAT4 with Zstandard: smaller than LZ4."""

    name: ClassVar[str] = "aedat4-zstd"
    extensions: ClassVar[tuple[str, ...]] = ()
    packing: ClassVar[Packing] = ZSTD


class Aedat4Sink:
    """Writes packets of 10 ms, and their list at the end."""

    def __init__(self, part: Path, stack: ExitStack, *, packing: Packing, xml: bytes) -> None:
        self._file = stack.enter_context(part.open("wb"))
        self._packing = packing
        self._xml = xml
        self._entries: list[PacketEntry] = []
        self._file.write(MAGIC + make_header(packing.code, UNKNOWN, xml))

    def write(self, columns: Columns) -> None:
        """Add events."""
        windows = columns["t"] // PACKET_US
        cuts = np.flatnonzero(windows[1:] != windows[:-1]) + 1
        bounds = [0, *cuts.tolist(), len(windows)]
        for start, stop in itertools.pairwise(bounds):
            self._write_packet({name: columns[name][start:stop] for name in "xytp"})

    def finish(self) -> None:
        """Write the list of packets, and where it lies into the header."""
        position = self._file.tell()
        self._file.write(self._packing.pack(make_list(self._entries, 0)))
        self._file.seek(len(MAGIC))
        self._file.write(make_header(self._packing.code, position, self._xml))

    def _write_packet(self, columns: Columns) -> None:
        data = self._packing.pack(make_events(columns))
        self._file.write(_HEAD.pack(0, len(data)))
        times = columns["t"]
        self._entries.append(
            PacketEntry(self._file.tell(), len(data), len(times), int(times[0]), int(times[-1]))
        )
        self._file.write(data)


@dataclass(frozen=True)
class _Header:
    packing: Packing
    start: int
    """First byte of the first packet."""
    stop: int | None
    """First byte of the list of packets; None: there is no list."""
    stream: StreamInfo
    """The first stream of events."""


def _read_header(path: Path) -> _Header:
    length = os.path.getsize(path)
    with path.open("rb") as file:
        if file.read(len(MAGIC)) != MAGIC:
            raise FileFormatError(f"{path} is not AEDAT4: it does not begin with #!AER-DAT4.0")
        prefix = file.read(4)
        start = len(MAGIC) + 4 + int.from_bytes(prefix, "little")
        if len(prefix) < 4 or start > length:
            raise FileFormatError(f"{path} ends inside its header; the file was cut off")
        data = prefix + file.read(start - len(MAGIC) - 4)
    try:
        table = Table.root(data, b"IOHE")
        packing = packing_of(table.number(0, "<i", 0))
        stop = table.number(1, "<q", UNKNOWN)
        xml = table.text(2)
    except FileFormatError as error:
        raise FileFormatError(f"{path}: {error}") from error
    if stop != UNKNOWN and not start <= stop < length:
        raise FileFormatError(
            f"{path} states its list of packets at byte {stop} of {length}; the file was cut off"
        )
    streams = [one for one in read_info(path, xml) if one.identifier == EVENTS]
    if not streams:
        raise FileFormatError(f"{path} holds no stream of events")
    return _Header(packing, start, None if stop == UNKNOWN else stop, streams[0])


def _stored_size(path: Path, attributes: Mapping[str, str]) -> tuple[int, int] | None:
    try:
        return int(attributes["sizeX"]), int(attributes["sizeY"])
    except KeyError:
        return None
    except ValueError as error:
        raise FileFormatError(f"{path}: its header states no sensor size ({error})") from error


def _read_blocks(path: Path, header: _Header) -> Iterator[Columns]:
    with path.open("rb") as file:
        stop = os.fstat(file.fileno()).st_size if header.stop is None else header.stop
        position = header.start
        while position < stop:
            file.seek(position)
            stream, count = _read_head(file, path, stop - position)
            position += _HEAD.size + count
            if stream != header.stream.number:
                continue
            try:
                events = read_events(header.packing.unpack(file.read(count)))
            except FileFormatError as error:
                raise FileFormatError(f"{path}, before byte {position}: {error}") from error
            # int16 as uint16: a negative coordinate becomes one outside every sensor.
            yield {
                "x": events["x"].astype(np.uint16),
                "y": events["y"].astype(np.uint16),
                "t": events["t"].astype(np.int64),
                "p": events["p"],
            }


def _read_head(file: BinaryIO, path: Path, room: int) -> tuple[int, int]:
    """Stream and length of the packet that begins here, if it fits into `room` bytes."""
    head = file.read(_HEAD.size)
    if len(head) < _HEAD.size or room < _HEAD.size:
        raise FileFormatError(f"{path} ends inside a packet; the file was cut off")
    stream, count = _HEAD.unpack(head)
    if not 0 <= count <= room - _HEAD.size:
        raise FileFormatError(
            f"{path} ends inside a packet: it states {count} bytes, {room - _HEAD.size} are left"
        )
    return stream, count
