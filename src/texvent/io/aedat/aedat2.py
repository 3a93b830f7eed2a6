"""AEDAT2 (jAER, v2e) and AEDAT1: text lines that start with `#`, then records of one event each.

AEDAT2, 8 bytes per event, big-endian, W x H the sensor (AEDAT1: 6 bytes, the address 16 bits):

    record       u32 address · u32 time, µs
    davis        (H-1 - y)<<22 | (W-1 - x)<<12 | p<<11      jAER and v2e; bit 31 or 10: no event
    dvs640       (479 - y)<<11 | (639 - x)<<1 | p           jAER and v2e at 640x480
    jaer-dvs128  (127 - y)<<8 | (127 - x)<<1 | (1 - p)      jAER; bit 31 or 15: no event
    dvs128       x<<8 | y<<1 | p                            tonic
    cifar10-dvs  (127 - x)<<8 | (127 - y)<<1 | (1 - p)      SpikingJelly

The layout of the address depends on the camera and the tool; x and y count from the top left here,
y from the bottom in jAER. A header line `# AEChip: ...` names the camera; of any other file the
sensor is asked for, and the layout is the one in which every address is a pixel's: bits that it
leaves unused must be 0. Recordings of a DVS128 as tonic and SpikingJelly read them have a format
of their own. The clock has 32 bits and turns; jAER's passes through 0.

Of a DAVIS, bit 10 marks an external signal, of v2e's labelled files noise; bits 31, 11 and 10 a
value of an IMU sample, which has seven, of one time:

    imu          30..28 number: acceleration x, y, z, temperature, rotation x, y, z · 27..12 value

Values have jAER's units and signs: x to the right, y up, z into the scene; rotations positive where
the camera tilts up, pans right, rolls clockwise. The full scales are in the header.

Sources: iniVation, AEDAT 2.0 file format; jAER, DVS128.Extractor (flips x and the polarity),
DVS640, DavisChip, IMUSample; v2e, AEDat2Output; the readers named above (formats are facts).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, warn
from texvent.io.aedat.aedat4 import IMU_COLUMNS
from texvent.io.aedat.header import AedatHeader, read_aedat_header
from texvent.io.block_codec import BlockReader, FileContents
from texvent.io.block_writer import Columns, SideData
from texvent.io.byte_blocks import read_records
from texvent.io.clocks import BITS_OF_32, TurningClock
from texvent.io.input_checks import begins_with
from texvent.io.reading import ReadOptions
from texvent.sensor import SensorSize

RECORDS = {
    "#!AER-DAT1.0": np.dtype([("address", ">u2"), ("t", ">u4")]),
    "#!AER-DAT2.0": np.dtype([("address", ">u4"), ("t", ">u4")]),
}
"""First line → type of the records."""
MAGICS = tuple(RECORDS)
AEDAT2_END = "#End Of ASCII Header"
V2E = "AEDat2Output in v2e"
V2E_LABELLED = "noise events are labeled"
"""Words in the headers that v2e writes."""
SPECIAL = 1 << 10
"""Bit of a DAVIS address that is no pixel's: an external signal; of v2e's, that of noise."""
APS = 1 << 31
"""Bit of a DAVIS address that is an image's or an IMU's; of a DVS128's, jAER's special events."""
SYNC = 1 << 15
"""Bit of a DVS128 address that is an external signal's."""
IMU = APS | 3 << 10
"""Bits of a DAVIS address that is a value of an IMU."""

Addresses: TypeAlias = NDArray[np.int64]


@dataclass(frozen=True)
class AddressLayout:
    """Pixels and polarity of 32-bit addresses; beyond the sensor, coordinates come out negative."""

    name: str
    size: SensorSize
    decode: Callable[[Addresses], dict[str, Addresses]]
    not_events: int = 0
    """Addresses with one of these bits are no events."""
    signal: int = 0
    """Bit of an external signal among them."""
    unused: int = 0
    """Bits that are 0 in the address of every event."""

    def events(self, address: Addresses) -> tuple[Addresses, NDArray[np.bool_]]:
        """The addresses of events, and which of all these are."""
        is_event = (address & self.not_events) == 0
        return address[is_event], is_event

    def columns(self, address: Addresses) -> tuple[dict[str, Addresses], int]:
        """Columns x, y, p and others of events, and the number of addresses that are no pixel's.

        Those have x = -1.
        """
        columns = self.decode(address)
        x, y = columns["x"], columns["y"]
        is_pixel = (x >= 0) & (x < self.size.width) & (y >= 0) & (y < self.size.height)
        is_pixel &= (address & self.unused) == 0
        if is_pixel.all():
            return columns, 0
        return {**columns, "x": np.where(is_pixel, x, -1)}, int((~is_pixel).sum())


def davis_layout(size: SensorSize, *, is_labelled: bool = False) -> AddressLayout:
    """The layout of a DAVIS of this size; `is_labelled`: v2e marked noise in it."""

    def decode(address: Addresses) -> dict[str, Addresses]:
        x, y = size.width - 1 - (address >> 12 & 1023), size.height - 1 - (address >> 22 & 511)
        label = {"label": address >> 10 & 1} if is_labelled else {}
        return {"x": x, "y": y, "p": address >> 11 & 1, **label}

    if is_labelled:
        return AddressLayout("davis", size, decode, APS, 0, 1023)
    return AddressLayout("davis", size, decode, SPECIAL | APS, SPECIAL, 1023)


def _decode_dvs640(address: Addresses) -> dict[str, Addresses]:
    return {"x": 639 - (address >> 1 & 1023), "y": 479 - (address >> 11 & 1023), "p": address & 1}


def _decode_dvs(address: Addresses) -> dict[str, Addresses]:
    return {"x": address >> 8, "y": address >> 1 & 127, "p": address & 1}


def _decode_jaer_dvs(address: Addresses) -> dict[str, Addresses]:
    return {"x": 127 - (address >> 1 & 127), "y": 127 - (address >> 8), "p": 1 - (address & 1)}


def _decode_cifar(address: Addresses) -> dict[str, Addresses]:
    # Mirroring x and y and swapping ON and OFF flips all 15 bits.
    return _decode_dvs(address ^ 0x7FFF)


_DVS = SensorSize(128, 128)
JAER_DVS128 = AddressLayout("jaer-dvs128", _DVS, _decode_jaer_dvs, APS | SYNC, SYNC)
DVS640 = AddressLayout("dvs640", SensorSize(640, 480), _decode_dvs640, unused=~0 << 21)
DVS128 = AddressLayout("dvs128", _DVS, _decode_dvs)
CIFAR10_DVS = AddressLayout("cifar10-dvs", _DVS, _decode_cifar)
LARGEST_DAVIS = SensorSize(1024, 512)
CHIPS = {
    "128": _DVS,
    "208": SensorSize(208, 192),
    "240": SensorSize(240, 180),
    "346": SensorSize(346, 260),
    "640": DVS640.size,
}
"""Sizes of DVS and DAVIS by the number in the class of jAER that `# AEChip:` names."""


class Aedat2Codec(BlockReader):
    """AEDAT2 whose header names its layout."""

    name: ClassVar[str] = "aedat2"
    extensions: ClassVar[tuple[str, ...]] = (".aedat",)
    layout: ClassVar[AddressLayout | None] = None

    def recognises(self, path: Path) -> bool:
        """True if the file begins as AEDAT2 or AEDAT1 does."""
        return any(begins_with(path, magic.encode()) for magic in MAGICS)

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """The header names the camera, which has a size, and holds the metadata."""
        header = _read_header(path)
        layout = self.layout or _chip_layout(header)
        if layout is None:
            layout = _find_layout(path, header, options)
        blocks = partial(_read_events, path, header, layout, options.repair)
        return FileContents(layout.size, header.metadata(path), blocks)

    def side_data(self, path: Path) -> SideData:
        """External signals; of a DAVIS IMU samples."""
        header = _read_header(path)
        # Of an unknown camera, those with the bits of a DAVIS.
        layout = self.layout or _chip_layout(header) or davis_layout(LARGEST_DAVIS)
        if not layout.signal or any(V2E in line for line in header.lines):
            return {}
        imu = {"imu": partial(_read_imu, path, header)} if layout.name == "davis" else {}
        return {"triggers": partial(_read_signals, path, header, layout), **imu}


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


def _read_header(path: Path) -> AedatHeader:
    return read_aedat_header(path, MAGICS, AEDAT2_END)


def _chip_layout(header: AedatHeader) -> AddressLayout | None:
    """The layout of the camera that the header names, if its class is known."""
    chip = (header.value("AEChip") or header.value("Layout") or "").rpartition(".")[2].lower()
    named = re.search(r"(dvs|davis)\D*(128|208|240|346|640)", chip)
    if named is None:
        return None
    of_dvs = {"128": JAER_DVS128, "640": DVS640}
    if named[1] == "dvs" and named[2] in of_dvs:
        return of_dvs[named[2]]
    # jAER gives other meanings to the unused bits of some chips.
    return replace(davis_layout(CHIPS[named[2]]), unused=0)


def _find_layout(path: Path, header: AedatHeader, options: ReadOptions) -> AddressLayout:
    """The layout in which every address is a pixel's of the sensor size given.

    Raises:
        InputError: no size is given, or there is no such layout.

    Warns:
        TexventWarning: there are two.
    """
    size = options.size
    address = next(_read_timed(path, header), (np.empty(0, np.int64), None))[0]
    if size is None:
        is_davis = bool((address >> 16 & 0x7FFF).any())
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
    if size.width > LARGEST_DAVIS.width or size.height > LARGEST_DAVIS.height:
        raise InputError(
            f"{path} is AEDAT2, whose sensors have at most {LARGEST_DAVIS}, not {size}"
        )
    is_labelled = any(V2E_LABELLED in line for line in header.lines)
    layouts = [davis_layout(size, is_labelled=is_labelled)]
    if size == DVS640.size:
        # v2e has no other layout of this size.
        is_v2e = any(V2E in line for line in header.lines)
        layouts = [DVS640] if is_v2e else [*layouts, DVS640]
    if size == _DVS:
        layouts = [JAER_DVS128, *layouts]
    wrong = [one.columns(one.events(address)[0])[1] for one in layouts]
    if min(wrong) and not options.repair:
        counts = " and ".join(
            f"{count:,} in the layout {one.name}" for count, one in zip(wrong, layouts, strict=True)
        )
        raise InputError(
            f"{path} has addresses outside of a sensor of {size}: of the first {len(address):,}, "
            f"{counts}; give the sensor that made it"
        )
    found = [one for one, count in zip(layouts, wrong, strict=True) if count == min(wrong)]
    fits = [one for one in found if len(one.events(address)[0])]
    if len(fits) > 1:
        first, second = (one.name for one in fits)
        warn(f"{path}: its addresses fit the layouts {first} and {second}; read as {first}")
    return (fits or found)[0]


def _read_timed(path: Path, header: AedatHeader) -> Iterator[tuple[Addresses, NDArray[np.int64]]]:
    """Addresses and times of all records, block by block."""
    record, clock = RECORDS[header.lines[0]], TurningClock(*BITS_OF_32)
    for block in read_records(path, header.length, record.itemsize):
        records = np.frombuffer(block, record)
        yield records["address"].astype(np.int64), clock.unroll(records["t"])


def _read_events(
    path: Path, header: AedatHeader, layout: AddressLayout, is_repaired: bool
) -> Iterator[Columns]:
    for every, t in _read_timed(path, header):
        address, is_event = layout.events(every)
        columns, wrong = layout.columns(address)
        if wrong and not is_repaired:
            raise FileFormatError(
                f"{path} has addresses outside of a sensor of {layout.size}: {wrong:,} of "
                f"{len(address):,} in the layout {layout.name}; give the sensor that made it"
            )
        yield {**columns, "t": t[is_event]}


def _read_signals(path: Path, header: AedatHeader, layout: AddressLayout) -> Iterator[Columns]:
    for address, t in _read_timed(path, header):
        is_signal = address & (layout.signal | APS | layout.unused) == layout.signal
        yield {"t": t[is_signal]}


IMU_VALUES = 7
"""Values of a sample: acceleration x, y, z, temperature, rotation x, y, z."""
SIGNS = np.array([-1, 1, 1, 1, -1, 1, -1])
SCALES = {"ImuAccelScaleG(2|4|8|16)": 4, "GyroFullScaleDegPerSec(250|500|1000|2000)": 500}
"""jAER's settings in the header, with the full scale → the one that jAER takes where they are
missing: g, °/s."""
TEMPERATURE_PER_C, TEMPERATURE_OFFSET_C = 340, 35


def _read_imu(path: Path, header: AedatHeader) -> Iterator[Columns]:
    """Samples whose seven values are all there, one after the other.

    Warns:
        TexventWarning: the header does not state the full scales; values without a sample.
    """
    text = "\n".join(header.lines)
    stated = {setting: re.search(f'"{setting}"', text) for setting in SCALES}
    g, deg_s = (int(one[1]) if one else SCALES[setting] for setting, one in stated.items())
    # As the data sheet of the MPU-6150 rounds them.
    per_unit = np.array([32_768 / g] * 3 + [TEMPERATURE_PER_C] + [round(32_750 / deg_s, 1)] * 3)
    order = {name: at for at, name in zip((3, 0, 1, 2, 4, 5, 6), IMU_COLUMNS, strict=True)}
    kept = np.empty((2, 0), np.int64)
    lost = count = 0
    for address, t in _read_timed(path, header):
        is_imu = address & IMU == IMU
        kept = np.concatenate([kept, [address[is_imu], t[is_imu]]], axis=1)
        number = kept[0] >> 28 & 7
        # A sample may go on in the next block; what begins none never will.
        tail = max(len(number) - IMU_VALUES + 1, 0)
        starts = np.flatnonzero(number[:tail] == 0)
        rows = starts[:, None] + np.arange(IMU_VALUES)
        is_whole = (number[rows] == np.arange(IMU_VALUES)).all(axis=1)
        rows = rows[is_whole]
        used = int(rows[-1, -1]) + 1 if len(rows) else 0
        rest = max(used, tail)
        lost += rest - rows.size
        count += len(rows)
        values = (kept[0][rows] >> 12 & 0xFFFF).astype(np.uint16).view(np.int16) * SIGNS
        scaled = values / per_unit
        scaled[:, 3] += TEMPERATURE_OFFSET_C
        yield {
            "t": kept[1][rows[:, 0]],
            **{name: scaled[:, at].astype(np.float32) for name, at in order.items()},
        }
        kept = kept[:, rest:]
    lost += kept.shape[1]
    if lost:
        warn(f"{path}: left out {lost:,} values of an IMU that make no sample")
    if count and None in stated.values():
        warn(f"{path} does not state the full scales of its IMU; taken are {g} g and {deg_s} °/s")
