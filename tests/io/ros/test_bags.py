"""Bags of other programs: both ROS, all messages and encodings, several cameras, folders."""

import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.io.files import load
from texvent.io.reading import SeveralRecordingsError
from texvent.io.ros.bag_writer import message_types
from texvent.io.ros.messages import (
    DV_ARRAY,
    EVENT_ARRAY,
    EVENT_ARRAY_TEXT,
    EVENT_PACKET,
    EVENT_PACKET_TEXT,
    EVENT_TEXT,
    OLD_PACKET,
    PACKETS,
    PROPHESEE_ARRAY,
    RawMessage,
    unpack_libcaer_cmp,
)
from texvent.sensor import SensorSize

SIZE = SensorSize(9, 7)
EVENTS = EventStream.from_columns([3, 4, 8], [5, 6, 0], [70, 80, 3_000_081], [1, 0, 1], size=SIZE)


def types_of(version: int) -> Any:
    from rosbags.typesys import get_types_from_msg

    types = message_types(version)
    for kind, text in (
        ("dvs_msgs/msg/Event", EVENT_TEXT),
        (EVENT_ARRAY, EVENT_ARRAY_TEXT),
        (EVENT_PACKET, EVENT_PACKET_TEXT),
        (OLD_PACKET, EVENT_PACKET_TEXT),
        ("prophesee_event_msgs/msg/Event", EVENT_TEXT),
        (PROPHESEE_ARRAY, EVENT_ARRAY_TEXT.replace("dvs_msgs", "prophesee_event_msgs")),
        ("dv_ros_msgs/msg/Event", EVENT_TEXT),
        (DV_ARRAY, EVENT_ARRAY_TEXT.replace("dvs_msgs", "dv_ros_msgs")),
    ):
        if kind not in types.types:
            types.register(get_types_from_msg(text, kind))
    return types


def header(types: Any, version: int) -> Any:
    time = types.types["builtin_interfaces/msg/Time"](1, 2)
    number = {} if version == 2 else {"seq": 0}
    return types.types["std_msgs/msg/Header"](stamp=time, frame_id="cam", **number)


def array_message(types: Any, kind: str, version: int, count: int) -> Any:
    """The first events as an EventArray, made by rosbags' own serialiser."""
    one, time = types.types[kind.replace("Array", "")], types.types["builtin_interfaces/msg/Time"]
    rows = zip(EVENTS.x.tolist(), EVENTS.y.tolist(), EVENTS.t.tolist(), EVENTS.p, strict=True)
    events = [
        one(x, y, time(t // 10**6, t % 10**6 * 1000 + 999), bool(p))
        for x, y, t, p in list(rows)[:count]
    ]
    return types.types[kind](header(types, version), SIZE.height, SIZE.width, events)


def packet_message(
    types: Any,
    version: int,
    encoding: str,
    payload: bytes,
    base_ns: int = 0,
    *,
    kind: str = EVENT_PACKET,
    size: tuple[int, int] = SIZE,
    is_big_endian: bool = False,
) -> Any:
    data = np.frombuffer(payload, np.uint8)
    width, height = size
    head = header(types, version)
    return types.types[kind](head, height, width, 0, base_ns, encoding, is_big_endian, data)


def write_bag(path: Path, version: int, messages: dict[str, tuple[str, list[Any]]]) -> Path:
    from rosbags import rosbag1, rosbag2

    types = types_of(version)
    pack = types.serialize_ros1 if version == 1 else types.serialize_cdr
    writer = rosbag1.Writer(path) if version == 1 else rosbag2.Writer(path, version=9)
    with writer as bag:
        for topic, (kind, sent) in messages.items():
            connection = bag.add_connection(topic, kind, typestore=types)
            for number, message in enumerate(sent):
                packed = message if isinstance(message, bytes) else pack(message, kind)
                bag.write(connection, number, packed)
    return path


@pytest.mark.long
@pytest.mark.parametrize("kind", [EVENT_ARRAY, PROPHESEE_ARRAY, DV_ARRAY])
@pytest.mark.parametrize(("version", "name"), [(1, "a.bag"), (2, "folder")])
def test_arrays_of_both_versions_are_read(tmp_path, kind, version, name):
    types = types_of(version)
    for count in range(4):
        message = array_message(types, kind, version, count)
        path = write_bag(tmp_path / f"{count}{name}", version, {"/e": (kind, [message])})
        assert load(path).equals(EVENTS[:count])
        if version == 2:
            (file,) = path.glob("*.db3")
            assert load(file).equals(EVENTS[:count])
            assert load(file.rename(tmp_path / f"{count}.dat")).equals(EVENTS[:count])


MONO = struct.pack("<2Q", 1 << 63 | 5 << 48 | 3 << 32 | 9, 6 << 48 | 4 << 32 | 10_999)
CAER = struct.pack("<IiIi", 3 << 17 | 5 << 2 | 1 << 1 | 1, 2**31 - 11, 4 << 17 | 6 << 2 | 1, 0)


CAER_CMP = struct.pack("<8H", 0x1046, 0x2003, 0x3805, 0x0001, 0x1006, 0x2004, 0x4002, 0x5010)


@pytest.mark.long
@pytest.mark.parametrize("kind", PACKETS)
@pytest.mark.parametrize("version", [1, 2])
@pytest.mark.parametrize(
    ("encoding", "payload", "base_ns", "times"),
    [
        ("mono", MONO, 70_000, [70, 80]),
        ("mono", MONO, 70_995, [71, 81]),
        ("libcaer", CAER, 10_000, [2**31 - 1, 2**31 + 10]),
        ("libcaer_cmp", CAER_CMP, 5_000_999, [5070, 5000 + 4096 + 6]),
        ("evt3", struct.pack("<6H", 0x8000, 0x6046, 5, 0x2803, 0x6050, 6), 0, [70]),
    ],
)
def test_packets_of_every_encoding_are_read(
    tmp_path, kind, version, encoding, payload, base_ns, times
):
    message = packet_message(types_of(version), version, encoding, payload, base_ns, kind=kind)
    name = "a.bag" if version == 1 else "folder"
    events = load(write_bag(tmp_path / name, version, {"/e": (kind, [message])}))
    assert events.t.tolist() == times
    assert (events.x.tolist(), events.y.tolist()) == ([3, 4][: len(times)], [5, 6][: len(times)])
    assert events.p.tolist() == [1, 0][: len(times)]


def slow_libcaer_cmp(words: list[int], base_us: int) -> list[tuple[int, int, int, int]]:
    """One word after the other: x, y, t, p of each event."""
    high = low = column = row = sign = 0
    found = []
    for word in words:
        kind, value = word >> 12, word & 0xFFF
        high, low = value if kind == 0 else high, value if kind == 1 else low
        column = value & 0x7FF if kind == 2 else column
        time = base_us + (high << 12 | low)
        if kind == 3:
            found.append((column, value & 0x7FF, time, value >> 11))
        if kind == 4:
            row, sign = value & 0x7FF, value >> 11
        if kind == 5:
            found += [(column, row + at, time, sign) for at in range(8) if value >> at & 1]
            row += 8
    return found


@given(
    words=st.lists(
        st.builds(lambda kind, value: kind << 12 | value, st.integers(0, 5), st.integers(0, 0xFFF))
    )
)
def test_libcaer_cmp_of_any_words_is_that_of_the_slow_decoder(words):
    words = [0x4000, *words]
    payload = memoryview(struct.pack(f"<{len(words)}H", *words))
    columns = unpack_libcaer_cmp(RawMessage(SIZE, payload, "libcaer_cmp", 7_000))
    rows = list(zip(*(columns[name].tolist() for name in "xytp"), strict=True))
    assert rows == slow_libcaer_cmp(words, 7)


def test_a_size_that_is_not_said_is_asked_for_and_may_not_change(tmp_path):
    types = types_of(2)
    sizes: dict[str, list[tuple[int, int]]] = {"a": [(0, 0), (0, 0)], "b": [(0, 0), SIZE]}
    for name, said in {**sizes, "c": [SIZE, (8, 7)]}.items():
        sent = [
            packet_message(types, 2, "mono", MONO, at * 10**6, size=one)
            for at, one in enumerate(said)
        ]
        write_bag(tmp_path / name, 2, {"/e": (EVENT_PACKET, sent)})
    with pytest.raises(InputError, match="does not store the sensor size"):
        load(tmp_path / "a")
    assert load(tmp_path / "a", size=SIZE).equals(load(tmp_path / "b"))
    with pytest.raises(FileFormatError, match="sensor of /e changes from 9x7 to 8x7"):
        load(tmp_path / "c")


def test_one_of_several_cameras_is_chosen(tmp_path):
    types = types_of(1)
    left, right = (array_message(types, EVENT_ARRAY, 1, count) for count in (1, 2))
    bag = {"/left/events": (EVENT_ARRAY, [left]), "/right/events": (EVENT_ARRAY, [right])}
    path = write_bag(tmp_path / "stereo.bag", 1, bag)
    with pytest.raises(SeveralRecordingsError, match="2 recordings: /left/events, /right/events"):
        load(path)
    for name in ("/right/events", "right/events", "1"):
        assert load(path, stream=name).equals(EVENTS[:2])
    with pytest.raises(InputError, match="has no stream 'top'; allowed: /left/events, /right"):
        load(path, stream="top")


def test_another_encoding_and_a_bag_without_events_are_named(tmp_path):
    types = types_of(2)
    refused = {
        "encoded as 'zip'; texvent reads evt3, mono, libcaer, libcaer_cmp": ("zip", b"", False),
        "'trigger', which holds external signals and no events": ("trigger", b"", False),
        "the events of a message are big-endian": ("mono", MONO, True),
        "a word of type 6": ("libcaer_cmp", b"\0\x60", False),
    }
    for number, (text, (encoding, payload, is_big_endian)) in enumerate(refused.items()):
        message = packet_message(types, 2, encoding, payload, is_big_endian=is_big_endian)
        path = write_bag(tmp_path / f"{number}", 2, {"/e": (EVENT_PACKET, [message])})
        with pytest.raises(FileFormatError, match=text):
            load(path)
    text = types_of(1).types["std_msgs/msg/String"]("x")
    path = write_bag(tmp_path / "b.bag", 1, {"/t": ("std_msgs/msg/String", [text])})
    with pytest.raises(FileFormatError, match=r"no messages of events .*; it has std_msgs/msg/Str"):
        load(path)
