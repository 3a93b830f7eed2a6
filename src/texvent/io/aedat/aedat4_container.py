"""The container of AEDAT4, whatever its streams hold: header, packets, their compression.

    file     `#!AER-DAT4.0` CR LF · table IOHE · packets · table FTAB (list of packets)
    packet   i32 stream · i32 bytes · one table, compressed

Events (`aedat4`) and frames (`texvent.capture.aedat4_frames`) are read through it. The list of
packets is not needed: a file whose recording stopped before it was written (position -1) is read
to its end.

Packets are stored plain, as LZ4 frames or as Zstandard frames (in Python from 3.14 on; before, the
extra `zstd`). A packet that unpacks to more than 256 MiB is refused.

Source: iniVation, AEDAT 4.0 file format.
"""

from __future__ import annotations

import bz2
import os
import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import lz4.frame

from texvent.errors import FileFormatError, one_line
from texvent.io.aedat.aedat4_tables import UNKNOWN, StreamInfo, Table, read_info
from texvent.io.compressed import load_zstd

MAX_PACKET_BYTES = 256 * 2**20
"""16 million events, or a frame of 80 megapixels."""


LZ4_NAME, LZ4_CODE = "LZ4", 1
"""Name in the XML, and code in the header, of LZ4."""


def _unpacker(code: int) -> Callable[[bytes], bytes]:
    """Decompressor of the packets of a file whose header names this compression.

    Raises:
        FileFormatError: no packing has this number.
        MissingDependencyError: Zstandard is needed and not installed.
    """
    if code == 0:
        return bytes
    if code in (1, 2):
        return unpack_lz4
    if code in (3, 4):
        load_zstd()
        return unpack_zstd
    raise FileFormatError(f"its header names compression {code}; AEDAT4 knows 0 to 4")


def pack_lz4(data: bytes) -> bytes:
    """A packet as a LZ4 frame with a checksum."""
    packed: bytes = lz4.frame.compress(data, content_checksum=True)
    return packed


def unpack_lz4(data: bytes) -> bytes:
    """A packet of a LZ4 frame.

    Raises:
        FileFormatError: it is damaged, cut off or too large.
    """
    return _unpack(lz4.frame.LZ4FrameDecompressor(), data, RuntimeError, "LZ4")


def unpack_zstd(data: bytes) -> bytes:
    """A packet of a Zstandard frame.

    Raises:
        FileFormatError: it is damaged, cut off or too large.
        MissingDependencyError: Zstandard is not installed.
    """
    zstd = load_zstd()
    return _unpack(zstd.ZstdDecompressor(), data, zstd.ZstdError, "Zstandard")


def unpack_bz2(data: bytes) -> bytes:
    """Bytes unpacked from bzip2.

    Raises:
        FileFormatError: it is damaged, cut off or too large.
    """
    return _unpack(bz2.BZ2Decompressor(), data, OSError, "bzip2")


def _unpack(decompressor: Any, data: bytes, failure: type[Exception], name: str) -> bytes:
    # In steps: with one large limit, LZ4 sets the whole of it aside for every packet.
    step = max(65_536, 4 * len(data))
    parts: list[bytes] = []
    total = 0
    try:
        while not decompressor.eof and total < MAX_PACKET_BYTES:
            part = decompressor.decompress(b"" if parts else data, max_length=step)
            if parts and not part:
                break
            parts.append(part)
            total += len(part)
    except (failure, EOFError, MemoryError) as error:
        raise FileFormatError(f"a packet is damaged ({name}: {one_line(error)})") from error
    if not decompressor.eof or total > MAX_PACKET_BYTES:
        what = "is cut off"
        if total >= MAX_PACKET_BYTES:
            what = f"unpacks to more than {MAX_PACKET_BYTES // 2**20} MiB"
        raise FileFormatError(f"a packet {what} ({name})")
    return parts[0] if len(parts) == 1 else b"".join(parts)


EVENTS, FRAMES = "EVTS", "FRME"
"""Types of streams."""
MAGIC = b"#!AER-DAT4.0\r\n"
PACKET_HEAD = struct.Struct("<ii")
"""Stream and bytes of a packet."""


@dataclass(frozen=True)
class Container:
    """An AEDAT4 file whose header has been read."""

    path: Path
    unpack: Callable[[bytes], bytes]
    start: int
    """First byte of the first packet."""
    stop: int | None
    """First byte of the list of packets; None: there is no list."""
    streams: tuple[StreamInfo, ...]
    length: int
    """Bytes of the file when its header was read."""

    def streams_of(self, identifier: str) -> list[StreamInfo]:
        """The streams of a type, such as EVTS."""
        return [one for one in self.streams if one.identifier == identifier]

    def count_packets(self, stream: StreamInfo) -> int:
        """Number of packets of a stream; only their heads are read.

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
                    packet = self.unpack(file.read(count))
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


def open_container(path: Path, *, is_whole: bool = True) -> Container:
    """Read the header of a file; `is_whole` refuses one cut off before its list of packets.

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
        unpack = _unpacker(table.number(0, "<i", 0))
        stop = table.number(1, "<q", UNKNOWN)
        xml = table.text(2)
    except FileFormatError as error:
        raise FileFormatError(f"{path}: {error}") from error
    if not is_whole and stop >= length:
        stop = UNKNOWN
    if stop != UNKNOWN and not start <= stop < length:
        raise FileFormatError(
            f"{path} states its list of packets at byte {stop} of {length}; the file was cut off"
        )
    streams = tuple(read_info(path, xml))
    return Container(path, unpack, start, None if stop == UNKNOWN else stop, streams, length)


def stored_size(path: Path, stream: StreamInfo) -> tuple[int, int] | None:
    """Width and height that a stream states, pixels; None if it states none.

    Raises:
        FileFormatError: the stated value is no number.
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
