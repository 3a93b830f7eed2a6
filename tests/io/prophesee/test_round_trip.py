"""Every Prophesee format carries every stream it can hold unchanged, and refuses the others."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.errors import InputError, OutputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.files import load, save
from texvent.sensor import SensorSize

from .prophesee_files import EXTENSIONS, FORMATS, LATE_STREAMS, SIZE, STREAMS, at_times

formats = pytest.mark.parametrize("format", FORMATS)
METADATA = {"prompt": 'a "red" car 🚗\n% end', "seed": 0, "nested": {"list": [1, 2.5, None]}}


@formats
@pytest.mark.parametrize("name", [*STREAMS, *LATE_STREAMS])
def test_every_stream_comes_back_unchanged(tmp_path: Path, format: str, name: str) -> None:
    stream = {**STREAMS, **LATE_STREAMS}[name]()
    path = tmp_path / f"events{EXTENSIONS[format]}"
    if format == "dat" and name in LATE_STREAMS:
        with pytest.raises(InputError, match=r"DAT holds times below 4294967296 µs"):
            save(path, stream, format=format)
        return
    save(path, stream, format=format)
    # Without the format: the content decides who reads it.
    back = load(path)
    assert back.equals(stream)
    assert dict(back.metadata) == dict(stream.metadata)


@settings(max_examples=40)
@given(
    rows=st.lists(
        st.tuples(
            st.integers(0, 40),
            st.integers(0, 3),
            st.one_of(st.integers(0, 70), st.integers(0, 2**26)),
            st.booleans(),
        ),
        max_size=30,
    ),
    cut=st.integers(0, 30),
)
def test_any_events_cut_anywhere_come_back(
    tmp_path_factory: pytest.TempPathFactory, rows: list[tuple[int, int, int, bool]], cut: int
) -> None:
    rows = sorted(rows, key=lambda row: row[2])
    x, y, t, p = (list(column) for column in zip(*rows, strict=True)) if rows else ([],) * 4
    events = EventStream.from_columns(x, y, t, p, size=SensorSize(64, 4))
    folder = tmp_path_factory.mktemp("any")
    for format in FORMATS:
        path = folder / f"{format}{EXTENSIONS[format]}"
        save(path, EventPackets([events[:cut], events[cut:]], events.size), format=format)
        assert load(path).equals(events)


@pytest.mark.parametrize(
    ("format", "times", "message"),
    [
        ("dat", (2**32,), r"DAT holds times below 4294967296 µs \(1\.19 h\)"),
        *[(format, (-1,), "time -1 µs; event files start at 0") for format in FORMATS],
    ],
)
def test_times_that_do_not_fit_are_refused_with_the_formats_that_hold_them(
    tmp_path: Path,
    format: str,
    times: tuple[int, ...],
    message: str,
    folder_is_clean: Callable[[], bool],
) -> None:
    with pytest.raises(InputError, match=message):
        save(tmp_path / f"e{EXTENSIONS[format]}", at_times(*times), format=format)
    assert folder_is_clean()


@formats
def test_the_stored_size_contradicts_a_wrong_one(tmp_path: Path, format: str) -> None:
    path = save(tmp_path / f"e{EXTENSIONS[format]}", at_times(1), format=format)
    assert load(path, size=(1280, 720)).size == SIZE
    with pytest.raises(InputError, match="recorded at 1280x720, not 640x480"):
        load(path, size=(640, 480))


@formats
def test_a_disk_that_fills_up_leaves_nothing(
    tmp_path: Path,
    format: str,
    monkeypatch: pytest.MonkeyPatch,
    folder_is_clean: Callable[[], bool],
) -> None:
    def fail(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    place = {
        "dat": "texvent.io.prophesee.dat._encode",
    }.get(format, "texvent.io.prophesee.evt.WordEncoder.encode")
    monkeypatch.setattr(place, fail)
    with pytest.raises(OutputError, match="the disk is full") as caught:
        save(tmp_path / f"e{EXTENSIONS[format]}", at_times(1, 2), format=format)
    assert "\n" not in str(caught.value)
    assert folder_is_clean()
