"""RAW files, whose header tells the formats apart, and DAT."""

import subprocess
import sys
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.errors import FileFormatError, InputError, TexventWarning
from texvent.io import block_writer, byte_blocks, metadata
from texvent.io.files import codec_for, codec_that_reads, load, open_events, save
from texvent.io.prophesee import text_header
from texvent.io.prophesee.evt import SAMPLE, Evt2Codec, Evt3Codec, Evt21Codec

from .prophesee_files import (
    EXTENSIONS,
    FORMATS,
    HEADERS,
    at_times,
    events_of,
    row_bursts,
    write_words,
)
from .slow_words import decode_dat, decode_evt2, decode_evt3, decode_evt21

EVT = ("evt2", "evt21", "evt3")


@pytest.mark.parametrize(("start", "wrong"), [(0, 1 / 2), (0, 1 - 1 / 64), (1 - 1 / 8, 1 / 64)])
@pytest.mark.parametrize("between", [0, 1])
@pytest.mark.parametrize(("format", "bits"), [("evt2", 28), ("evt21", 28), ("evt3", 12)])
def test_a_lone_wrong_high_time_is_damage_not_a_turn(tmp_path, format, bits, between, start, wrong):
    """Nothing that follows it is moved, whether or not an event has it."""
    words, first = [], int(start * (1 << bits))
    for at in range(400):
        event = {"evt2": [0], "evt21": [1], "evt3": [0x6000, 0, 0x2000]}[format]
        for high in [int(wrong * (1 << bits)), first + at] if at == 300 else [first + at]:
            words.append(8 << 60 | high << 32 if format == "evt21" else 8 << bits | high)
            words += event * (between if high != first + at else 1)
    path = write_words(tmp_path, format, words)
    step_us = 4096 if format == "evt3" else 64
    times = [(first + at) * step_us for at in range(400)]
    if not between:
        assert load(path).t.tolist() == times
        return
    with pytest.raises(FileFormatError, match=r"time decreases .*--repair"):
        load(path)
    with pytest.warns(TexventWarning, match="stray times: 1"):
        assert load(path, repair=True).t.tolist() == times


def test_a_wrapped_counter_of_evt2_is_unrolled(tmp_path):
    words = [0x8FFF_FFFF, 0x0FC0_0000, 0x8000_0000, 0x0000_0000, 0x8FFF_FFFF, 0x8000_0001, 0x0]
    times = load(write_words(tmp_path, "evt2", words)).t.tolist()
    assert times == [2**34 - 1, 2**34, 2 * 2**34 + 64]


ANY = {
    "evt2": st.integers(0, 2**32 - 1) | st.integers(8 << 28, 8 << 28 | 100)
    | st.integers(0, 2**29 - 1),
    "evt21": st.integers(0, 2**64 - 1) | st.integers(0, 100).map(lambda high: 8 << 60 | high << 32)
    | st.integers(0, 2**61 - 1) | st.integers(0, 2**29 - 1).map(lambda place: place << 32),
    "evt3": st.integers(0, 0xFFFF) | st.integers(0x8000, 0x8005)
    | st.builds(lambda kind, value: kind << 12 | value, st.sampled_from([0, 2, 3, 4, 5, 6, 8]),
                st.sampled_from([0, 1, 0x100, 0x7FF, 0x801, 0xFFF])),
}  # fmt: skip
"""Words of each format: any, times, events, and groups without or with every bit."""


@pytest.mark.parametrize(
    ("format", "codec", "slow", "dtype"),
    [
        ("evt2", Evt2Codec, decode_evt2, "<u4"),
        ("evt21", Evt21Codec, decode_evt21, "<u8"),
        ("evt3", Evt3Codec, decode_evt3, "<u2"),
    ],
)
@examples(150)
@given(data=st.data(), cut=st.integers(0, 80))
def test_any_words_mean_what_the_slow_decoder_says(format, codec, slow, dtype, data, cut):
    array = np.array(data.draw(st.lists(ANY[format], max_size=80)), dtype)
    highs = array >> 32 if format == "evt21" else array
    is_turned = (np.diff(highs[highs >> 28 == 8].astype(np.int64)) < -(2**27)).any()
    if format != "evt3" and is_turned:
        return  # the slow decoder does not know wraps
    stored = array << 32 | array >> 32 if format == "evt21" else array
    decoder, rows = codec().make_decoder(), []
    for part in (stored[:cut], stored[cut:]):
        columns = decoder.decode(part)
        rows += zip(*(columns[name].tolist() for name in "xytp"), strict=True)
    assert rows == slow(array.tobytes())


WORDS = [
    0x1 << 60 | 0b1,  # before any TIME_HIGH: no time, left out
    0x8 << 60 | 3 << 32,  # TIME_HIGH: 3 · 64 µs
    0x1 << 60 | 5 << 54 | 1248 << 43 | 719 << 32 | 0x8000_0001,  # ON at x 1248 and 1279
    0xA << 60,  # a trigger
    0x0 << 60 | 63 << 54 | 32 << 43 | 4 << 32 | 0b1010,  # OFF at x 33 and 35
]
MEANING = [(1248, 719, 197, 1), (1279, 719, 197, 1), (33, 4, 255, 0), (35, 4, 255, 0)]


def exchange_halves(word: int) -> int:
    return (word & 0xFFFF_FFFF) << 32 | word >> 32


@pytest.mark.parametrize(
    ("header", "legacy"),
    [
        ("% format EVT21;endianness=legacy;height=720;width=1280\n% end\n", True),
        ("% endianness legacy\n% evt 2.1\n% geometry 1280x720\n% end\n", True),
        ("% endianness little\n% evt 2.1\n% geometry 1280x720\n% end\n", False),
        ("% evt 2.1\n% geometry 1280x720\n% integrator_name Prophesee\n% system_ID 49\n", True),
        ("% evt 2.1\n% geometry 1280x720\n% integrator_name Prophesee\n% system_ID 55\n", False),
        ("% evt 2.1\n% geometry 1280x720\n% integrator_name Other\n% system_ID 49\n", False),
        ("% evt 2.1\n% geometry 1280x720\n% end\n", False),
    ],
)
def test_the_header_of_evt21_decides_which_half_of_a_word_comes_first(tmp_path, header, legacy):
    words = [exchange_halves(word) if legacy else word for word in WORDS]
    assert events_of(load(write_words(tmp_path, "evt21", words, header=header))) == MEANING


TYPES = {"evt2": {0, 1, 8, 10, 14, 15}, "evt21": {0, 1, 8, 10, 14, 15}}
TYPES["evt3"] = {*range(9), 10, 14, 15}
"""Of the words of a format, in the published tables; type 1 of EVT3 is a row of another kind."""


@pytest.mark.parametrize("kind", range(16))
@pytest.mark.parametrize("format", EVT)
def test_types_of_words_that_a_format_does_not_have_are_told(tmp_path, format, kind, recwarn):
    bits = {"evt2": 28, "evt21": 60, "evt3": 12}[format]
    path = write_words(tmp_path, format, [8 << bits, *[kind << bits] * 9] * SAMPLE)
    load(path)
    told = [one for one in recwarn if f"types that {format.upper()} does not have" in str(one)]
    assert len(told) == (kind not in TYPES[format])


@pytest.mark.parametrize("format", EVT)
def test_one_extension_is_read_by_its_header_and_written_as_evt3(tmp_path, format):
    path = write_words(tmp_path, format, [])
    assert len(load(path)) == 0
    assert codec_that_reads(path).name == format
    assert codec_for(path).name == "evt3"
    with pytest.raises(FileFormatError, match=r"is not EVT.*its header names 'EVT"):
        load(path, format=next(one for one in EVT if one != format))


@pytest.mark.parametrize(
    ("header", "size"),
    [
        ("% evt 3.0\n% geometry 1280x720\n% end\n", None),
        ("% evt 3.0\n% format EVT3\n% geometry 1280x720\n", None),
        ("% evt 3.0\n% format EVT3;width=1280;height=720\n% end\n", None),
        ("% evt 3.0\n", (1280, 720)),
    ],
)
def test_headers_of_other_generations_are_understood(tmp_path, header, size):
    path = write_words(tmp_path, "evt3", [0x8001, 0x6002, 0x0003, 0x2804], header=header)
    events = load(path, size=size)
    assert (events.t.tolist(), tuple(events.size)) == ([4098], (1280, 720))
    assert events.metadata["header"]["evt"] == "3.0"


def test_data_that_begins_like_a_header_line_is_data_once_the_header_has_ended(tmp_path):
    path = write_words(tmp_path, "evt3", [0x2025, 0x8001, 0x6002, 0x0003, 0x2804])
    assert load(path).t.tolist() == [4098]


def test_control_bytes_end_a_header_without_an_end_line(tmp_path):
    header = "% evt 2.0\n% geometry 1280x720\n"
    path = write_words(tmp_path, "evt2", [0x0000_2025, 0x8000_0001, 0x0], header=header)
    assert load(path).t.tolist() == [64]


DAT = HEADERS["dat"].encode()


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("e.raw", b"", "names no format"),
        ("e.raw", b"\x00\x80\x01\x60", "names no format"),
        ("e.raw", b"% date 2026-11-20\n% end\n\x00\x80", "names no format"),
        ("e.raw", b"% evt 4.0\n% end\n", "its header names '4.0'"),
        ("e.raw", b"% format HISTO3D;height=320;width=320\n% end\n", "its header names 'HISTO3D'"),
        ("e.raw", b"% evt 3.0\n% geometry 12", "ends inside its header"),
        ("e.raw", b"% evt 3.0\n% geometry 1280x720\n", "ends inside its header"),
        ("e.raw", b"% evt 3.0\n% geometry 1280\n% end\n", "states a size of ''"),
        ("e.raw", b"% evt 3.0\n% geometry 0x720\n% end\n", "impossible sensor size 0x720"),
        ("e.raw", b"% evt 3.0\n% geometry 99999999999x720\n% end\n", "states a size of '9999"),
        ("e.raw", b"% evt 3.0\n% geometry 4x4\n% texvent {\n% end\n", "damaged metadata"),
        ("e.raw", b"% evt 3.0\n% geometry 4x4\n% end\n\x00", "ends inside a record of 2 bytes"),
        (
            "e.raw",
            b"% evt 3.0\n% geometry 4x4\n% end\n\x01\x80\x00\x00\x04\x20",
            "x runs from 4 to 4",
        ),
        ("e.dat", b"", "ends inside its header"),
        ("e.dat", b"\x0c\x08" + bytes(8), "no header of `% key value` lines"),
        ("e.dat", DAT, "ends inside its header"),
        ("e.dat", DAT + b"\x0c", "ends inside its header"),
        ("e.dat", DAT[:-1], "ends inside its header"),
        ("e.dat", DAT + b"\x0e\x08", "type 14 with 8 bytes"),
        ("e.dat", DAT + b"\x0c\x04", "type 12 with 4 bytes"),
        (
            "e.dat",
            HEADERS["dat"].replace("Version 2", "Version 1").encode() + b"\x0c\x08",
            "version '1'",
        ),
        ("e.dat", HEADERS["dat"].replace("720", "many").encode() + b"\x0c\x08", "size of 'many'"),
        (
            "e.dat",
            HEADERS["dat"].replace("720", "0").encode() + b"\x0c\x08",
            "impossible sensor size",
        ),
        ("e.dat", DAT + b"\x0c\x08" + bytes(7), "inside a record of 8 bytes"),
        ("e.dat", DAT + b"\x0c\x08" + b"\xff" * 8, "x runs from 16383"),
    ],
)
def test_a_damaged_file_is_one_clear_line(tmp_path, name, content, message):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(FileFormatError, match=message) as caught:
        load(path)
    assert "\n" not in str(caught.value)


def test_a_header_without_end_is_not_read_into_memory(tmp_path, monkeypatch):
    monkeypatch.setattr(text_header, "MAX_HEADER_BYTES", 100)
    for content in (b"% key value\n" * 20, b"% key " + b"v" * 200):
        path = tmp_path / "e.raw"
        path.write_bytes(content)
        with pytest.raises(FileFormatError, match="has a header of more than 100 bytes"):
            load(path)


def test_metadata_too_long_for_a_header_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(metadata, "MAX_HEADER_BYTES", 100)
    with pytest.raises(InputError, match=r"metadata of \d+ bytes cannot be stored in a text"):
        save(tmp_path / "e.raw", at_times(1).with_metadata({"prompt": "a" * 60}))
    assert not list(tmp_path.iterdir())


def test_numba_is_imported_only_when_words_are_decoded():
    program = (
        "import sys; from texvent.io.files import codec_for; codec_for('a.raw'); "
        "codec_for('a.dat'); codec_for('a.h5'); "
        "sys.exit('numba' in sys.modules)"
    )
    subprocess.run([sys.executable, "-c", program], check=True, timeout=300)


@pytest.mark.parametrize(
    ("lines", "size"),
    [
        ("system_ID 49", (1280, 720)),
        ("system_ID 40\n% integrator_name Prophesee", (640, 480)),
        ("system_ID 153", (640, 480)),  # 0x19 behind another board
        ("system_ID 49\n% integrator_name Somebody", None),
        ("plugin_name hal_plugin_imx636_evk4", (1280, 720)),
        ("plugin_name hal_plugin_gen31_evk3", (640, 480)),
        ("sensor_name GenX320", (320, 320)),
        ("sensor_generation 3.1", (640, 480)),
    ],
)
def test_older_headers_name_the_sensor_otherwise(tmp_path, lines, size):
    path = tmp_path / "e.raw"
    path.write_bytes(f"% evt 3.0\n% {lines}\n% end\n".encode() + bytes([0, 0x80]))
    if size is None:
        with pytest.raises(InputError, match="does not store the sensor size"):
            load(path)
    else:
        assert tuple(load(path).size) == size


@pytest.mark.parametrize("format", FORMATS)
def test_memory_does_not_grow_with_the_file(tmp_path, format, monkeypatch):
    events = row_bursts(20_000)
    whole = sum(column.nbytes for column in events.columns().values())
    monkeypatch.setattr(byte_blocks, "BLOCK_BYTES", 2**14)
    monkeypatch.setattr(block_writer, "BLOCK_EVENTS", 2**12)
    path = save(tmp_path / f"warm{EXTENSIONS[format]}", row_bursts(10), format=format)
    assert len(load(path))
    tracemalloc.start()
    path = save(tmp_path / f"e{EXTENSIONS[format]}", events, format=format)
    written = tracemalloc.get_traced_memory()[1]
    tracemalloc.reset_peak()
    assert sum(len(packet) for packet in open_events(path)) == len(events)
    read = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert max(written, read) < whole / 3


def record(x: int, y: int, t: int, p: int) -> int:
    return (p << 28 | y << 14 | x) << 32 | t


def test_the_bytes_written_are_those_of_the_description(tmp_path: Path) -> None:
    events = at_times(5, 2**32 - 1)
    data = save(tmp_path / "e.dat", events).read_bytes()
    header = b'% Height 720\n% Version 2\n% Width 1280\n% texvent {"seed": 0}\n\x0c\x08'
    assert data[: len(header)] == header
    assert decode_dat(data[len(header) :]) == events_of(events)


def test_older_headers_without_space_or_size_are_read(tmp_path: Path) -> None:
    header = "% Data file containing CD events.\n% Version 2\n% Date 2014-06-11 14:11:35\n"
    path = write_words(tmp_path, "dat", [record(1, 2, 3, 1)], header=header)
    with pytest.raises(InputError, match="does not store the sensor size"):
        load(path)
    events = load(path, size=(304, 240))
    assert events_of(events) == [(1, 2, 3, 1)]
    assert events.metadata["header"]["Date"] == "2014-06-11 14:11:35"
