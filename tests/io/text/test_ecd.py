from __future__ import annotations

import json
from pathlib import Path

import pytest

from texvent.errors import FileFormatError, InputError, TexventWarning
from texvent.events import EventStream
from texvent.io import text_files as text_rows
from texvent.io.files import load, open_events, save
from texvent.sensor import SensorSize

RECORDED = "0.003811000 96 133 0\n0.003820001 127 171 1\n0.003820999 13 34 1\n"
"""Rows as the data set writes them: nine decimals."""


def write(folder: Path, text: str) -> Path:
    path = folder / "events.txt"
    path.write_text(text)
    return path


def test_rows_of_the_data_set_are_read_to_the_microsecond(tmp_path: Path) -> None:
    events = load(write(tmp_path, RECORDED), size=(240, 180))
    assert events.t.tolist() == [3811, 3820, 3821]
    assert (events.x.tolist(), events.y.tolist()) == ([96, 127, 13], [133, 171, 34])
    assert events.p.tolist() == [0, 1, 1]


def test_the_size_is_asked_for_and_never_guessed(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"does not store the sensor size; give it \(size="):
        load(write(tmp_path, RECORDED))


def test_whole_microseconds_are_written_exactly(tmp_path: Path) -> None:
    times = [0, 1, 999_999, 1_000_000, 1_790_000_000_123_456]
    for late in ([], [5_000_000_000_000_001, 2**33 * 1_000_000 + 7, 2**63 - 1]):
        ones = [1] * len(times + late)
        events = EventStream.from_columns(ones, ones, times + late, ones, size=SensorSize(4, 4))
        path = save(tmp_path / "events.txt", events, overwrite=True)
        assert path.read_text().split("\n")[4] == "1790000000.123456 1 1 1"
        assert load(path).equals(events)


def test_size_and_metadata_lie_beside_the_rows(tmp_path: Path) -> None:
    events = EventStream.from_columns([1], [2], [3], [1], size=SensorSize(4, 5))
    path = save(tmp_path / "events.txt", events.with_metadata({"seed": 0}))
    beside = json.loads((tmp_path / "events.txt.json").read_text())
    assert beside == {"width": 4, "height": 5, "texvent": {"seed": 0}}
    assert path.read_text() == "0.000003 1 2 1\n"


def test_blocks_that_cut_lines_change_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write(tmp_path, RECORDED * 1)
    whole = load(path, size=(240, 180))
    monkeypatch.setattr(text_rows, "BLOCK_BYTES", 30)
    packets = list(open_events(path, size=(240, 180)))
    assert len(packets) > 1
    assert EventStream.concat(packets).equals(whole)


def test_a_file_without_a_last_newline_is_whole(tmp_path: Path) -> None:
    assert len(load(write(tmp_path, RECORDED.rstrip("\n")), size=(240, 180))) == 3


def test_signed_polarity_is_converted(tmp_path: Path) -> None:
    events = load(write(tmp_path, "0.1 1 1 -1\n0.2 1 1 1\n"), size=(4, 4))
    assert events.p.tolist() == [0, 1]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.1 1 1\n", "rows of 3 values"),
        ("0.1 1 1 on\n", "not text rows"),
        ("0.1 1 1 1\n0.2 1\n", "not text rows"),
        ("nan 1 1 1\n", "not seconds"),
        ("1e30 1 1 1\n", "not seconds"),
        ("9223372036854.775808 1 1 1\n", "not text rows"),
        ("0.1 1.5 1 1\n", "not whole numbers"),
        ("0.1 4 1 1\n", "x runs from 4 to 4"),
        ("0.1 1 1 2\n", "polarity holds"),
        ("0.2 1 1 1\n0.1 1 1 1\n", "time decreases"),
    ],
)
def test_a_wrong_row_is_one_clear_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(FileFormatError, match=message) as caught:
        load(write(tmp_path, text), size=(4, 4))
    assert "\n" not in str(caught.value)


def test_order_is_checked_between_blocks_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(text_rows, "BLOCK_BYTES", 10)
    with pytest.raises(FileFormatError, match="time decreases"):
        load(write(tmp_path, "0.2 1 1 1\n0.1 1 1 1\n"), size=(4, 4))


def test_a_damaged_companion_file_is_reported(tmp_path: Path) -> None:
    path = write(tmp_path, RECORDED)
    for text in ("{", "[]", '{"width": 4}', '{"width": "a", "height": 4}'):
        (tmp_path / "events.txt.json").write_text(text)
        with pytest.raises(FileFormatError):
            load(path)


def test_microseconds_where_seconds_belong_are_said(tmp_path: Path) -> None:
    path = write(tmp_path, "".join(f"{10 * k} 3 4 1\n" for k in range(9_000)))
    with pytest.warns(TexventWarning, match=r"spans 1\.0 days with 9,000 events: .* probably µs"):
        load(path, size=(240, 180))


def test_a_day_with_fractions_of_seconds_is_taken_without_a_word(tmp_path: Path) -> None:
    path = write(tmp_path, "".join(f"{10 * k}.5 3 4 1\n" for k in range(9_000)))
    assert len(load(path, size=(240, 180))) == 9_000  # warnings are errors in tests
