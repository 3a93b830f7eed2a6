"""AEDAT4, the format of iniVation's DV software: packets of events, LZ4-compressed by default.

The container is that of `aedat4_container`; a packet of events is a table EVTS.
Coordinates are i2: sensors up to 32768 pixels a side. Times are i8 µs. Packets hold 10 ms, as
DV's do, so that its player can seek. Provenance is in the XML of the header, as
attribute `texvent`. One stream of events is read; triggers and IMU samples beside it are side
data, frames are read by `texvent.capture.aedat4_frames`.

    TRIG  list of tables: slot 0 i64 time · 1 i8 type
    IMUS  list of tables: slot 0 i64 time · 1 f32 temperature · 2..4 acceleration, g ·
          5..7 rotation, degrees per second

Source: iniVation, AEDAT 4.0 file format; tables in `aedat4_tables`.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.errors import FileFormatError
from texvent.io.aedat.aedat4_container import (
    EVENTS,
    FRAMES,
    LZ4_CODE,
    LZ4_NAME,
    MAGIC,
    PACKET_HEAD,
    Container,
    open_container,
    pack_lz4,
    stored_size,
)
from texvent.io.aedat.aedat4_tables import (
    UNKNOWN,
    PacketEntry,
    StreamInfo,
    Table,
    make_events,
    make_header,
    make_info,
    make_list,
    read_events,
)
from texvent.io.block_codec import BlockCodec, FileContents, split_by_time
from texvent.io.block_writer import Columns, FileTarget, FormatLimits, SideData, WriteBlock
from texvent.io.input_checks import begins_with
from texvent.io.metadata import metadata_from_json, metadata_to_json
from texvent.io.reading import ReadOptions, choose

PACKET_US = 10_000
"""Time per packet, µs."""
IMU_COLUMNS = (
    *("temperature_c", "acceleration_x_g", "acceleration_y_g", "acceleration_z_g"),
    *("rotation_x_deg_s", "rotation_y_deg_s", "rotation_z_deg_s"),
)
SIDE_TABLES = {
    "triggers": ("TRIG", [("type", "<i1")]),
    "imu": ("IMUS", [(name, "<f4") for name in IMU_COLUMNS]),
}
"""Identifier of a packet, and its columns after slot 0, the time."""


class Aedat4Codec(BlockCodec):
    """AEDAT4 with LZ4."""

    name: ClassVar[str] = "aedat4"
    has_checksums: ClassVar[bool] = True
    extensions: ClassVar[tuple[str, ...]] = (".aedat4",)
    limits: ClassVar[FormatLimits] = FormatLimits("AEDAT4", 1 << 15, 1 << 63)

    def recognises(self, path: Path) -> bool:
        """True if the file begins as AEDAT4 does."""
        return begins_with(path, MAGIC)

    takes: ClassVar[tuple[str, ...]] = ("stream",)

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """The header's XML states size and metadata of the stream of events."""
        container = open_container(path, is_whole=not options.repair)
        streams = container.streams_of(EVENTS)
        if not streams:
            raise FileFormatError(f"{path} holds no stream of events")
        names = [f"{one.number}:{one.attributes.get('source', EVENTS)}" for one in streams]
        wanted = options.stream
        if wanted is not None:
            numbers = [str(one.number) for one in streams]
            wanted = names[numbers.index(wanted)] if wanted in numbers else wanted
        stream = streams[choose(path, names, wanted)]
        metadata: dict[str, Any] = {}
        if "texvent" in stream.attributes:
            metadata = metadata_from_json(path, stream.attributes["texvent"])
        elif stream.attributes.get("source"):
            metadata = {"source": stream.attributes["source"]}
        blocks = partial(_read_blocks, container, stream)
        return FileContents(stored_size(path, stream), metadata, blocks)

    def side_data(self, path: Path) -> SideData:
        """External triggers and IMU samples."""
        container = open_container(path)
        return {
            name: partial(_read_side_data, container, name)
            for name, (identifier, _) in SIDE_TABLES.items()
            if container.streams_of(identifier)
        }

    def beside(self, path: Path) -> Iterator[str]:
        """Side data, and frames."""
        yield from super().beside(path)
        container = open_container(path)
        if any(map(container.count_packets, container.streams_of(FRAMES))):
            yield "frames"

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Write the header; at the end the list of packets, and where it lies into the header."""
        xml = make_info(target.size, LZ4_NAME, metadata_to_json(target.metadata))
        entries: list[PacketEntry] = []
        with part.open("wb") as file:
            file.write(MAGIC + make_header(LZ4_CODE, UNKNOWN, xml))

            def write(columns: Columns) -> None:
                for packet in split_by_time(columns, PACKET_US):
                    times = packet["t"]
                    data = pack_lz4(make_events(packet))
                    file.write(PACKET_HEAD.pack(0, len(data)))
                    entries.append(
                        PacketEntry(
                            file.tell(), len(data), len(times), int(times[0]), int(times[-1])
                        )
                    )
                    file.write(data)

            yield write
            position = file.tell()
            file.write(pack_lz4(make_list(entries, 0)))
            file.seek(len(MAGIC))
            file.write(make_header(LZ4_CODE, position, xml))


def _read_side_data(container: Container, name: str) -> Iterator[Columns]:
    identifier, fields = SIDE_TABLES[name]
    names, forms = [name for name, _ in fields], ["<i8", *(form for _, form in fields)]
    for stream in container.streams_of(identifier):
        for end, packet in container.read_packets(stream):
            try:
                for t, *columns in Table.root(packet, identifier.encode()).columns(0, forms):
                    yield {"t": t, **dict(zip(names, columns, strict=True))}
            except FileFormatError as error:
                raise FileFormatError(f"{container.path}, before byte {end}: {error}") from error


def _read_blocks(container: Container, stream: StreamInfo) -> Iterator[Columns]:
    for end, packet in container.read_packets(stream):
        try:
            events = read_events(packet)
        except FileFormatError as error:
            raise FileFormatError(f"{container.path}, before byte {end}: {error}") from error
        # int16 as uint16: a negative coordinate becomes one outside every sensor.
        yield {
            "x": events["x"].astype(np.uint16),
            "y": events["y"].astype(np.uint16),
            "t": events["t"].astype(np.int64),
            "p": events["p"],
        }
