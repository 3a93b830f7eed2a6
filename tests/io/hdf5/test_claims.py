"""HDF5 files that claim more than they hold, which would hang a reader or fill its memory."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from texvent.errors import FileFormatError
from texvent.io.files import load, open_events
from texvent.io.hdf5.storage import MAX_CHUNK_BYTES
from texvent.sensor import SensorSize

SIZE = SensorSize(6, 5)
COLUMNS = {"x": "u2", "y": "u2", "t": "i8", "p": "u1"}
FOR_EVER = 2**50


def write_columns(path: Path, **options: Any) -> Path:
    with h5py.File(path, "w") as file:
        for name, dtype in COLUMNS.items():
            file.create_dataset(f"events/{name}", dtype=dtype, **options)
    return path


def test_columns_that_nothing_stored_stands_behind_are_refused(tmp_path: Path) -> None:
    path = write_columns(tmp_path / "e.h5", shape=(FOR_EVER,), chunks=(1 << 16,), compression=1)
    assert path.stat().st_size < 20_000
    with pytest.raises(FileFormatError, match=f"claims {FOR_EVER} values and stores at most 0"):
        open_events(path, size=SIZE)


def test_rows_of_v2e_that_nothing_stored_stands_behind_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "e.h5"
    with h5py.File(path, "w") as file:
        file.create_dataset("events", (FOR_EVER, 4), "u4", chunks=(1 << 16, 4), compression=1)
    with pytest.raises(FileFormatError, match="stores at most 0"):
        open_events(path, size=SIZE)


def test_a_chunk_that_would_fill_the_memory_is_refused(tmp_path: Path) -> None:
    length = MAX_CHUNK_BYTES // 2 + 1
    path = write_columns(tmp_path / "e.h5", shape=(length,), chunks=(length,), compression=1)
    with pytest.raises(FileFormatError, match="has chunks of 268435458 bytes; at most 268435456"):
        open_events(path, size=SIZE)


@pytest.mark.parametrize("name", ["t_offset", "texvent"])
def test_other_values_that_would_fill_the_memory_are_refused(tmp_path: Path, name: str) -> None:
    path = write_columns(tmp_path / "e.h5", data=np.zeros(0))
    with h5py.File(path, "a") as file:
        file.create_dataset(name, (FOR_EVER,), "u1", chunks=(1 << 16,))
    with pytest.raises(FileFormatError, match=r"t_offset must be one|stores at most 0"):
        load(path, size=SIZE)
