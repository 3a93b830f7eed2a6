"""The container of AEDAT4, whatever its streams hold: header, packets, their compression.

    file     `#!AER-DAT4.0` CR LF · table IOHE · packets · table FTAB (list of packets)
    packet   i32 stream · i32 bytes · one table, compressed

Events (`aedat4`) and frames (`texvent.capture.aedat4_frames`) are read through it. The list of
packets is not needed: a file whose recording stopped before it was written (position -1) is read
to its end.

Source: iniVation, AEDAT 4.0 file format.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from texvent.errors import FileFormatError, one_line
from texvent.io.aedat.aedat4_packing import Packing, packing_of
from texvent.io.aedat.aedat4_tables import UNKNOWN, StreamInfo, read_info
from texvent.io.aedat.flatbuffer import Table

MAGIC = b"#!AER-DAT4.0\r\n"
PACKET_HEAD = struct.Struct("<ii")
"""Stream and bytes of a packet."""


@dataclass(frozen=True)
class Container:
    """An AEDAT4 file whose header has been read."""

    path: Path
    packing: Packing
    start: int
    """First byte of the first packet."""
    stop: int | None
    """First byte of the list of packets; None: there is no list."""
    streams: tuple[StreamInfo, ...]
    length: int
    """Bytes of the file when its header was read."""

    def find_stream(self, identifier: str) -> StreamInfo | None:
        """The first stream of a type, such as EVTS; None if there is none."""
        return next((one for one in self.streams if one.identifier == identifier), None)

    def count_packets(self, stream: StreamInfo) -> int:
        """How many packets a stream has; only their heads are read.

        Raises:
            FileFormatError: the file was cut off.
        """
        with self.path.open("rb") as file:
            return sum(1 for _ in self._seek_packets(file, stream))

    def read_packets(self, stream: StreamInfo) -> Iterator[tuple[int, bytes]]:
        """The packets of a stream, uncompressed, each with the byte after it.

        Raises:
            FileFormatError: the file was cut off, or a packet is damaged.
        """
        with self.path.open("rb") as file:
            for count, end in self._seek_packets(file, stream):
                try:
                    packet = self.packing.unpack(file.read(count))
                except FileFormatError as error:
                    raise FileFormatError(f"{self.path}, before byte {end}: {error}") from error
                yield end, packet

    def _seek_packets(self, file: BinaryIO, stream: StreamInfo) -> Iterator[tuple[int, int]]:
        """Go to each packet of a stream; its length and the byte after it."""
        stop = self.length if self.stop is None else self.stop
        position = self.start
        while position < stop:
            self._check_length(file)
            file.seek(position)
            number, count = _read_head(file, self.path, stop - position)
            position += PACKET_HEAD.size + count
            if number == stream.number:
                yield count, position
        self._check_length(file)

    def _check_length(self, file: BinaryIO) -> None:
        if os.fstat(file.fileno()).st_size < self.length:
            raise FileFormatError(f"{self.path} became shorter while it was read; read it again")


def open_container(path: Path) -> Container:
    """Read the header of a file.

    Raises:
        FileFormatError: the file is damaged or of another format.
        MissingDependencyError: it is compressed with Zstandard, which is not installed.
    """
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
    streams = tuple(read_info(path, xml))
    return Container(path, packing, start, None if stop == UNKNOWN else stop, streams, length)


def stored_size(path: Path, stream: StreamInfo) -> tuple[int, int] | None:
    """Width and height that a stream states, pixels; None if it states none.

    Raises:
        FileFormatError: what it states is no number.
    """
    try:
        return int(stream.attributes["sizeX"]), int(stream.attributes["sizeY"])
    except KeyError:
        return None
    except ValueError as error:
        raise FileFormatError(
            f"{path}: its header states no sensor size ({one_line(error)})"
        ) from error


def _read_head(file: BinaryIO, path: Path, room: int) -> tuple[int, int]:
    """Stream and length of the packet that begins here, if it fits into `room` bytes."""
    head = file.read(PACKET_HEAD.size)
    if len(head) < PACKET_HEAD.size or room < PACKET_HEAD.size:
        raise FileFormatError(f"{path} ends inside a packet; the file was cut off")
    stream, count = PACKET_HEAD.unpack(head)
    if not 0 <= count <= room - PACKET_HEAD.size:
        raise FileFormatError(
            f"{path} ends inside a packet: it states {count} bytes, "
            f"{room - PACKET_HEAD.size} are left"
        )
    return stream, count
