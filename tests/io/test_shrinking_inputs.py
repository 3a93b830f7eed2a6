"""A file that becomes shorter while it is read is refused: no bus error, no shorter recording."""

import os
import struct
from fractions import Fraction

import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, TexventWarning
from texvent.io.arrays import folders
from texvent.io.arrays.npy_file import StoredArray
from texvent.io.files import open_events, save

from .format_cases import CASE_OF, random_events
from .read_only_formats import write_evreal

SHORTER = "became shorter while it was read"


def test_an_array_of_frames(tmp_path):
    path = tmp_path / "frames.npy"
    np.save(path, np.zeros((20, 64, 64), np.uint8))
    frames = iter(open_frames(path, CaptureConfig(fps=Fraction(25))))
    next(frames)
    os.truncate(path, 64 * 64 * 4)
    with pytest.raises(FileFormatError, match=SHORTER):
        list(frames)


def test_the_events_of_an_evreal_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(folders, "PACKET_EVENTS", 1000)
    path = write_evreal(tmp_path / "e", random_events(20_000, CASE_OF["evreal"].sensor))
    packets = iter(open_events(path))
    next(packets)
    os.truncate(path / "events_xy.npy", 4000)
    with pytest.raises(FileFormatError, match=SHORTER):
        list(packets)


def test_an_aedat4_file_of_many_packets(tmp_path):
    events = random_events(50_000, CASE_OF["aedat4"].sensor, span_us=5_000_000)
    path = save(tmp_path / "e.aedat4", events)
    packets = iter(open_events(path))
    next(packets)
    os.truncate(path, path.stat().st_size // 2)
    with pytest.raises(FileFormatError, match=SHORTER):
        list(packets)


COUNT = 60_000
CONTENTS = {
    "e.dat": b"% Height 9\n% Width 9\n\x0c\x08" + struct.pack("<2I", 7, 5) * COUNT,
    "evt3.raw": b"% format EVT3;height=9;width=9\n% end\n"
    + struct.pack("<4H", 0x8001, 0x6001, 1, 0x2001) * COUNT,
    "evt2.raw": b"% format EVT2;height=9;width=9\n% end\n"
    + struct.pack("<2I", 8 << 28 | 1, 1 << 28) * COUNT,
    "aedat2.aedat": b"#!AER-DAT2.0\r\n# AEChip: DVS128\r\n" + struct.pack(">2I", 5, 7) * COUNT,
    "aedat3.aedat": b"#!AER-DAT3.1\r\n#Size: 9x9\r\n#!END-HEADER\r\n"
    + (struct.pack("<2h6i", 1, 1, 8, 4, 0, 16, 16, 16) + struct.pack("<2I", 1, 5) * 16) * 3_750,
    "e.es": b"Event Stream\x02\x00\x00\x01" + struct.pack("<2H", 9, 9) + b"\3\1\0\1\0" * COUNT,
    "e.txt": b"0.5 1 2 1\n" * COUNT,
    "e.csv": b"t,x,y,p\n" + b"5,1,2,1\n" * COUNT,
}


@pytest.mark.parametrize("name", CONTENTS)
def test_every_format_of_records_and_rows(tmp_path, monkeypatch, name):
    for module in ("byte_blocks", "text.codecs"):
        monkeypatch.setattr(f"texvent.io.{module}.BLOCK_BYTES", 1 << 16)
    path = tmp_path / name
    path.write_bytes(CONTENTS[name])
    packets = iter(open_events(path, size=(9, 9) if name in ("e.txt", "e.csv") else None))
    next(packets)
    # Whole rows and records are left.
    unit = 40
    header = len(CONTENTS[name]) % unit
    os.truncate(path, header + len(CONTENTS[name]) // 2 // unit * unit)
    with pytest.raises(FileFormatError, match=SHORTER):
        list(packets)


@pytest.mark.parametrize("name", ["e.txt", "e.h5"])
@pytest.mark.parametrize("change", ["shorter", "longer"])
def test_a_change_of_length_is_named_as_the_cause(tmp_path, name, change):
    path = save(tmp_path / name, random_events(90_000, CASE_OF["ecd"].sensor))
    events = open_events(path)
    if change == "shorter":
        os.truncate(path, path.stat().st_size // 2 - 3)
    else:
        path.write_bytes(path.read_bytes()[: 10_000 - 3].ljust(path.stat().st_size + 9, b"7"))
    with pytest.raises(FileFormatError, match=f"became {change} while it was read"):
        list(events)


def test_what_is_added_meanwhile_is_not_read(tmp_path):
    path = tmp_path / "e.dat"
    path.write_bytes(CONTENTS["e.dat"] + CONTENTS["e.dat"][-8 * COUNT :] * 9)
    packets = iter(open_events(path))
    count = len(next(packets))
    with path.open("ab") as file:
        file.write(bytes(8 * 100 + 3))
    assert count + sum(map(len, packets)) == 10 * COUNT


def test_an_array_stored_by_columns_gives_its_rows(tmp_path):
    values = np.arange(24).reshape(4, 6)
    np.save(tmp_path / "a.npy", np.asfortranarray(values))
    assert (StoredArray(tmp_path / "a.npy").rows(1, 3) == values[1:3]).all()


@pytest.mark.parametrize("name", ["e.dat", "evt2.raw", "aedat2.aedat", "e.es"])
def test_a_part_of_zeros_is_no_events(tmp_path, name):
    data = CONTENTS[name]
    half = len(data) - COUNT // 2 * (5 if name == "e.es" else 8)
    # The last byte of its events is a zero here.
    half -= name == "e.es"
    path = tmp_path / name
    path.write_bytes(data[:half] + bytes(len(data) - half))
    with pytest.raises(FileFormatError, match=f"zeros instead of events from byte {half} on"):
        list(open_events(path))
    with pytest.warns(TexventWarning, match="cut off: holds zeros instead of events"):
        assert sum(map(len, open_events(path, repair=True))) == COUNT // 2 - (name == "e.es")


def test_zeros_and_words_that_are_no_events_are_said(tmp_path):
    path = tmp_path / "e.raw"
    data = CONTENTS["evt3.raw"]
    for content, message in (
        (data[: 37 + 480_000 // 2] + bytes(20_480), r"(19,968|20,480) bytes of zeros instead of"),
        (data + struct.pack("<H", 0xB000) * 1600, "100 words of types that EVT3 does not have"),
        (data.replace(b"\x01\x80", b"\x00\xe0"), "left out 60,000 of 60,000 events"),
    ):
        path.write_bytes(content)
        with pytest.warns(TexventWarning, match=message):
            list(open_events(path))
