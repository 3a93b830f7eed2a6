"""The three tables of AEDAT4, as NumPy records: file header, events of a packet, list of packets.

    IOHE  slot 0 i32 compression · slot 1 i64 position of the list (-1: none) · slot 2 text, XML
    EVTS  slot 0 vector of events: i8 t (µs), i2 x, i2 y, u1 p, 3 bytes padding
    FTAB  slot 0 vector of tables: i64 position after the packet's head, {i32 stream, i32 bytes},
          i64 events, i64 first time, i64 last time

Every table is written with fixed positions, so that the place of the list can be filled in at
the end without changing the header's length.

Reading follows the offsets of FlatBuffers, every one checked: hostile ones end in
`FileFormatError`.

Source: iniVation, AEDAT 4.0 file format; FlatBuffers, "FlatBuffer Internals".
"""

from __future__ import annotations

import struct
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, one_line

PREFIX_BYTES = 4
"""Size-prefixed buffers: u32 number of bytes that follow."""


@dataclass(frozen=True)
class Table:
    """A table inside a buffer.

    Raises:
        FileFormatError: in every method, an offset points outside the buffer.
    """

    data: bytes | memoryview
    position: int

    @classmethod
    def root(cls, data: bytes | memoryview, identifier: bytes) -> Table:
        """The root table of a size-prefixed buffer.

        Raises:
            FileFormatError: the buffer is cut off or of another type.
        """
        if len(data) < 3 * PREFIX_BYTES or bytes(data[8:12]) != identifier:
            raise FileFormatError(f"no {identifier.decode()} table where one must be")
        if _number("<I", data, 0) > len(data) - PREFIX_BYTES:
            raise FileFormatError(f"the {identifier.decode()} table is cut off")
        return cls(data, PREFIX_BYTES + _number("<I", data, PREFIX_BYTES))

    def field(self, slot: int) -> int | None:
        """Position of a field, or None if it has its default value."""
        vtable = self.position - _number("<i", self.data, self.position)
        entry = 4 + 2 * slot
        if entry + 2 > _number("<H", self.data, vtable):
            return None
        offset = _number("<H", self.data, vtable + entry)
        return self.position + offset if offset else None

    def number(self, slot: int, form: str, default: int) -> int:
        """A number; `form` is its struct format, such as `<q`."""
        position = self.field(slot)
        return default if position is None else _number(form, self.data, position)

    def text(self, slot: int) -> bytes:
        """A string, empty if it is left out."""
        start, count = self.vector(slot)
        if start + count > len(self.data):
            raise FileFormatError("a text reaches past the end of its table")
        return bytes(self.data[start : start + count])

    def vector(self, slot: int) -> tuple[int, int]:
        """First byte and number of elements of a vector; their bytes are not checked."""
        position = self.field(slot)
        if position is None:
            return 0, 0
        vector = position + _number("<I", self.data, position)
        return vector + 4, _number("<I", self.data, vector)

    def columns(self, slot: int, forms: Sequence[str]) -> Iterator[list[NDArray[Any]]]:
        """Numbers in the first slots of the tables of a vector, as columns, a part at a time.

        Args:
            slot: of the vector.
            forms: type of the number in each slot of its tables, such as `<i8`; 0 where left out.
        """
        start, count = self.vector(slot)
        data = np.frombuffer(self.data, np.uint8)
        if start + 4 * count > len(data):
            raise FileFormatError("a list reaches past the end of its table")
        for first in range(start, start + 4 * count, 4 * PART_TABLES):
            entries = np.arange(first, min(first + 4 * PART_TABLES, start + 4 * count), 4)
            places = entries + _numbers("<u4", data, entries)
            vtables = places - _numbers("<i4", data, places)
            sizes = _numbers("<u2", data, vtables)
            if places.min() < start + 4 * count or sizes.min() < 4:
                raise FileFormatError("a list holds what is no table")
            if len(np.unique(places)) < len(places):
                raise FileFormatError("a list holds the same table twice")
            columns = []
            for number, form in enumerate(forms):
                column = np.zeros(len(places), form)
                entry = 4 + 2 * number
                rows = np.flatnonzero(sizes >= entry + 2)
                offsets = _numbers("<u2", data, vtables[rows] + entry)
                rows, offsets = rows[offsets > 0], offsets[offsets > 0]
                column[rows] = _numbers(form, data, places[rows] + offsets)
                columns.append(column)
            yield columns


PART_TABLES = 1 << 16
"""Tables that are read at once."""


def _numbers(form: str, data: NDArray[np.uint8], places: NDArray[np.int64]) -> NDArray[Any]:
    """The numbers of a type at each place."""
    size = np.dtype(form).itemsize
    if len(places) and (places.min() < 0 or places.max() + size > len(data)):
        raise FileFormatError("an offset points outside of its table")
    numbers: NDArray[Any] = data[places[:, None] + np.arange(size)].view(form)
    return numbers[:, 0]


def _number(form: str, data: bytes | memoryview, position: int) -> int:
    # struct counts negative positions from the end.
    if position < 0:
        raise FileFormatError(f"an offset points {-position} bytes before its table")
    try:
        value: int = struct.unpack_from(form, data, position)[0]
    except struct.error as error:
        raise FileFormatError("an offset points past the end of its table") from error
    return value


EVENT = np.dtype(
    {
        "names": ["t", "x", "y", "p"],
        "formats": ["<i8", "<i2", "<i2", "u1"],
        "offsets": [0, 8, 10, 12],
        "itemsize": 16,
    }
)
EVENTS_START = 32
"""Events lie here in a packet: a multiple of 8, as FlatBuffers demands for i8."""
UNKNOWN = -1
"""Position of the list while there is none."""

_ENTRY = np.dtype(
    {
        "names": ["vtable", "position", "stream", "bytes", "events", "first", "last"],
        "formats": ["<i4", "<i8", "<i4", "<i4", "<i8", "<i8", "<i8"],
        "offsets": [0, 4, 12, 16, 20, 28, 36],
        "itemsize": 48,
    }
)
_ENTRY_VTABLE = struct.pack("<7H", 14, 44, 4, 12, 20, 28, 36)


class PacketEntry(NamedTuple):
    """One line of the list of packets."""

    position: int
    """First byte after the packet's head, in the file."""
    bytes: int
    """Length of the packet without its head."""
    events: int
    """Number of events."""
    first: int
    """Time of the first event, µs; `last`: of the last."""
    last: int


@dataclass(frozen=True)
class StreamInfo:
    """Header entry of one stream."""

    number: int
    identifier: str
    """Type: EVTS for events, FRME for frames, IMUS, TRIG."""
    attributes: Mapping[str, str]
    """`sizeX`, `sizeY`, `source` and others."""


def make_header(compression: int, list_position: int, xml: bytes) -> bytes:
    """The file header, size-prefixed; its length depends on the XML only."""
    text = struct.pack("<I", len(xml)) + xml + b"\0"
    text += bytes(-len(text) % 8)
    vtable = struct.pack("<5H", 10, 20, 12, 4, 16)
    table = struct.pack("<iqiI", 16, list_position, compression, 4)
    body = struct.pack("<I4s", 24, b"IOHE") + vtable + bytes(6) + table + text
    return struct.pack("<I", len(body)) + body


def make_events(columns: Mapping[str, NDArray[Any]]) -> bytes:
    """The events of a packet, size-prefixed."""
    count = len(columns["t"])
    events = np.zeros(count, dtype=EVENT)
    for name in "txyp":
        events[name] = columns[name]
    return _vector_head(b"EVTS", count, count * EVENT.itemsize) + events.tobytes()


def make_list(entries: Sequence[PacketEntry], stream: int) -> bytes:
    """The list of packets, size-prefixed."""
    count = len(entries)
    offsets_end = EVENTS_START + 4 * count
    vtable_at = offsets_end + offsets_end % 4
    start = vtable_at + len(_ENTRY_VTABLE)
    # Numbers of 8 bytes follow 4 bytes after the start of each entry.
    start += (4 - start) % 8
    table = np.zeros(count, dtype=_ENTRY)
    places = start + _ENTRY.itemsize * np.arange(count, dtype=np.int64)
    table["vtable"] = places - vtable_at
    table["stream"] = stream
    for name in PacketEntry._fields:
        table[name] = [getattr(entry, name) for entry in entries]
    offsets = (places - (EVENTS_START + 4 * np.arange(count))).astype("<u4").tobytes()
    gap = bytes(start - vtable_at - len(_ENTRY_VTABLE))
    rest = offsets + bytes(vtable_at - offsets_end) + _ENTRY_VTABLE + gap + table.tobytes()
    return _vector_head(b"FTAB", count, len(rest)) + rest


def read_events(data: bytes | memoryview) -> NDArray[Any]:
    """Events of an uncompressed packet, as records of type `EVENT`.

    Raises:
        FileFormatError: the packet is damaged.
    """
    start, count = Table.root(data, b"EVTS").vector(0)
    if start + count * EVENT.itemsize > len(data):
        raise FileFormatError(f"a packet states {count} events, more than it holds")
    return np.frombuffer(data, dtype=EVENT, count=count, offset=start)


def make_info(size: tuple[int, int], compression: str, metadata_json: str) -> bytes:
    """The header's XML: one stream of events."""
    root = ElementTree.Element("dv", version="2.0")
    streams = _add_node(root, "outInfo", "/mainloop/Recorder/outInfo/")
    stream = _add_node(streams, "0", "/mainloop/Recorder/outInfo/0/")
    for key, value in (
        ("compression", compression),
        ("originalModuleName", "texvent"),
        ("originalOutputName", "events"),
        ("typeDescription", "Array of events (polarity ON/OFF)."),
        ("typeIdentifier", "EVTS"),
    ):
        _add_attribute(stream, key, "string", value)
    info = _add_node(stream, "info", "/mainloop/Recorder/outInfo/0/info/")
    _add_attribute(info, "sizeX", "int", str(size[0]))
    _add_attribute(info, "sizeY", "int", str(size[1]))
    _add_attribute(info, "source", "string", "texvent")
    _add_attribute(info, "texvent", "string", metadata_json)
    xml: bytes = ElementTree.tostring(root, encoding="us-ascii")
    return xml


def read_info(path: Path, xml: bytes) -> list[StreamInfo]:
    """The streams that a header names.

    Raises:
        FileFormatError: the XML is damaged, or defines entities (which can grow without bound).
    """
    if b"<!" in xml:
        raise FileFormatError(f"{path}: its header is XML with declarations, which is refused")
    try:
        root = ElementTree.fromstring(xml)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise FileFormatError(f"{path}: its header is damaged XML ({one_line(error)})") from error
    streams = []
    for node in root.findall("./node[@name='outInfo']/node"):
        attributes = _attributes(node)
        info = node.find("./node[@name='info']")
        number = node.get("name", "")
        if not number.isdecimal() or len(number) > 9:
            raise FileFormatError(f"{path}: its header names a stream {number[:20]!r}")
        inner = {} if info is None else _attributes(info)
        streams.append(
            StreamInfo(int(number), attributes.get("typeIdentifier", ""), {**attributes, **inner})
        )
    return streams


def _vector_head(identifier: bytes, count: int, rest: int) -> bytes:
    """A root table with one vector, up to the vector's first element at `EVENTS_START`."""
    return struct.pack(
        "<II4s3HHiII", EVENTS_START - 4 + rest, 16, identifier, 6, 8, 4, 0, 8, 4, count
    )


def _add_node(parent: ElementTree.Element, name: str, path: str) -> ElementTree.Element:
    return ElementTree.SubElement(parent, "node", name=name, path=path)


def _add_attribute(parent: ElementTree.Element, key: str, kind: str, value: str) -> None:
    ElementTree.SubElement(parent, "attr", key=key, type=kind).text = value


def _attributes(node: ElementTree.Element) -> dict[str, str]:
    return {one.get("key", ""): one.text or "" for one in node.findall("attr")}
