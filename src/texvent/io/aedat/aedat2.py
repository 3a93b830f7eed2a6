"""AEDAT2, jAER's format: text lines that start with `#`, then 8 bytes per event, big-endian.

    record       u32 address · u32 time, µs
    davis346     (259 - y)<<22 | (345 - x)<<12 | p<<11      jAER and v2e; bit 31 or 10: no event
    jaer-dvs128  (127 - y)<<8 | (127 - x)<<1 | (1 - p)      jAER; bit 31 or 15: no event
    dvs128       x<<8 | y<<1 | p                            tonic
    cifar10-dvs  (127 - x)<<8 | (127 - y)<<1 | (1 - p)      SpikingJelly

The layout of the address depends on the camera and the tool; x and y count from the top left here,
y from the bottom in jAER. A header line `# Layout: davis346` or `# AEChip: ...` names it; any other
file is read only with the layout's format given, because a wrong one gives wrong events without any
error. docs/files.md says which recording is read with which.

Sources: iniVation, AEDAT 2.0 file format; jAER, DVS128.Extractor (flips x and the polarity); the
readers named above (formats are facts).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError
from texvent.io.aedat.header import AEDAT2_END, AEDAT2_MAGIC, AedatHeader, read_aedat_header
from texvent.io.block_codec import BlockReader, FileContents, read_records
from texvent.io.input_checks import begins_with
from texvent.io.protocol import Columns
from texvent.sensor import SensorSize

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

    name: str
    size: SensorSize
    decode: Callable[[Addresses], dict[str, Addresses]]
    not_events: int = 0
    """Addresses with one of these bits are no events."""


def _decode_davis(address: Addresses) -> dict[str, Addresses]:
    x, y = 345 - (address >> 12 & 1023), 259 - (address >> 22 & 511)
    return {"x": x, "y": y, "p": address >> 11 & 1}


def _decode_dvs(address: Addresses) -> dict[str, Addresses]:
    return {"x": address >> 8, "y": address >> 1 & 127, "p": address & 1}


def _decode_jaer_dvs(address: Addresses) -> dict[str, Addresses]:
    return {"x": 127 - (address >> 1 & 127), "y": 127 - (address >> 8), "p": 1 - (address & 1)}


def _decode_cifar(address: Addresses) -> dict[str, Addresses]:
    # Mirroring x and y and swapping ON and OFF flips all 15 bits.
    return _decode_dvs(address ^ 0x7FFF)


_DVS = SensorSize(128, 128)
DAVIS346 = AddressLayout("davis346", SensorSize(346, 260), _decode_davis, SPECIAL | APS)
JAER_DVS128 = AddressLayout("jaer-dvs128", _DVS, _decode_jaer_dvs, APS | SYNC)
DVS128 = AddressLayout("dvs128", _DVS, _decode_dvs)
CIFAR10_DVS = AddressLayout("cifar10-dvs", _DVS, _decode_cifar)
LAYOUTS = {layout.name: layout for layout in (DAVIS346, JAER_DVS128, DVS128, CIFAR10_DVS)}


class Aedat2Codec(BlockReader):
    """AEDAT2 whose header names its layout."""

    name: ClassVar[str] = "aedat2"
    extensions: ClassVar[tuple[str, ...]] = (".aedat",)
    layout: ClassVar[AddressLayout | None] = None

    def recognises(self, path: Path) -> bool:
        """True if the file begins as AEDAT2 does."""
        return begins_with(path, AEDAT2_MAGIC.encode())

    def inspect(self, path: Path) -> FileContents:
        """The header names the layout, which has a size, and holds the metadata."""
        header = read_aedat_header(path, AEDAT2_MAGIC, AEDAT2_END)
        layout = self.layout or _named_layout(path, header)
        blocks = partial(_read_blocks, path, header.length, layout)
        return FileContents(layout.size, header.metadata(path), blocks)


class Davis346Codec(Aedat2Codec):
    """AEDAT2 of a DAVIS346."""

    name: ClassVar[str] = "aedat2-davis346"
    extensions: ClassVar[tuple[str, ...]] = ()
    layout: ClassVar[AddressLayout | None] = DAVIS346


class JaerDvs128Codec(Aedat2Codec):
    """AEDAT2 of a DVS128, as jAER writes and shows it."""

    name: ClassVar[str] = "aedat2-jaer-dvs128"
    extensions: ClassVar[tuple[str, ...]] = ()
    layout: ClassVar[AddressLayout | None] = JAER_DVS128


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


def _named_layout(path: Path, header: AedatHeader) -> AddressLayout:
    name = header.value("Layout")
    chip = (header.value("AEChip") or "").lower()
    if name is None and "davis346" in chip:
        name = DAVIS346.name
    if name is None and chip.endswith("dvs128"):
        name = JAER_DVS128.name
    if name is None:
        raise InputError(
            f"{path} is AEDAT2 but does not say how its addresses are laid out; state the format: "
            f"--format {Davis346Codec.name}, {JaerDvs128Codec.name} (jAER's recordings), "
            f"{Dvs128Codec.name} (as tonic reads) or {Cifar10DvsCodec.name} (as SpikingJelly reads)"
        )
    if name not in LAYOUTS:
        raise FileFormatError(f"{path}: its header names an unknown layout {name[:40]!r}")
    return LAYOUTS[name]


def _read_blocks(path: Path, start: int, layout: AddressLayout) -> Iterator[Columns]:
    for block in read_records(path, start, RECORD.itemsize):
        records = np.frombuffer(block, dtype=RECORD)
        address, t = (records[name].astype(np.int64) for name in ("address", "t"))
        is_event = (address & layout.not_events) == 0
        if not is_event.all():
            address, t = address[is_event], t[is_event]
        yield {**layout.decode(address), "t": t}
