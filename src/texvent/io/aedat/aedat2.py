"""AEDAT2, jAER's format: text lines that start with `#`, then 8 bytes per event, big-endian.

    record   u32 address · u32 time, µs; the address layouts are in `aedat2_layouts`

Times stay below 2^31 µs (35.8 min): most readers take them as signed. texvent names the layout
in the header (`# Layout: davis346`); a file of another program that names no layout is read only
with the layout's format given, because a wrong one gives wrong events without any error.

Traps:
    The only line with a time is `# Creation time: System.currentTimeMillis() 0`: other wordings
    crash readers. It is 0, so that the same events give the same file.
    A first record that begins with the byte of `#` (DAVIS346, y 116 to 119) would be taken for
    text; then a record of an external signal (no pixel's) of the same time precedes it.
    SpikingJelly and tonic do not know such records and see one OFF event more.

Source: iniVation, AEDAT 2.0 file format.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import ClassVar

import numpy as np

from texvent.errors import FileFormatError, InputError
from texvent.io.aedat.aedat2_layouts import (
    CIFAR10_DVS,
    DAVIS346,
    DVS128,
    JAER_DVS128,
    LAYOUTS,
    SPECIAL,
    AddressLayout,
)
from texvent.io.aedat.header import (
    AEDAT2_END,
    AEDAT2_MAGIC,
    AedatHeader,
    make_aedat_header,
    read_aedat_header,
)
from texvent.io.block_codec import BlockCodec, FileContents, read_records
from texvent.io.block_writer import FileTarget, WriteBlock
from texvent.io.input_checks import begins_with
from texvent.io.limits import FormatLimits
from texvent.io.protocol import Columns

RECORD = np.dtype([("address", ">u4"), ("t", ">u4")])
STOP_US = 1 << 31
COMMENTS = (
    "# This is a raw AE data file - do not edit",
    "# Data format is int32 address, int32 timestamp (8 bytes total), repeated for each event",
    "# Timestamps tick is 1 us",
    "# Creation time: System.currentTimeMillis() 0",
)


class Aedat2Codec(BlockCodec):
    """AEDAT2 whose layout follows from the header on reading and from the sensor on writing."""

    name: ClassVar[str] = "aedat2"
    extensions: ClassVar[tuple[str, ...]] = (".aedat",)
    layout: ClassVar[AddressLayout | None] = None
    limits: ClassVar[FormatLimits] = FormatLimits("AEDAT2", 346, STOP_US)

    def recognises(self, path: Path) -> bool:
        """True if the file begins as AEDAT2 does."""
        return begins_with(path, AEDAT2_MAGIC.encode())

    def inspect(self, path: Path) -> FileContents:
        """The header names the layout, which has a size, and holds the metadata."""
        header = read_aedat_header(path, AEDAT2_MAGIC, AEDAT2_END)
        layout = self.layout or _named_layout(path, header)
        blocks = partial(_read_blocks, path, header.length, layout)
        return FileContents(layout.size, header.metadata(path), blocks)

    def check_target(self, target: FileTarget) -> None:
        """Refuse a sensor without a layout."""
        self._layout_for(target)

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Write the header."""
        layout = self._layout_for(target)
        lines = (AEDAT2_MAGIC, *COMMENTS, f"# Layout: {layout.name}")
        header = make_aedat_header(lines, target.metadata, AEDAT2_END)
        with part.open("wb") as file:
            file.write(header)

            def write(columns: Columns) -> None:
                records = np.empty(len(columns["t"]), dtype=RECORD)
                records["address"] = layout.encode(columns)
                records["t"] = columns["t"]
                if file.tell() == len(header) and records[0].tobytes().startswith(b"#"):
                    file.write(np.array([(SPECIAL, records["t"][0])], dtype=RECORD).tobytes())
                file.write(records.tobytes())

            yield write

    def _layout_for(self, target: FileTarget) -> AddressLayout:
        layouts = (DAVIS346, DVS128) if self.layout is None else (self.layout,)
        for layout in layouts:
            if layout.size == target.size:
                return layout
        sizes = " and ".join(str(layout.size) for layout in layouts)
        raise InputError(
            f"cannot write {target.path}: {self.name} holds sensors of {sizes}, not {target.size}; "
            "aedat3 (.aedat), aedat4 (.aedat4) and hdf5 (.h5) hold it"
        )


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
        address = records["address"].astype(np.uint32)
        t = records["t"].astype(np.int64)
        if layout.not_events:
            is_event = (address & np.uint32(layout.not_events)) == 0
            if not is_event.all():
                address, t = address[is_event], t[is_event]
        yield {**layout.decode(address), "t": t}
