"""The ROS messages that hold events, packed and unpacked as whole arrays.

    EventArray of dvs_msgs, prophesee_event_msgs and dv_ros_msgs: header · u32 height · u32 width ·
        u32 n · n records: u16 x · u16 y · u32 s · u32 ns · bool polarity
    event_camera_msgs/EventPacket and event_array_msgs/EventArray: header · u32 height · u32 width ·
        u64 seq · u64 time_base · string encoding · bool is_bigendian · bytes
    encodings   evt3: words, whose clock counts ·
                mono: u64 p<<63 | y<<48 | x<<32 | ns after the base ·
                libcaer: u32 x<<17 | y<<2 | p<<1, i32 µs after the base ·
                libcaer_cmp: u16 words, each a change: 15..12 type, 11..0 value

     0 TIME_HIGH    bits 23..12 of the µs after the base · 1 TIME_LOW  bits 11..0
     2 ADDR_X       column of the events that follow, bits 10..0
     3 ADDR_Y       one event: polarity bit 11, row bits 10..0
     4 VECT_BASE_Y  polarity and row of the next vector word
     5 VECT_8       bit i set: an event at row + i; then row += 8

In ROS 1 fields follow one another, and the header begins with a number; in ROS 2 (CDR) each is
aligned to its size, so that records take 16 bytes, the first two fewer. Generic (de)serialisers
take two microseconds per event; these take a hundredth of it.

Source: rpg_dvs_ros, prophesee_ros_wrapper and event_camera_msgs, message definitions;
event_camera_codecs; OMG, DDS-XTypes (CDR).
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown
from texvent.io.block_writer import Columns
from texvent.io.clocks import TurningClock
from texvent.sensor import SensorSize

EVENT_ARRAY = "dvs_msgs/msg/EventArray"
PROPHESEE_ARRAY = "prophesee_event_msgs/msg/EventArray"
DV_ARRAY = "dv_ros_msgs/msg/EventArray"
EVENT_ARRAY_TEXT = """std_msgs/Header header
uint32 height
uint32 width
dvs_msgs/Event[] events
"""
EVENT_TEXT = """uint16 x
uint16 y
time ts
bool polarity
"""
EVENT_PACKET = "event_camera_msgs/msg/EventPacket"
EVENT_PACKET_TEXT = """std_msgs/Header header
uint32 height
uint32 width
uint64 seq
uint64 time_base
string encoding
bool is_bigendian
uint8[] events
"""
OLD_PACKET = "event_array_msgs/msg/EventArray"
"""Former name of EventPacket, with the same fields."""
PACKETS = (EVENT_PACKET, OLD_PACKET)
EVENT_MESSAGES = (EVENT_ARRAY, PROPHESEE_ARRAY, DV_ARRAY, *PACKETS)
"""Types of messages that hold events."""
ENCODINGS = {"evt3": 2, "mono": 8, "libcaer": 8, "libcaer_cmp": 2}
"""Encoding of a packet → bytes of a word."""
FRAME = "dvs"
"""Coordinate frame in the messages' headers."""
EVT3 = "evt3"
"""Name of the encoding of events in an EventPacket."""
MICROSECONDS = 1_000_000
NS = 1000
NS_PER_S = 1_000_000_000
_RECORD_2 = np.dtype(
    {
        "names": ["x", "y", "s", "ns", "p"],
        "formats": ["<u2", "<u2", "<u4", "<u4", "u1"],
        "offsets": [0, 2, 6, 10, 14],
        "itemsize": 16,
    }
)
"""A record of ROS 2 that begins two bytes after a multiple of four, as all but the first."""
TIME_BITS = 31
"""Bits of libcaer's clock, whose turns before a message are in its base."""
_RECORD = np.dtype([("x", "<u2"), ("y", "<u2"), ("s", "<u4"), ("ns", "<u4"), ("p", "u1")])


@dataclass(frozen=True)
class EventPacket:
    """The fields of an event_camera_msgs/EventPacket of EVT3 words."""

    stamp_ns: int
    """ROS time of the first event, ns."""
    frame: str
    """Coordinate frame."""
    size: SensorSize
    sequence: int
    time_base_ns: int
    """ROS time at which the clock of the words is 0, ns, modulo 2^64."""
    payload: bytes
    """EVT3 words."""


@dataclass(frozen=True)
class RawMessage:
    """A message before its events are unpacked."""

    size: SensorSize
    payload: memoryview
    """The events' bytes."""
    encoding: str
    """`records`, `records-2` of ROS 2, or what a packet names: evt3, mono, libcaer."""
    time_base_ns: int = 0


def pack_event_array(columns: Columns, size: SensorSize, sequence: int) -> bytes:
    """A serialised dvs_msgs/EventArray; its time is the first event's."""
    t = columns["t"]
    records = np.empty(len(t), dtype=_RECORD)
    for name in "xyp":
        records[name] = columns[name]
    records["s"], rest = t // MICROSECONDS, t % MICROSECONDS
    records["ns"] = rest * NS
    head = struct.pack(
        "<4I3s3I",
        sequence,
        int(records["s"][0]),
        int(records["ns"][0]),
        len(FRAME),
        FRAME.encode(),
        size.height,
        size.width,
        len(records),
    )
    return head + records.tobytes()


class MessageFields:
    """Reader of the fields of a serialised message in their order."""

    def __init__(self, data: bytes, version: int) -> None:
        if version == 2 and data[:2] != b"\0\1":
            raise FileFormatError("a message is not little-endian CDR, which texvent reads")
        self.body = memoryview(data)[4 if version == 2 else 0 :]
        self._is_aligned = version == 2
        self.place = 0

    def number(self, form: str) -> int:
        """A number of a struct format, such as `I`."""
        size = struct.calcsize(form)
        if self._is_aligned:
            self.place += -self.place % size
        value: int = struct.unpack_from(f"<{form}", self.body, self.place)[0]
        self.place += size
        return value

    def text(self) -> bytes:
        """A string, without the zero byte that CDR puts at its end."""
        length = self.number("I")
        self.place += length
        return bytes(self.body[self.place - length : self.place][:32]).rstrip(b"\0")

    def header(self) -> int:
        """Time of a std_msgs/Header, ns."""
        *_, seconds, rest = (self.number(form) for form in ("iI" if self._is_aligned else "III"))
        self.text()
        return seconds * NS_PER_S + rest

    def data(self) -> memoryview:
        """A list of bytes.

        Raises:
            FileFormatError: it ends too early.
        """
        count = self.number("I")
        found = self.body[self.place : self.place + count]
        if len(found) != count:
            raise FileFormatError(f"a message states {count} bytes of data; it is damaged")
        return found


def open_message(kind: str, data: bytes, version: int) -> RawMessage:
    """The parts of a serialised message of events.

    Raises:
        FileFormatError: the message is damaged, or its encoding is not read.
    """
    try:
        fields = MessageFields(data, version)
        fields.header()
        height, width = fields.number("I"), fields.number("I")
        if kind not in PACKETS:
            return _open_records(fields, SensorSize(width, height), version)
        fields.number("Q")
        time_base_ns = fields.number("Q")
        encoding = fields.text().decode("latin-1")
        is_big_endian = fields.number("B")
        count = fields.number("I")
    except struct.error as error:
        raise FileFormatError("a message of events is cut off") from error
    if encoding not in ENCODINGS:
        allowed = ", ".join(ENCODINGS)
        what = ", which holds external signals and no events" if encoding == "trigger" else ""
        raise FileFormatError(
            f"a message is encoded as {shown(encoding)}{what}; texvent reads {allowed}"
        )
    if is_big_endian:
        raise FileFormatError("the events of a message are big-endian; texvent reads little-endian")
    payload = fields.body[fields.place : fields.place + count]
    if len(payload) != count or count % ENCODINGS[encoding]:
        raise FileFormatError(f"a message states {count} bytes of events; it is damaged")
    return RawMessage(SensorSize(width, height), payload, encoding, time_base_ns)


def _open_records(fields: MessageFields, size: SensorSize, version: int) -> RawMessage:
    count = fields.number("I")
    payload = fields.body[fields.place :]
    wanted = count * _RECORD.itemsize
    if version == 2:
        # Up to the last byte of the last record, which ends before the padding.
        wanted = max(count * _RECORD_2.itemsize - 3, 0)
    if not wanted <= len(payload) < wanted + 4:
        raise FileFormatError(f"a message states {count} events in {len(payload)} bytes")
    if version == 1:
        return RawMessage(size, payload[:wanted], "records")
    # The first record is aligned otherwise: moved up, it is as the others.
    first = bytes(payload[:4]) + bytes(2) + bytes(payload[4:13]) + bytes(1)
    moved = memoryview(first + bytes(payload[14:wanted]) + bytes(2))
    return RawMessage(size, moved[: count * _RECORD_2.itemsize], "records-2")


def unpack_records(message: RawMessage) -> dict[str, NDArray[Any]]:
    """Columns x, y, t, p of an EventArray; ns that are no whole µs are rounded down."""
    kind = _RECORD if message.encoding == "records" else _RECORD_2
    records = np.frombuffer(message.payload, dtype=kind)
    t = records["s"].astype(np.int64) * MICROSECONDS + records["ns"] // NS
    return {"x": records["x"], "y": records["y"], "t": t, "p": records["p"]}


def unpack_mono(message: RawMessage) -> dict[str, NDArray[Any]]:
    """Columns x, y, t, p of a packet of mono's words."""
    words = np.frombuffer(message.payload, "<u8")
    t = (message.time_base_ns + (words & 0xFFFFFFFF).astype(np.int64)) // NS
    x, y = (words >> 32 & 0xFFFF).astype(np.uint16), (words >> 48 & 0x7FFF).astype(np.uint16)
    return {"x": x, "y": y, "t": t, "p": (words >> 63).astype(np.uint8)}


def unpack_libcaer(message: RawMessage) -> dict[str, NDArray[Any]]:
    """Columns x, y, t, p of a packet of libcaer's events."""
    words = np.frombuffer(message.payload, [("place", "<u4"), ("t", "<i4")])
    t = message.time_base_ns // NS + TurningClock(TIME_BITS).unroll(words["t"])
    place = words["place"]
    x, y = (place >> 17 & 0x7FFF).astype(np.uint16), (place >> 2 & 0x7FFF).astype(np.uint16)
    return {"x": x, "y": y, "t": t, "p": (place >> 1 & 1).astype(np.uint8)}


TIME_HIGH, TIME_LOW, ADDR_X, ADDR_Y, VECT_BASE_Y, VECT_8 = range(6)


def unpack_libcaer_cmp(message: RawMessage) -> dict[str, NDArray[Any]]:
    """Columns x, y, t, p of a packet of libcaer_cmp's words; each packet begins anew.

    Raises:
        FileFormatError: a word of another type.
    """
    words = np.frombuffer(message.payload, "<u2").astype(np.int64)
    kinds, values = words >> 12, words & 0xFFF
    if (kinds > VECT_8).any():
        raise FileFormatError(f"a message has a word of type {int(kinds.max())} (libcaer_cmp)")
    bits = (values[:, None] >> np.arange(8) & 1) * (kinds == VECT_8)[:, None]
    bits[:, 0] |= kinds == ADDR_Y
    at, row = np.nonzero(bits)
    column, base, high, low = (
        _latest(values, kinds == kind, at) for kind in (ADDR_X, VECT_BASE_Y, TIME_HIGH, TIME_LOW)
    )
    vectors = np.cumsum(kinds == VECT_8)
    row += 8 * (vectors[at] - 1 - _latest(vectors, kinds == VECT_BASE_Y, at))
    is_single = kinds[at] == ADDR_Y
    place = np.where(is_single, values[at], base)
    return {
        "x": column & 0x7FF,
        "y": (place & 0x7FF) + np.where(is_single, 0, row),
        "t": message.time_base_ns // NS + (high << 12 | low),
        "p": place >> 11,
    }


def _latest(
    values: NDArray[np.int64], is_source: NDArray[np.bool_], at: NDArray[np.intp]
) -> NDArray[np.int64]:
    """The values at the last sources up to each place, 0 before the first."""
    places = np.maximum.accumulate(np.where(is_source, np.arange(len(values)), -1))[at]
    return np.where(places >= 0, values[places], 0)


def pack_event_packet(packet: EventPacket) -> bytes:
    """A serialised event_camera_msgs/EventPacket."""
    size = packet.size
    head = struct.pack("<iI", *divmod(packet.stamp_ns, NS_PER_S))
    head += _text(packet.frame.encode("utf-8"))
    head += bytes(-len(head) % 4) + struct.pack("<2I", size.height, size.width)
    head += bytes(-len(head) % 8) + struct.pack("<2Q", packet.sequence, packet.time_base_ns)
    head += _text(EVT3.encode()) + b"\0"
    head += bytes(-len(head) % 4) + struct.pack("<I", len(packet.payload))
    return b"\0\1\0\0" + head + packet.payload


def _text(text: bytes) -> bytes:
    """A CDR string: its length, the text, a zero byte."""
    return struct.pack("<I", len(text) + 1) + text + b"\0"
