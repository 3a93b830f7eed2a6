"""AEDAT4, the format of iniVation's DV software: packets of events, LZ4-compressed by default.

The container is that of `aedat4_container`; a packet of events is a table EVTS.
Coordinates are i2: sensors up to 32768 pixels a side. Times are i8 µs. Packets hold 10 ms, as
DV's do, so that its player can seek. How the events were made lies in the XML of the header, as
attribute `texvent`. The first stream of events is read; frames, IMU samples and triggers beside
it are read over (`texvent.capture.aedat4_frames` reads the frames).

Source: iniVation, AEDAT 4.0 file format; tables in `aedat4_tables`.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.errors import FileFormatError
from texvent.event_packets import EventPackets
from texvent.io.aedat.aedat4_container import (
    MAGIC,
    PACKET_HEAD,
    Container,
    open_container,
    stored_size,
)
from texvent.io.aedat.aedat4_packing import LZ4, NONE, ZSTD, Packing, packing_of
from texvent.io.aedat.aedat4_tables import (
    UNKNOWN,
    PacketEntry,
    StreamInfo,
    make_events,
    make_header,
    make_info,
    make_list,
    read_events,
)
from texvent.io.block_stream import BlockPackets, BlockWriter, Columns, FileTarget
from texvent.io.columns import (
    existing_file,
    metadata_from_json,
    metadata_to_json,
    stored_or_given_size,
)
from texvent.io.limits import FormatLimits
from texvent.io.magic import begins_with
from texvent.sensor import SensorSize

PACKET_US = 10_000
"""Time per packet, µs."""
EVENTS = "EVTS"


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
        container, stream = _open_events(path)
        attributes = stream.attributes
        final_size = stored_or_given_size(path, stored_size(path, stream), size)
        metadata: dict[str, Any] = {}
        if "texvent" in attributes:
            metadata = metadata_from_json(path, attributes["texvent"])
        elif attributes.get("source"):
            metadata = {"source": attributes["source"]}
        blocks = partial(_read_blocks, container, stream)
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
        self._file.write(PACKET_HEAD.pack(0, len(data)))
        times = columns["t"]
        self._entries.append(
            PacketEntry(self._file.tell(), len(data), len(times), int(times[0]), int(times[-1]))
        )
        self._file.write(data)


def _open_events(path: Path) -> tuple[Container, StreamInfo]:
    container = open_container(path)
    stream = container.find_stream(EVENTS)
    if stream is None:
        raise FileFormatError(f"{path} holds no stream of events")
    return container, stream


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
