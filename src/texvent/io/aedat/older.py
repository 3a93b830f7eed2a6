"""AEDAT2 (jAER) and AEDAT3.1 (cAER): text lines that start with `#`, then binary records.

Nothing but the first byte of a line says whether it still is text. AEDAT3.1 closes its header by a
line of its own, jAER closes AEDAT2 by `#End Of ASCII Header`.

AEDAT2, 8 bytes per event, big-endian, W x H the sensor:

    record       u32 address · u32 time, µs
    davis        (H-1 - y)<<22 | (W-1 - x)<<12 | p<<11      jAER and v2e; bit 31 or 10: no event
    jaer-dvs128  (127 - y)<<8 | (127 - x)<<1 | (1 - p)      jAER; bit 31 or 15: no event
    dvs128       x<<8 | y<<1 | p                            tonic
    cifar10-dvs  (127 - x)<<8 | (127 - y)<<1 | (1 - p)      SpikingJelly

The layout of the address depends on the camera and the tool; x and y count from the top left here,
y from the bottom in jAER. A header line `# AEChip: ...` names the camera; of any other file the
sensor is asked for, because a wrong one gives wrong events without any error. Recordings of a
DVS128 as tonic and SpikingJelly read them have a format of their own.

AEDAT3.1, packets of events, little-endian; DVS128Gesture's:

    packet   i16 type 1 · i16 source · i32 event size 8 · i32 time offset 4 · i32 time turns ·
             i32 capacity · i32 events · i32 valid events
    event    u32: 31..17 x · 16..2 y · 1 polarity · 0 valid · u32 time, µs, 31 bits

The time counter turns after 2^31 µs; `time turns` of the packet counts this, so long recordings are
whole. The sensor's size follows from the camera named in `#Source 1: DVS128` (or from
`#Size: WIDTHxHEIGHT`), or is asked for. Special events and IMU samples are side data; frames and
events marked invalid are skipped.

    special  u32: 7..1 type · 0 valid · u32 time
    IMU      u32: 0 valid · u32 time · f32 acceleration x, y, z, g · f32 rotation, °/s · f32 °C

Sources: iniVation, AEDAT 2.0 and 3.1 file formats; jAER, DVS128.Extractor (flips x and the
polarity); the readers named above (formats are facts).
"""

from __future__ import annotations

import os
import re
import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError
from texvent.io.block_codec import BlockReader, FileContents, read_records
from texvent.io.block_writer import Columns, SideData
from texvent.io.input_checks import begins_with
from texvent.io.metadata import MAX_HEADER_BYTES, metadata_from_json
from texvent.io.reading import ReadOptions
from texvent.sensor import SENSORS, SensorSize

AEDAT2_MAGIC = "#!AER-DAT2.0"
AEDAT3_MAGIC = "#!AER-DAT3.1"
AEDAT2_END = "#End Of ASCII Header"
AEDAT3_END = "#!END-HEADER"
METADATA = "# texvent "


@dataclass(frozen=True)
class AedatHeader:
    """The lines before the records."""

    lines: tuple[str, ...]
    """Without their line ends."""
    length: int
    """Bytes up to the first record."""

    def metadata(self, path: Path) -> dict[str, Any]:
        """Provenance of the events, or the header of another program.

        Raises:
            FileFormatError: the line of texvent is damaged.
        """
        for line in self.lines:
            if line.startswith(METADATA):
                return metadata_from_json(path, line.removeprefix(METADATA))
        return {"header": list(self.lines[1:])} if len(self.lines) > 1 else {}

    def value(self, key: str) -> str | None:
        """Value of the line `#key: ` or `# key: `, if there is one."""
        for line in self.lines:
            name, colon, value = line.removeprefix("#").partition(":")
            if colon and name.strip() == key:
                return value.strip()
        return None


def read_aedat_header(path: Path, magic: str, end: str) -> AedatHeader:
    """The header of a file.

    Raises:
        FileFormatError: the first line is another, or the header does not end.
    """
    lines: list[str] = []
    length = 0
    with path.open("rb") as file:
        while True:
            line = file.readline(MAX_HEADER_BYTES - length + 1)
            if not line.startswith(b"#"):
                break
            if length + len(line) > MAX_HEADER_BYTES:
                raise FileFormatError(f"{path}: its header is longer than 8 MiB; it is damaged")
            if not line.endswith(b"\n"):
                raise FileFormatError(f"{path} ends inside its header; the file was cut off")
            length += len(line)
            lines.append(line.decode("latin-1").rstrip("\r\n"))
            if lines[0] != magic:
                raise FileFormatError(f"{path} begins with {lines[0][:40]!r}, not with {magic}")
            if lines[-1] == end:
                break
    if not lines:
        raise FileFormatError(f"{path} does not begin with {magic}")
    return AedatHeader(tuple(lines), length)


RECORD = np.dtype([("address", ">u4"), ("t", ">u4")])
SPECIAL = 1 << 10
"""Bit of a DAVIS address that is no pixel's: an external signal."""
APS = 1 << 31
"""Bit of a DAVIS address that is an image's or an IMU's; of a DVS128's, jAER's special events."""
SYNC = 1 << 15
"""Bit of a DVS128 address that is an external signal's."""

Addresses: TypeAlias = NDArray[np.int64]


@dataclass(frozen=True)
class AddressLayout:
    """Pixels and polarity of 32-bit addresses; beyond the sensor, coordinates come out negative."""

    size: SensorSize
    decode: Callable[[Addresses], dict[str, Addresses]]
    not_events: int = 0
    """Addresses with one of these bits are no events."""


def davis_layout(size: SensorSize) -> AddressLayout:
    """The layout of a DAVIS of this size."""

    def decode(address: Addresses) -> dict[str, Addresses]:
        x, y = size.width - 1 - (address >> 12 & 1023), size.height - 1 - (address >> 22 & 511)
        return {"x": x, "y": y, "p": address >> 11 & 1}

    return AddressLayout(size, decode, SPECIAL | APS)


def _decode_dvs(address: Addresses) -> dict[str, Addresses]:
    return {"x": address >> 8, "y": address >> 1 & 127, "p": address & 1}


def _decode_jaer_dvs(address: Addresses) -> dict[str, Addresses]:
    return {"x": 127 - (address >> 1 & 127), "y": 127 - (address >> 8), "p": 1 - (address & 1)}


def _decode_cifar(address: Addresses) -> dict[str, Addresses]:
    # Mirroring x and y and swapping ON and OFF flips all 15 bits.
    return _decode_dvs(address ^ 0x7FFF)


_DVS = SensorSize(128, 128)
JAER_DVS128 = AddressLayout(_DVS, _decode_jaer_dvs, APS | SYNC)
DVS128 = AddressLayout(_DVS, _decode_dvs)
CIFAR10_DVS = AddressLayout(_DVS, _decode_cifar)
LARGEST_DAVIS = SensorSize(1024, 512)
CHIPS = {
    "128": _DVS,
    "208": SensorSize(208, 192),
    "240": SensorSize(240, 180),
    "346": SensorSize(346, 260),
    "640": SensorSize(640, 480),
}
"""Sizes of DVS and DAVIS by the number in the class of jAER that `# AEChip:` names."""


class Aedat2Codec(BlockReader):
    """AEDAT2 whose header names its layout."""

    name: ClassVar[str] = "aedat2"
    extensions: ClassVar[tuple[str, ...]] = (".aedat",)
    layout: ClassVar[AddressLayout | None] = None

    def recognises(self, path: Path) -> bool:
        """True if the file begins as AEDAT2 does."""
        return begins_with(path, AEDAT2_MAGIC.encode())

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """The header names the camera, which has a size, and holds the metadata."""
        header = read_aedat_header(path, AEDAT2_MAGIC, AEDAT2_END)
        layout = self.layout or _find_layout(path, header, options.size)
        blocks = partial(_read_addresses, path, header.length, layout)
        return FileContents(layout.size, header.metadata(path), blocks)

    def side_data(self, path: Path) -> SideData:
        """External signals of a DAVIS."""
        return {"triggers": partial(_read_signals, path)}


class Dvs128Codec(Aedat2Codec):
    """AEDAT2 of a DVS128, as tonic reads it."""

    name: ClassVar[str] = "aedat2-dvs128"
    extensions: ClassVar[tuple[str, ...]] = ()
    layout: ClassVar[AddressLayout | None] = DVS128


class Cifar10DvsCodec(Aedat2Codec):
    """AEDAT2 of a DVS128, as SpikingJelly reads CIFAR10-DVS."""

    name: ClassVar[str] = "cifar10-dvs"
    extensions: ClassVar[tuple[str, ...]] = ()
    layout: ClassVar[AddressLayout | None] = CIFAR10_DVS


def _find_layout(path: Path, header: AedatHeader, size: SensorSize | None) -> AddressLayout:
    """The layout of the camera that the header names, else of the sensor size given.

    Raises:
        InputError: there is neither, or the addresses do not fit the size.
    """
    chip = (header.value("AEChip") or header.value("Layout") or "").rpartition(".")[2].lower()
    named = re.search(r"(dvs|davis)\D*(128|208|240|346|640)", chip)
    if named is not None:
        return JAER_DVS128 if named[1] == "dvs" else davis_layout(CHIPS[named[2]])
    block = next(read_records(path, header.length, RECORD.itemsize), b"")
    address = np.frombuffer(block, dtype=RECORD)["address"].astype(np.int64)
    is_davis = bool((address >> 16 & 0x7FFF).any())
    if size is None:
        known = "davis240c, davis346 or its WIDTHxHEIGHT" if is_davis else "dvs128"
        more = (
            ""
            if is_davis
            else f"; or the format {Dvs128Codec.name} (as tonic reads) or {Cifar10DvsCodec.name} "
            "(as SpikingJelly reads)"
        )
        raise InputError(
            f"{path} is AEDAT2 and does not say which camera made it; give its sensor (size= in "
            f"Python, --sensor on the command line): {known}{more}"
        )
    layout = JAER_DVS128 if size == _DVS and not is_davis else davis_layout(size)
    if size.width > LARGEST_DAVIS.width or size.height > LARGEST_DAVIS.height:
        raise InputError(
            f"{path} is AEDAT2, whose sensors have at most {LARGEST_DAVIS}, not {size}"
        )
    columns = layout.decode(address[(address & layout.not_events) == 0])
    lowest = min((int(columns[name].min(initial=0)) for name in "xy"), default=0)
    if lowest < 0:
        raise InputError(
            f"{path} has addresses outside of a sensor of {size}; give the sensor that made it"
        )
    return layout


def _read_signals(path: Path) -> Iterator[Columns]:
    header = read_aedat_header(path, AEDAT2_MAGIC, AEDAT2_END)
    for block in read_records(path, header.length, RECORD.itemsize):
        records = np.frombuffer(block, dtype=RECORD)
        address = records["address"].astype(np.int64)
        is_signal = (address & (SPECIAL | APS) == SPECIAL) & (address >> 16 != 0)
        yield {"t": records["t"][is_signal].astype(np.int64)}


def _read_addresses(path: Path, start: int, layout: AddressLayout) -> Iterator[Columns]:
    for block in read_records(path, start, RECORD.itemsize):
        records = np.frombuffer(block, dtype=RECORD)
        address, t = (records[name].astype(np.int64) for name in ("address", "t"))
        is_event = (address & layout.not_events) == 0
        if not is_event.all():
            address, t = address[is_event], t[is_event]
        yield {**layout.decode(address), "t": t}


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
        header = read_aedat_header(path, AEDAT3_MAGIC, AEDAT3_END)
        if header.lines[-1] != AEDAT3_END:
            raise FileFormatError(f"{path}: its header does not end with {AEDAT3_END}")
        size, metadata = _stored_size(path, header), header.metadata(path)
        return FileContents(size, metadata, partial(_read_events, path, header.length))

    def side_data(self, path: Path) -> SideData:
        """External signals and IMU samples."""
        start = read_aedat_header(path, AEDAT3_MAGIC, AEDAT3_END).length
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


def _read_packets(path: Path, start: int, kind: int) -> Iterator[tuple[NDArray[np.void], int]]:
    """The events of each packet of a type, and how often its clock has turned."""
    dtype = PACKETS[kind]
    with path.open("rb") as file:
        left = os.fstat(file.fileno()).st_size - start
        file.seek(start)
        while left > 0:
            head = _read_head(file, path, left)
            found, _, event_bytes, time_offset, turns, _, count, _ = head
            left -= _HEAD.size + event_bytes * count
            if found != kind:
                file.seek(event_bytes * count, os.SEEK_CUR)
                continue
            if (event_bytes, time_offset) != (dtype.itemsize, 4) or turns < 0:
                raise FileFormatError(
                    f"{path} holds a packet of events of {event_bytes} bytes, not "
                    f"{dtype.itemsize}; it is damaged"
                )
            events = np.frombuffer(file.read(event_bytes * count), dtype=dtype)
            yield events[(events["place"] & 1) == 1], turns


def _times(events: NDArray[np.void], turns: int) -> NDArray[np.int64]:
    return (events["t"].astype(np.int64) & TIME_MASK) + (turns << TIME_BITS)


def _read_events(path: Path, start: int) -> Iterator[Columns]:
    for events, turns in _read_packets(path, start, POLARITY_TYPE):
        place = events["place"]
        yield {
            "x": (place >> 17).astype(np.uint16),
            "y": (place >> 2 & 0x7FFF).astype(np.uint16),
            "t": _times(events, turns),
            "p": (place >> 1 & 1).astype(np.uint8),
        }


def _read_special(path: Path, start: int) -> Iterator[Columns]:
    for events, turns in _read_packets(path, start, SPECIAL_TYPE):
        kinds = events["place"] >> 1 & 127
        is_signal = (kinds >= FIRST_SIGNAL) & (kinds <= LAST_SIGNAL)
        yield {"t": _times(events[is_signal], turns), "type": kinds[is_signal]}


def _read_imu(path: Path, start: int) -> Iterator[Columns]:
    for samples, turns in _read_packets(path, start, IMU_TYPE):
        yield {
            "t": _times(samples, turns),
            "temperature_c": samples["values"][:, 6],
            **{f"acceleration_{axis}_g": samples["values"][:, at] for at, axis in enumerate("xyz")},
            **{
                f"rotation_{axis}_deg_s": samples["values"][:, 3 + at]
                for at, axis in enumerate("xyz")
            },
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
