"""HDF5 files that claim more than they hold, which would hang a reader or fill its memory."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from texvent.errors import FileFormatError
from texvent.io.files import load, open_events
from texvent.io.hdf5.storage import DEEPEST, MAX_CHUNK_BYTES
from texvent.sensor import SensorSize

SIZE = SensorSize(6, 5)
COLUMNS = {"x": "u2", "y": "u2", "t": "i8", "p": "u1"}
FOR_EVER = 2**50


def write_columns(path: Path, **options: Any) -> Path:
    with h5py.File(path, "w") as file:
        for name, dtype in COLUMNS.items():
            file.create_dataset(f"events/{name}", dtype=dtype, **options)
    return path


def test_columns_that_nothing_stored_stands_behind_are_refused(tmp_path):
    path = write_columns(tmp_path / "e.h5", shape=(FOR_EVER,), chunks=(1 << 16,), compression=1)
    assert path.stat().st_size < 20_000
    with pytest.raises(FileFormatError, match=f"claims {FOR_EVER} values and stores at most 0"):
        open_events(path, size=SIZE)


def test_rows_of_v2e_that_nothing_stored_stands_behind_are_refused(tmp_path):
    path = tmp_path / "e.h5"
    with h5py.File(path, "w") as file:
        file.create_dataset("events", (FOR_EVER, 4), "u4", chunks=(1 << 16, 4), compression=1)
    with pytest.raises(FileFormatError, match="stores at most 0"):
        open_events(path, size=SIZE)


def test_a_chunk_that_would_fill_the_memory_is_refused(tmp_path):
    length = MAX_CHUNK_BYTES // 2 + 1
    path = write_columns(tmp_path / "e.h5", shape=(length,), chunks=(length,), compression=1)
    with pytest.raises(FileFormatError, match="has chunks of 268435458 bytes; at most 268435456"):
        open_events(path, size=SIZE)


@pytest.mark.parametrize("name", ["t_offset", "texvent"])
def test_other_values_that_would_fill_the_memory_are_refused(tmp_path, name):
    path = write_columns(tmp_path / "e.h5", data=np.zeros(0))
    with h5py.File(path, "a") as file:
        file.create_dataset(name, (FOR_EVER,), "u1", chunks=(1 << 16,))
    with pytest.raises(FileFormatError, match=r"t_offset must be one|stores at most 0"):
        load(path, size=SIZE)


RECORDS = np.zeros(9, [("x", "u2"), ("y", "u2"), ("p", "i2"), ("t", "i8")])


def write_recording(file: Any) -> None:
    for name, dtype in COLUMNS.items():
        file[f"events/{name}"] = np.zeros(9, dtype)


def stored_elsewhere(name: str, dtype: Any, count: int) -> Callable[[Any], None]:
    """A data set whose bytes are those of another file."""

    def change(file: Any) -> None:
        file.pop(name, None)
        bytes_there = count * np.dtype(dtype).itemsize
        file.create_dataset(name, (count,), dtype, external=[("secret", 0, bytes_there)])

    return change


def linked_elsewhere(name: str, there: str) -> Callable[[Any], None]:
    def change(file: Any) -> None:
        file.pop(name, None)
        file[name] = h5py.ExternalLink("other.h5", there)

    return change


def put_together(file: Any) -> None:
    """A column made of another file's."""
    layout = h5py.VirtualLayout((9,), "u2")
    layout[:] = h5py.VirtualSource("other.h5", "events/x", (9,))
    del file["events/x"]
    file.create_virtual_dataset("events/x", layout)


@pytest.mark.parametrize(
    "change",
    [
        stored_elsewhere("events/x", "u1", 9),
        stored_elsewhere("t_offset", "i8", 1),
        stored_elsewhere("events/t_offset", "i8", 1),
        stored_elsewhere("events/calib/resolution", "i4", 2),
        stored_elsewhere("texvent", "S1", 9),
        stored_elsewhere("CD/events", RECORDS.dtype, 3),
        linked_elsewhere("events", "/events"),
        linked_elsewhere("events/x", "/events/x"),
        linked_elsewhere("t_offset", "/t_offset"),
        linked_elsewhere("events/calib", "/calib"),
        linked_elsewhere("CD", "/CD"),
        linked_elsewhere("CD/events", "/CD/events"),
        put_together,
    ],
)
def test_nothing_of_other_files_becomes_events(tmp_path, monkeypatch, change):
    monkeypatch.chdir(tmp_path)
    Path("secret").write_bytes(bytes(1000))
    with h5py.File("other.h5", "w") as file:
        write_recording(file)
        file["t_offset"], file["CD/events"], file["calib/resolution"] = 5, RECORDS, [9, 9]
    with h5py.File("e.h5", "w") as file:
        write_recording(file)
        change(file)
    with pytest.raises(FileFormatError, match=r"other files?[,;]"):
        load("e.h5", size=SIZE)


@pytest.mark.parametrize(("depth", "is_read"), [(DEEPEST - 1, True), (5000, False)])
def test_groups_are_followed_as_deep_as_recordings_nest(tmp_path, depth, is_read):
    path = tmp_path / "e.h5"
    with h5py.File(path, "w") as file:
        write_recording(file)
        group = file
        for _ in range(depth):
            group = group.create_group("g")
    if is_read:
        assert len(load(path, size=SIZE)) == 9
    else:
        with pytest.raises(FileFormatError, match=f"more than {DEEPEST} deep"):
            load(path, size=SIZE)


@pytest.mark.parametrize(
    "change",
    [
        lambda file: file.update(again=file["events"]),
        lambda file: file.__setitem__("events/back", file["/"]),
        lambda file: file.__setitem__("events/soft", h5py.SoftLink("/events/x")),
    ],
)
def test_links_within_a_file_are_sound(tmp_path, change):
    path = tmp_path / "e.h5"
    with h5py.File(path, "w") as file:
        write_recording(file)
        change(file)
    assert len(load(path, size=SIZE)) == 9
