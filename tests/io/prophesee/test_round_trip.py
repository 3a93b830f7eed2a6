"""Every Prophesee format carries every stream it can hold unchanged, and refuses the others."""

from __future__ import annotations

import errno
import itertools
import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.errors import InputError, OutputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.files import load, open_events, open_writer, save
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


@formats
def test_metadata_of_any_kind_comes_back(tmp_path: Path, format: str) -> None:
    path = tmp_path / f"events{EXTENSIONS[format]}"
    save(path, at_times(5).with_metadata(METADATA), format=format)
    assert load(path).metadata == METADATA


@formats
def test_packet_sizes_do_not_change_the_file(tmp_path: Path, format: str) -> None:
    whole = STREAMS["bursts in rows"]()
    cuts = [0, 0, 1, 2, 900, 901, len(whole)]
    parts = [whole[start:stop] for start, stop in itertools.pairwise(cuts)]
    files = []
    for index, packets in enumerate([[whole], parts]):
        path = tmp_path / f"{index}{EXTENSIONS[format]}"
        save(path, EventPackets(packets, whole.size, {"seed": 1}), format=format)
        files.append(path)
        back = open_events(path)
        assert back.collect().equals(whole)
        assert back.collect().equals(whole), "packets of a file can be read again"
    assert files[0].read_bytes() == files[1].read_bytes()


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


@formats
def test_a_sensor_that_is_too_large_is_refused_before_any_file_exists(
    tmp_path: Path, format: str, folder_is_clean: Callable[[], bool]
) -> None:
    largest = 16_384 if format == "dat" else 2048
    path = tmp_path / f"e{EXTENSIONS[format]}"
    open_writer(path, size=SensorSize(largest, largest), format=format)
    message = rf"holds sensors up to {largest}x{largest}, not 9x{largest + 1}; hdf5 \(\.h5\)"
    with pytest.raises(InputError, match=message):
        open_writer(path, size=SensorSize(9, largest + 1), format=format)
    assert folder_is_clean()


@pytest.mark.parametrize(
    ("format", "times", "message"),
    [
        ("evt2", (2**34,), r"EVT2 holds times below 17179869184 µs \(4\.77 h\)\. hdf5"),
        ("evt21", (2**34,), r"EVT2\.1 holds times below 17179869184 µs"),
        ("evt3", (2**42,), r"EVT3 holds times below 4398046511104 µs"),
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
def test_packets_out_of_order_or_of_another_size_are_refused(
    tmp_path: Path, format: str, folder_is_clean: Callable[[], bool]
) -> None:
    late = at_times(50, size=SensorSize(4, 4))
    for second in (at_times(49, size=SensorSize(4, 4)), at_times(60, size=SensorSize(5, 4))):
        path = tmp_path / f"e{EXTENSIONS[format]}"
        with pytest.raises(InputError):
            save(path, EventPackets([late, second], SensorSize(4, 4)), format=format)
    assert folder_is_clean()


@formats
def test_existing_files_folders_and_closed_writers_are_respected(
    tmp_path: Path, format: str
) -> None:
    path = tmp_path / f"e{EXTENSIONS[format]}"
    save(path, at_times(1), format=format)
    with pytest.raises(OutputError, match="exists already"):
        open_writer(path, size=SIZE, format=format)
    save(path, at_times(2), format=format, overwrite=True)
    assert load(path).t.tolist() == [2]
    with pytest.raises(OutputError, match="with block"):
        open_writer(path, size=SIZE, format=format, overwrite=True).append(at_times(1))
    with pytest.raises(InputError, match="no such file"):
        load(tmp_path / f"missing{EXTENSIONS[format]}", format=format)


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


@formats
def test_an_error_midway_keeps_the_old_file(tmp_path: Path, format: str) -> None:
    def packets() -> Iterator[EventStream]:
        yield at_times(5)
        raise RuntimeError("the simulator stopped")

    path = save(tmp_path / f"e{EXTENSIONS[format]}", at_times(1), format=format)
    with pytest.raises(RuntimeError, match="the simulator stopped"):
        save(path, EventPackets(packets(), SIZE), format=format, overwrite=True)
    assert load(path).t.tolist() == [1]
    assert list(tmp_path.iterdir()) == [path]
