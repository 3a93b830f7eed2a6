"""AEDAT3.1 of cAER: a text header, then packets of events, little-endian; DVS128Gesture's.

    packet   i16 type 1 · i16 source · i32 event size 8 · i32 time offset 4 · i32 time turns ·
             i32 capacity · i32 events · i32 valid events
    event    u32: 31..17 x · 16..2 y · 1 polarity · 0 valid · u32 time, µs, 31 bits

The time counter turns after 2^31 µs; `time turns` of the packet counts this, so long recordings are
whole. The sensor's size follows from the camera named in `#Source 1: DVS128` (or from
`#Size: WIDTHxHEIGHT`), or is asked for. Special events and IMU samples are side data; frames and
events marked invalid are skipped.

    special  u32: 7..1 type · 0 valid · u32 time
    IMU      u32: 0 valid · u32 time · f32 acceleration x, y, z, g · f32 rotation, °/s · f32 °C

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
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown, warn
from texvent.io.aedat.header import AedatHeader, read_aedat_header
from texvent.io.block_codec import BlockReader, FileContents
from texvent.io.block_writer import Columns, SideData
from texvent.io.byte_blocks import read_whole
from texvent.io.clocks import TurningClock
from texvent.io.input_checks import begins_with
from texvent.io.reading import ReadOptions
from texvent.sensor import SENSORS

AEDAT3_MAGIC = "#!AER-DAT3.1"
AEDAT3_END = "#!END-HEADER"
PLAIN = "RAW"
"""Format of packets that are not compressed."""

EVENT = np.dtype([("place", "<u4"), ("t", "<u4")])
SPECIAL_TYPE, POLARITY_TYPE, IMU_TYPE = 0, 1, 3
FIRST_SIGNAL, LAST_SIGNAL = 2, 4
"""Types of special events that are an external signal: rising, falling edge, pulse."""
PACKETS = {
    SPECIAL_TYPE: EVENT,
    POLARITY_TYPE: EVENT,
    IMU_TYPE: np.dtype([("place", "<u4"), ("t", "<u4"), ("values", "<f4", 7)]),
}
"""Type of a packet → its events; `place` holds the mark of validity."""
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

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """The header states size and metadata."""
        header = read_aedat_header(path, [AEDAT3_MAGIC], AEDAT3_END)
        if header.lines[-1] != AEDAT3_END:
            raise FileFormatError(f"{path}: its header does not end with {AEDAT3_END}")
        stored = header.value("Format") or PLAIN
        if stored != PLAIN:
            raise FileFormatError(f"{path} is AEDAT3.1 of the format {shown(stored)}, not {PLAIN}")
        size, metadata = _stored_size(path, header), header.metadata(path)
        blocks = partial(_read_events, path, header.length, repairs=options.repair)
        return FileContents(size, metadata, blocks)

    def side_data(self, path: Path) -> SideData:
        """External signals and IMU samples."""
        start = read_aedat_header(path, [AEDAT3_MAGIC], AEDAT3_END).length
        return {
            "triggers": partial(_read_special, path, start),
            "imu": partial(_read_imu, path, start),
        }


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


def _read_packets(
    path: Path, start: int, kind: int, *, repairs: bool = True
) -> Iterator[tuple[NDArray[np.void], NDArray[np.int64]]]:
    """The events of each packet of a type, and their times."""
    dtype, clock = PACKETS[kind], _PacketClock(path, repairs=repairs)
    sources: set[int] = set()
    with path.open("rb") as file:
        left = os.fstat(file.fileno()).st_size - start
        file.seek(start)
        while left > 0:
            head = _read_head(file, path, left)
            found, source, event_bytes, time_offset, turns, _, count, _ = head
            left -= _HEAD.size + event_bytes * count
            if found != kind:
                file.seek(event_bytes * count, os.SEEK_CUR)
                continue
            if (event_bytes, time_offset) != (dtype.itemsize, 4) or turns < 0:
                raise FileFormatError(
                    f"{path} holds a packet of events of {event_bytes} bytes, not "
                    f"{dtype.itemsize}; it is damaged"
                )
            sources |= {source} if kind == POLARITY_TYPE else set()
            if len(sources) > 1:
                raise FileFormatError(
                    f"{path} holds events of several cameras (sources {sorted(sources)}), which "
                    "texvent does not tell apart"
                )
            events = np.frombuffer(read_whole(path, file, event_bytes * count), dtype=dtype)
            events = events[(events["place"] & 1) == 1]
            stored = events["t"].astype(np.int64) & TIME_MASK
            yield events, clock.unroll(stored, turns)


class _PacketClock:
    """Times of consecutive packets: 31 bits, and the turns that heads of packets count.

    Args:
        path: the file, for messages.
        repairs: the turns that heads count are left out where they cannot be.
    """

    def __init__(self, path: Path, *, repairs: bool) -> None:
        self._path, self._repairs = path, repairs
        self._clock = TurningClock(TIME_BITS)
        self._last: tuple[int, int] | None = None
        self._counted_us, self._is_wrong = 0, False

    def unroll(self, stored: NDArray[np.int64], turns: int) -> NDArray[np.int64]:
        """Times of the events of the next packet, µs.

        Raises:
            FileFormatError: the count of turns changes where the time only goes on.
        """
        times = self._clock.unroll(stored)
        if not len(stored):
            return times
        before, self._last = self._last, (turns, int(stored[-1]))
        if before is not None and turns != before[0] and stored[0] >= before[1]:
            change = f"count of turns goes from {before[0]} to {turns} where the time goes on"
            if not self._repairs:
                raise FileFormatError(f"{self._path}: its {change}, {before[1]} to {stored[0]} µs")
            if not self._is_wrong:
                warn(f"{self._path}: its {change}; from there on the times alone say the turns")
            self._is_wrong = True
        if not self._is_wrong:  # not every program counts the turns
            self._counted_us = max(0, int(stored[-1] - times[-1]) + (turns << TIME_BITS))
        return times + self._counted_us


def _read_events(path: Path, start: int, *, repairs: bool) -> Iterator[Columns]:
    for events, times in _read_packets(path, start, POLARITY_TYPE, repairs=repairs):
        place = events["place"]
        yield {
            "x": (place >> 17).astype(np.uint16),
            "y": (place >> 2 & 0x7FFF).astype(np.uint16),
            "t": times,
            "p": (place >> 1 & 1).astype(np.uint8),
        }


def _read_special(path: Path, start: int) -> Iterator[Columns]:
    for events, times in _read_packets(path, start, SPECIAL_TYPE):
        kinds = events["place"] >> 1 & 127
        is_signal = (kinds >= FIRST_SIGNAL) & (kinds <= LAST_SIGNAL)
        yield {"t": times[is_signal], "type": kinds[is_signal]}


def _read_imu(path: Path, start: int) -> Iterator[Columns]:
    for samples, times in _read_packets(path, start, IMU_TYPE):
        yield {
            "t": times,
            "temperature_c": samples["values"][:, 6],
            **{f"acceleration_{axis}_g": samples["values"][:, at] for at, axis in enumerate("xyz")},
            **{
                f"rotation_{axis}_deg_s": samples["values"][:, 3 + at]
                for at, axis in enumerate("xyz")
            },
        }


def _read_head(file: BinaryIO, path: Path, left: int) -> tuple[int, ...]:
    """The numbers at the beginning of a packet that fits into the `left` bytes."""
    if left < _HEAD.size:
        raise FileFormatError(f"{path} ends inside a packet; the file was cut off")
    data = read_whole(path, file, _HEAD.size)
    head: tuple[int, ...] = _HEAD.unpack(data)
    _, _, event_bytes, _, _, capacity, count, _ = head
    if event_bytes <= 0 or not 0 <= count <= min(capacity, MAX_EVENTS):
        raise FileFormatError(
            f"{path} holds a packet of {count} events of {event_bytes} bytes; it is damaged"
        )
    if event_bytes * count > left - _HEAD.size:
        raise FileFormatError(f"{path} ends inside a packet; the file was cut off")
    return head
