"""Chunks packed outside HDF5 are what its own filters unpack."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from texvent.io.hdf5.storage import append_chunks

CHUNK = 8


def create(file: h5py.File, dtype: str) -> h5py.Dataset:
    return file.create_dataset(
        "column", (0,), dtype, maxshape=(None,), chunks=(CHUNK,), compression="gzip", shuffle=True
    )


@pytest.mark.parametrize("dtype", ["<u2", "<i8", "<u4", "|u1"])
@pytest.mark.parametrize("lengths", [(0,), (1,), (CHUNK,), (2 * CHUNK, 0, CHUNK, 3)])
def test_h5py_reads_back_what_was_appended(
    tmp_path: Path, dtype: str, lengths: tuple[int, ...]
) -> None:
    rng = np.random.default_rng(0)
    parts = [rng.integers(0, 250, length).astype(dtype) for length in lengths]
    with h5py.File(tmp_path / "a.h5", "w", libver=("v110", "v110")) as file:
        dataset = create(file, dtype)
        for part in parts:
            append_chunks(dataset, part)
    with h5py.File(tmp_path / "a.h5") as file:
        np.testing.assert_array_equal(file["column"][()], np.concatenate(parts))
