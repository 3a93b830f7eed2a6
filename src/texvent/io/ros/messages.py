"""The two ROS messages that hold events, packed and unpacked as whole arrays.

    dvs_msgs/EventArray (ROS 1): header · u32 height · u32 width · u32 n · n records of 13 bytes:
        u16 x · u16 y · u32 s · u32 ns · bool polarity
    event_camera_msgs/EventPacket (ROS 2, CDR): header · u32 height · u32 width · u64 seq ·
        u64 time_base · string encoding · bool is_bigendian · bytes, here EVT3

Generic (de)serialisers take two microseconds per event; these take a hundredth of it.

Source: rpg_dvs_ros and event_camera_msgs, message definitions; OMG, DDS-XTypes (CDR).
"""

from __future__ import annotations

import bz2
import struct
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import lz4.frame
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown
from texvent.io.protocol import Columns
from texvent.sensor import SensorSize

EVENT_ARRAY = "dvs_msgs/msg/EventArray"
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
FRAME = "dvs"
"""Coordinate frame in the messages' headers."""
EVT3 = "evt3"
"""Name of the encoding of events in an EventPacket."""
MICROSECONDS = 1_000_000
NS = 1000
NS_PER_S = 1_000_000_000
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


def open_event_array(data: bytes) -> RawMessage:
    """The parts of a serialised dvs_msgs/EventArray.

    Raises:
        FileFormatError: the message is damaged.
    """
    try:
        frame_bytes = struct.unpack_from("<I", data, 12)[0]
        start = 16 + frame_bytes
        height, width, count = struct.unpack_from("<3I", data, start)
    except struct.error as error:
        raise FileFormatError("a message of events is cut off") from error
    payload = memoryview(data)[start + 12 :]
    if len(payload) != count * _RECORD.itemsize:
        raise FileFormatError(f"a message states {count} events in {len(payload)} bytes")
    return RawMessage(SensorSize(width, height), payload)


def unpack_event_array(message: RawMessage) -> dict[str, NDArray[Any]]:
    """Columns x, y, t, p; ns that are no whole µs are rounded down."""
    records = np.frombuffer(message.payload, dtype=_RECORD)
    t = records["s"].astype(np.int64) * MICROSECONDS + records["ns"] // NS
    return {"x": records["x"], "y": records["y"], "t": t, "p": records["p"]}


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


def open_event_packet(data: bytes) -> RawMessage:
    """The parts of a serialised event_camera_msgs/EventPacket.

    Raises:
        FileFormatError: the message is damaged, or not of EVT3 words.
    """
    if data[:2] != b"\0\1":
        raise FileFormatError("a message is not little-endian CDR, which texvent reads")
    body = memoryview(data)[4:]
    try:
        place = 8
        place += 4 + struct.unpack_from("<I", body, place)[0]
        place += -place % 4
        height, width = struct.unpack_from("<2I", body, place)
        place += 8
        place += -place % 8 + 16
        length = struct.unpack_from("<I", body, place)[0]
        encoding = bytes(body[place + 4 : place + 4 + min(length, 32)]).rstrip(b"\0")
        place += 4 + length + 1
        place += -place % 4
        count = struct.unpack_from("<I", body, place)[0]
    except struct.error as error:
        raise FileFormatError("a message of events is cut off") from error
    if encoding != EVT3.encode():
        raise FileFormatError(f"a message is encoded as {shown(encoding)}; texvent reads evt3")
    payload = body[place + 4 : place + 4 + count]
    if len(payload) != count or count % 2:
        raise FileFormatError(f"a message states {count} bytes of events; it is damaged")
    return RawMessage(SensorSize(width, height), payload)


def _text(text: bytes) -> bytes:
    """A CDR string: its length, the text, a zero byte."""
    return struct.pack("<I", len(text) + 1) + text + b"\0"


MAX_CHUNK_BYTES = 256 * 2**20
"""ROS writes chunks of less than a megabyte."""


def bound_chunks(bag: Any) -> None:
    """Let rosbags' reader of an open ROS 1 bag unpack no chunk beyond `MAX_CHUNK_BYTES`."""
    bounded = {bz2.decompress: bz2.BZ2Decompressor, lz4.frame.decompress: _lz4_decompressor}
    for position, chunk in bag.chunks.items():
        make = bounded.get(chunk.decompressor)
        if make is not None:
            bag.chunks[position] = chunk._replace(decompressor=partial(_unpack, make))


def _lz4_decompressor() -> Any:
    return lz4.frame.LZ4FrameDecompressor()


def _unpack(make: Callable[[], Any], data: bytes) -> bytes:
    decompressor = make()
    unpacked: bytes = decompressor.decompress(data, max_length=MAX_CHUNK_BYTES)
    if not decompressor.eof:
        raise FileFormatError(
            f"a chunk ends early or unpacks to more than {MAX_CHUNK_BYTES} bytes; the bag is "
            "damaged, or made to fill the memory"
        )
    return unpacked
