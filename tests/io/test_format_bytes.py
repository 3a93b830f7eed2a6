"""Bytes worked out by hand from each format's description, and the traps of reading."""

import struct
import zipfile

import numpy as np
import pytest

from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.io.aedat import aedat4_container as aedat4_packing
from texvent.io.files import codec_that_reads, load, open_events, save
from texvent.runtime import memory
from texvent.sensor import SensorSize

DAVIS, DVS = SensorSize(346, 260), SensorSize(128, 128)


def one(x: int, y: int, t: int, p: int, size: SensorSize) -> EventStream:
    return EventStream.from_columns([x], [y], [t], [p], size=size)


@pytest.mark.parametrize(
    ("options", "size", "address"),
    [
        ({"size": "davis346"}, DAVIS, (259 - 20) << 22 | (345 - 10) << 12 | 1 << 11),
        ({"size": "240x180"}, (240, 180), (179 - 20) << 22 | (239 - 10) << 12 | 1 << 11),
        ({"size": "128x128"}, DVS, (127 - 20) << 22 | (127 - 10) << 12 | 1 << 11),
        ({"size": "dvs128"}, DVS, (127 - 20) << 8 | (127 - 10) << 1 | 0),
        ({"format": "aedat2-dvs128"}, DVS, 10 << 8 | 20 << 1 | 1),
        ({"format": "cifar10-dvs"}, DVS, (127 - 10) << 8 | (127 - 20) << 1 | 0),
    ],
)
def test_aedat2_records_are_big_endian_addresses_and_times(tmp_path, options, size, address):
    path = tmp_path / "e.aedat"
    end = b"#End Of ASCII Header\r\n"
    path.write_bytes(b"#!AER-DAT2.0\r\n" + end + struct.pack(">II", address, 1234))
    assert load(path, **options).equals(one(10, 20, 1234, 1, SensorSize(*size)))


@pytest.mark.parametrize(
    ("chip", "size"),
    [
        ("eu.seebetter.ini.chips.davis.DAVIS240C", (240, 180)),
        ("ch.unizh.ini.jaer.chip.cochlea.CochleaAMS1c", None),
        ("eu.seebetter.ini.chips.davis.DAVIS208PixelParade", (208, 192)),
        ("eu.seebetter.ini.chips.davis.DAVIS128", (128, 128)),
        ("eu.seebetter.ini.chips.davis.DAViS640", (640, 480)),
        ("eu.seebetter.ini.chips.davis.Davis346blue", (346, 260)),
        ("eu.seebetter.ini.chips.davis.DVS240", (240, 180)),
        ("ch.unizh.ini.jaer.chip.retina.DVS640", (640, 480)),
    ],
)
def test_the_chip_of_jaer_names_sensor_and_layout(tmp_path, chip, size):
    path = tmp_path / "e.aedat"
    width, height = size or (346, 260)
    row, column = (11, 1) if chip.endswith("DVS640") else (22, 12)
    record = struct.pack(">II", (height - 1) << row | (width - 1) << column, 7)
    path.write_bytes(f"#!AER-DAT2.0\r\n# AEChip: {chip}\r\n".encode() + record)
    if size is None:
        with pytest.raises(InputError, match="does not say which camera made it"):
            load(path)
    else:
        assert load(path).equals(one(0, 0, 7, 0, SensorSize(*size)))


def test_aedat3_counts_turns_of_the_clock(tmp_path):
    header = b"#!AER-DAT3.1\r\n#Format: RAW\r\n#Size: 128x128\r\n#!END-HEADER\r\n"
    head = struct.pack("<hhiiiiii", 1, 1, 8, 4, 1, 1, 1, 1)
    path = tmp_path / "e.aedat"
    path.write_bytes(header + head + struct.pack("<II", 10 << 17 | 20 << 2 | 1 << 1 | 1, 5))
    assert load(path).equals(one(10, 20, 2**31 + 5, 1, DVS))


EVENT_STREAM = b"Event Stream\x02\x00\x00\x01" + struct.pack("<HH", 300, 10)


def test_event_stream_bytes_count_rows_from_below(tmp_path):
    events = EventStream.from_columns(
        [1, 258], [0, 9], [126, 126 + 127 + 3], [1, 0], size=SensorSize(300, 10)
    )
    first = struct.pack("<BHH", 126 << 1 | 1, 1, 9)
    second = b"\xff" + struct.pack("<BHH", 3 << 1, 258, 0)
    path = tmp_path / "e.es"
    for content in (first + second, b"\xfe" + first + b"\xfe" + second):
        path.write_bytes(EVENT_STREAM + content)
        assert load(path).equals(events)
    path.write_bytes(EVENT_STREAM + first + second[:-1])
    with pytest.raises(FileFormatError, match="ends inside an event"):
        load(path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ((12, 1), "version 1"),
        *(
            ((15, number), rf"type {number} \({name}\)")
            for number, name in ((0, "generic"), (2, "atis"), (3, "asynchronous"), (4, "color"))
        ),
        ((15, 9), r"type 9 \(unknown\)"),
    ],
)
def test_other_event_streams_are_named(tmp_path, change, message):
    content = bytearray(EVENT_STREAM)
    content[change[0]] = change[1]
    path = tmp_path / "e.es"
    path.write_bytes(content)
    with pytest.raises(FileFormatError, match=message):
        load(path)


def test_a_dvs128_recording_of_jaer_is_read_as_jaer_shows_it(tmp_path):
    """Bit 0 is 0 for ON, x is mirrored, y counts from the bottom, bit 15 is no event."""
    chip = b"# AEChip: ch.unizh.ini.jaer.chip.retina.DVS128\r\n"
    on_left_top = 127 << 8 | 127 << 1 | 0
    off_right_bottom = 0 << 8 | 0 << 1 | 1
    records = struct.pack(">6I", on_left_top, 10, 1 << 15, 15, off_right_bottom, 20)
    path = tmp_path / "e.aedat"
    path.write_bytes(b"#!AER-DAT2.0\r\n" + chip + records)
    for events in (load(path), load(path, size="dvs128")):
        assert events.size == DVS
        assert list(zip(events.x, events.y, events.t, events.p, strict=True)) == [
            (0, 0, 10, 1),
            (127, 127, 20, 0),
        ]


def test_aedat2_of_an_unknown_camera_asks_for_a_sensor_that_can_be(tmp_path):
    path = tmp_path / "camera.aedat"
    special = struct.pack(">II", 1 << 31 | 5, 6) + struct.pack(">II", 1 << 10, 7)
    event = struct.pack(">II", 259 << 22 | 345 << 12, 8)
    path.write_bytes(b"#!AER-DAT2.0\r\n# made elsewhere\r\n" + special + event)
    with pytest.raises(InputError, match=r"command line\): davis240c, davis346 or its WIDTHx"):
        load(path)
    assert load(path, size="davis346").equals(one(0, 0, 8, 0, DAVIS))
    with pytest.raises(InputError, match="addresses outside of a sensor of 240x180"):
        load(path, size="davis240c")
    path.write_bytes(b"#!AER-DAT2.0\r\n" + struct.pack(">II", 5 << 8 | 6 << 1, 8))
    with pytest.raises(InputError, match=r"dvs128; or the format aedat2-dvs128 \(as tonic"):
        load(path)


def test_aedat3_reads_over_other_packets_and_invalid_events(tmp_path):
    header = b"#!AER-DAT3.1\r\n#Format: RAW\r\n#Source 1: DVS128\r\n#!END-HEADER\r\n"
    special = struct.pack("<hhiiiiii", 0, 1, 8, 4, 0, 1, 1, 1) + bytes(8)
    polarity = struct.pack("<hhiiiiii", 1, 1, 8, 4, 0, 4, 2, 1)
    invalid = struct.pack("<II", 3 << 17 | 4 << 2, 9)
    valid = struct.pack("<II", 3 << 17 | 4 << 2 | 1, 9)
    path = tmp_path / "gesture.aedat"
    path.write_bytes(header + special + polarity + invalid + valid)
    assert codec_that_reads(path).name == "aedat3"
    assert load(path).equals(one(3, 4, 9, 0, DVS))
    path.write_bytes(header.replace(b"DVS128", b"SomeCam") + special)
    with pytest.raises(InputError, match="does not store the sensor size"):
        load(path)


def test_atis_bytes_and_overflow_marks(tmp_path):
    path = save(tmp_path / "e.bin", one(10, 20, 0x12_3456, 1, DVS))
    assert path.read_bytes() == bytes([10, 20, 0x80 | 0x12, 0x34, 0x56])
    marks = bytes([0, 240, 0, 0, 0]) * 2
    path.write_bytes(bytes([1, 2, 0, 0, 5]) + marks + bytes([1, 2, 0, 0, 6]))
    assert load(path).t.tolist() == [5, 2 * 8192 + 6]
    (tmp_path / "e.bin.json").unlink()
    with pytest.raises(InputError, match="does not store the sensor size"):
        load(path)


def test_a_zip_bomb_is_refused_before_it_is_unpacked(tmp_path, monkeypatch):
    monkeypatch.setattr(memory, "SMALL_BYTES", 2**20)
    for name, entry in (("bomb.zip", "events.txt"), ("bomb.npz", "event_data.npy")):
        path = tmp_path / name
        with (
            zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive,
            archive.open(entry, "w", force_zip64=True) as file,
        ):
            file.write(bytes(2**24))
        with pytest.raises(FileFormatError, match="claims to unpack to 16777216"):
            load(path)


def test_a_packet_that_unpacks_without_end_is_refused(monkeypatch):
    packed = aedat4_packing.pack_lz4(bytes(3 * 2**20))
    assert aedat4_packing.unpack_lz4(packed) == bytes(3 * 2**20)
    monkeypatch.setattr(aedat4_packing, "MAX_PACKET_BYTES", 2**20)
    with pytest.raises(FileFormatError, match="unpacks to more than 1 MiB"):
        aedat4_packing.unpack_lz4(packed)


def test_aedat4_of_a_recorder_that_crashed_is_read(tmp_path):
    events = EventStream.from_columns([1, 2], [3, 4], [5, 60_000], [1, 0], size=DVS)
    path = save(tmp_path / "e.aedat4", events)
    content = bytearray(path.read_bytes())
    # The position of the list lies in the header table; -1: the recorder did not get that far.
    place = len(b"#!AER-DAT4.0\r\n") + 32
    (listed,) = struct.unpack_from("<q", content, place)
    struct.pack_into("<q", content, place, -1)
    path.write_bytes(content[:listed])
    assert load(path).equals(events)


def test_a_folder_of_esim_itself_needs_the_size(tmp_path):
    with pytest.raises(InputError, match="not one of event files that texvent knows"):
        open_events(tmp_path)
    folder = tmp_path / "esim"
    folder.mkdir()
    for index in range(2):
        t = np.array([1999, 2000]) + index * 10_000
        columns = {"x": np.array([1, 2]), "y": np.array([3, 4]), "p": np.array([-1, 1])}
        np.savez(folder / f"{index:010d}.npz", t=t, **columns)
    with pytest.raises(InputError, match="does not store the sensor size"):
        load(folder)
    events = load(folder, size=(8, 8))
    assert events.t.tolist() == [1, 2, 11, 12]
    assert events.p.tolist() == [0, 1, 0, 1]
