"""Chunks packed outside HDF5 are what its own filters unpack."""

import io
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from texvent.io.hdf5.storage import append_chunks, pack

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


def test_values_are_converted_to_the_type_of_the_dataset(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "a.h5", "w") as file:
        dataset = create(file, "<u4")
        append_chunks(dataset, np.array([1, 2**32 - 1], np.int64))
        assert dataset[()].tolist() == [1, 2**32 - 1]


@given(arrays.arrays(np.uint16, st.integers(CHUNK, CHUNK)))
def test_packing_is_lossless(values: np.ndarray) -> None:
    with h5py.File(io.BytesIO(), "w") as file:
        dataset = create(file, "<u2")
        dataset.resize((CHUNK,))
        dataset.id.write_direct_chunk((0,), pack(values))
        np.testing.assert_array_equal(dataset[()], values)
