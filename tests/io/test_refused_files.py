"""Files just outside of a format are refused by name and number, those just inside are read."""

import functools
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.io.ros.test_bags import EVENTS, MONO, array_message, packet_message, types_of, write_bag
from tests.io.test_corpus import CORPUS

from texvent.errors import FileFormatError
from texvent.io.aedat import aedat4_tables
from texvent.io.aedat.aedat4_container import LZ4_CODE, MAGIC, PACKET_HEAD, pack_lz4
from texvent.io.files import load
from texvent.io.metadata import MAX_HEADER_BYTES
from texvent.io.ros import bag_bounds
from texvent.io.ros.messages import EVENT_ARRAY, EVENT_PACKET
from texvent.sensor import SensorSize

SIZE = SensorSize(9, 7)
Bytes = Callable[[bytes], bytes]
Options = dict[str, Any]
TO_LOAD: Options = {"size": SIZE}


def cut(length: int) -> Bytes:
    return lambda data: data[:length]


def swap(old: bytes, new: bytes) -> Bytes:
    return lambda data: data.replace(old, new, 1)


def put(place: int, form: str, value: int) -> Bytes:
    """A number of a struct format at a place."""
    size = struct.calcsize(form)
    return lambda data: data[:place] + struct.pack(f"<{form}", value) + data[place + size :]


def aedat4(
    path: Path, code: int = LZ4_CODE, xml: Bytes = bytes, packet: Bytes = bytes, lz4: Bytes = bytes
) -> None:
    content = xml(aedat4_tables.make_info(SIZE, "LZ4", "{}"))
    data = packet(aedat4_tables.make_events(EVENTS.columns()))
    data = data if code == 0 else lz4(pack_lz4(data))
    head = aedat4_tables.make_header(code, aedat4_tables.UNKNOWN, content)
    path.write_bytes(MAGIC + head + PACKET_HEAD.pack(0, len(data)) + data)


def aedat3(
    path: Path, size: str = "9x7", item: int = 8, room: int = 1, count: int = 1,
    more: str = "", sources: tuple[int, ...] = (1,),
) -> None:  # fmt: skip
    head = f"#!AER-DAT3.1\r\n#Size: {size}\r\n{more}#!END-HEADER\r\n".encode()
    body = (struct.pack("<II", 1, 5) + bytes(item - 8)) * count
    numbers = (item, 4, 0, room, count, count)
    heads = (struct.pack("<hhiiiiii", 1, source, *numbers) for source in sources)
    path.write_bytes(head + b"".join(one + body for one in heads))


def es(path: Path, change: Bytes = bytes) -> None:
    path.write_bytes(change((CORPUS / "es" / "e.es").read_bytes()))


def npz(path: Path, text: str = "readme.txt", **changes: Any) -> Options:
    arrays = {**dict.fromkeys("xy", (1, 2)), **dict.fromkeys("tp", (0, 1)), **changes}
    np.savez(path, **{name: one for name, one in arrays.items() if one is not None})
    with zipfile.ZipFile(path, "a") as file:
        file.writestr(text, "no array")
    return TO_LOAD


def esim(path: Path, name: str = "0000000000.npz", kind: type = np.int64) -> Options:
    path.mkdir()
    with (path / name).open("wb") as file:
        np.savez(file, x=[1, 2], y=[1, 2], t=np.array([0, 1000], kind), p=[0, 1])
    return {**TO_LOAD, "format": "esim"}


@functools.cache
def message(kind: str, version: int) -> bytes:
    types = types_of(version)
    packed = types.serialize_ros1 if version == 1 else types.serialize_cdr
    if kind == EVENT_PACKET:
        return bytes(packed(packet_message(types, version, "mono", MONO), kind))
    return bytes(packed(array_message(types, kind, version, 3), kind))


def ros1(path: Path, change: Bytes = bytes, kind: str = EVENT_ARRAY) -> None:
    write_bag(path, 1, {"/e": (kind, [change(message(kind, 1))])})


def ros2(path: Path, change: Bytes = bytes, facts: Bytes = bytes, stored: Bytes = bytes) -> None:
    write_bag(path, 2, {"/e": (EVENT_PACKET, [change(message(EVENT_PACKET, 2))])})
    for file in path.iterdir():
        file.write_bytes((facts if file.suffix == ".yaml" else stored)(file.read_bytes()))


MOST, MOST_FACTS = MAX_HEADER_BYTES, 2**16
COUNT = aedat4_tables.EVENTS_START - 4
PAYLOAD = message(EVENT_PACKET, 2).index(MONO) - 4
ROWS: dict[str, tuple[Callable[..., Options | None], Options, Options, str]] = {
    "a.aedat4": (aedat4, {"code": 5}, {"code": 2}, "compression 5; AEDAT4 knows 0 to 4"),
    "b.aedat4": (aedat4, {"xml": swap(b"<dv", b"<!DOCTYPE a><dv")},
        {"xml": swap(b"<dv", b"<?a b?><dv")}, "XML with declarations, which is refused"),
    "c.aedat4": (aedat4, {"xml": cut(-1)}, {}, r"its header is damaged XML \("),
    "d.aedat4": (aedat4, {"xml": swap(b'name="0"', b'name="0000000000"')},
        {"xml": swap(b'name="0"', b'name="000000000"')}, "header names a stream '0000000000'"),
    "e.aedat4": (aedat4, {"xml": swap(b"EVTS", b"IMUS")}, {}, "holds no stream of events"),
    "f.aedat4": (aedat4, {"xml": swap(b">9<", b">nine<")}, {"xml": swap(b">9<", b">10<")},
        r"its header states no sensor size \(.*'nine'"),
    "g.aedat4": (aedat4, {"packet": put(COUNT, "I", 4)}, {"packet": put(COUNT, "I", 3)},
        r"before byte \d+: a packet states 4 events, more than it holds"),
    "h.aedat4": (aedat4, {"packet": swap(b"EVTS", b"FRME"), "code": 0}, {"code": 0},
        r"before byte \d+: no EVTS table where one must be"),
    "i.aedat4": (aedat4, {"packet": cut(-1)}, {}, "the EVTS table is cut off"),
    "j.aedat4": (aedat4, {"packet": put(4, "I", 10**6)}, {}, "an offset points past the end of"),
    "k.aedat4": (aedat4, {"packet": put(20, "i", 10**6)}, {}, "points 999980 bytes before its"),
    "l.aedat4": (aedat4, {"lz4": put(40, "Q", 0)}, {}, r"a packet is damaged \(LZ4: "),
    "a.aedat": (aedat3, {"size": "9by7"}, {}, "its header states a size of '9by7'"),
    "b.aedat": (aedat3, {"size": "0000000009x7"}, {"size": "000000009x7"}, "'0000000009x7'"),
    "c.aedat": (aedat3, {"item": 12}, {}, "a packet of events of 12 bytes, not 8; it is damaged"),
    "d.aedat": (aedat3, {"count": 2}, {"count": 2, "room": 2}, "a packet of 2 events of 8 bytes"),
    "e.aedat": (aedat3, {"more": f"#{'a' * MOST}\n"}, {"more": f"#{'a' * (MOST - 60)}\n"},
        "its header is longer than 8 MiB"),
    "f.aedat": (aedat3, {"more": "#Format: SerializedTS\r\n"}, {"more": "#Format: RAW\r\n"},
        "format 'SerializedTS', not RAW"),
    "g.aedat": (aedat3, {"sources": (1, 2)}, {"sources": (2, 2)},
        r"events of several cameras \(sources \[1, 2\]\)"),
    "a.es": (es, {"change": put(12, "B", 3)}, {}, "is Event Stream version 3; texvent reads 2"),
    "b.es": (es, {"change": put(15, "B", 2)}, {}, r"type 2 \(atis\); texvent reads type 1 \(dvs"),
    "c.es": (es, {"change": cut(15)}, {}, "ends inside its header; the file was cut off"),
    "d.es": (es, {"change": cut(19)}, {"change": cut(20)}, "ends inside its header; the file was"),
    "a.npz": (npz, {"text": "t"}, {}, "member 't' is not a NumPy array"),
    "b.npz": (npz, {"p": None}, {}, "holds no events by names"),
    "c.npz": (npz, {"y": [0]}, {}, "differ in length"),
    "d.npz": (npz, {"x": [0.5, 1]}, {"x": [0.0, 1]}, "not whole numbers"),
    "e.npz": (npz, {"timestamp_scale_ms": 2.0}, {"timestamp_scale_ms": 1e-3}, "in units of 2"),
    "f.npz": (npz, {"width": "a", "height": 7}, {"width": 9, "height": 7}, "must be whole number"),
    "g.npz": (npz, {"t_offset": [0, 1]}, {"t_offset": [7]}, "t_offset must be one number; it is"),
    "a": (esim, {"name": "000000000.npz"}, {}, r"holds no files 0000000000\.npz"),
    "b": (esim, {"kind": float}, {}, "t is float64; ESIM writes whole nanoseconds"),
    "c": (ros2, {"change": cut(40)}, {}, "a message of events is cut off"),
    "d": (ros2, {"change": cut(-1)}, {}, "a message states 16 bytes of events; it is damaged"),
    "e": (ros2, {"change": put(PAYLOAD, "I", 15)}, {"change": put(PAYLOAD, "I", 8)},
        "a message states 15 bytes of events; it is damaged"),
    "f": (ros2, {"change": put(0, "H", 0)}, {}, "a message is not little-endian CDR, which"),
    "g": (ros2, {"facts": lambda _: b"[]"}, {}, r"holds no facts of a bag \("),
    "h": (ros2, {"facts": lambda data: data.ljust(MOST_FACTS + 1, b"#")},
        {"facts": lambda data: data.ljust(MOST_FACTS, b"#")}, f"is longer than {MOST_FACTS} byte"),
    "i": (ros2, {"stored": cut(2048)}, {}, r"is damaged or not a bag \("),
    "a.bag": (ros1, {"change": cut(-1)}, {}, "a message states 3 events in 38 bytes"),
    "b.bag": (ros1, {"change": lambda data: data + bytes(4)},
        {"change": lambda data: data + bytes(3)}, "a message states 3 events in 43 bytes"),
}  # fmt: skip
"""File → what writes it, its wrong and its right options, words of the message."""


@pytest.mark.filterwarnings("ignore:.*(have no unit|has no size)")
@pytest.mark.parametrize("name", ROWS)
def test_a_file_just_outside_is_refused_and_one_just_inside_read(tmp_path, name, monkeypatch):
    monkeypatch.setattr(bag_bounds, "MAX_HEADER_BYTES", MOST_FACTS)
    write, wrong, right, told = ROWS[name]
    given = write(tmp_path / name, **wrong) or {}
    with pytest.raises(FileFormatError, match=told) as caught:
        load(tmp_path / name, **given)
    assert "\n" not in str(caught.value)
    write(tmp_path / f"good{name}", **right)
    load(tmp_path / f"good{name}", **given)
