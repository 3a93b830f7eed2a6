from pathlib import Path

import pytest

from texvent.errors import FileFormatError, InputError
from texvent.io.files import load, save

from .prophesee_files import HEADERS, at_times, events_of, write_words
from .slow_words import decode_dat


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


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "ends inside its header"),
        (b"\x0c\x08" + bytes(8), "no header of `% key value` lines"),
        (HEADERS["dat"].encode(), "ends inside its header"),
        (HEADERS["dat"].encode() + b"\x0c", "ends inside its header"),
        (HEADERS["dat"].encode()[:-1], "ends inside its header"),
        (HEADERS["dat"].encode() + b"\x0e\x08", "type 14 with 8 bytes"),
        (HEADERS["dat"].encode() + b"\x0c\x04", "type 12 with 4 bytes"),
        (HEADERS["dat"].replace("Version 2", "Version 1").encode() + b"\x0c\x08", "version '1'"),
        (HEADERS["dat"].replace("720", "many").encode() + b"\x0c\x08", "size of 'many'"),
        (HEADERS["dat"].replace("720", "0").encode() + b"\x0c\x08", "impossible sensor size"),
        (HEADERS["dat"].encode() + b"\x0c\x08" + bytes(7), "inside a record of 8 bytes"),
        (HEADERS["dat"].encode() + b"\x0c\x08" + b"\xff" * 8, "x runs from 16383"),
    ],
)
def test_a_damaged_file_is_one_clear_line(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "e.dat"
    path.write_bytes(content)
    with pytest.raises(FileFormatError, match=message) as caught:
        load(path)
    assert "\n" not in str(caught.value)
