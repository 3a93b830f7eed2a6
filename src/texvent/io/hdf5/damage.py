"""Damaged and hostile HDF5 files, as one clear error."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py

from texvent._require import require
from texvent.errors import FileFormatError, MissingDependencyError
from texvent.io.input_checks import reporting_damage

HDF5_DAMAGE = (
    *(OSError, RuntimeError, KeyError, ValueError, TypeError, AttributeError, MemoryError),
    OverflowError,
)
"""h5py raises any of these on a damaged file."""
MAX_CHUNK_BYTES = 256 * 2**20
"""HDF5 unpacks whole chunks: larger ones would fill the memory."""


@contextmanager
def open_hdf5(path: Path) -> Iterator[Any]:
    """An HDF5 file to read; what h5py raises inside the block names the file.

    Raises:
        FileFormatError: the file is damaged.
    """
    with (
        reporting_damage(path, "an HDF5 event file", HDF5_DAMAGE),
        h5py.File(path, "r") as file,
    ):
        yield file


def check_claims(dataset: Any, path: Path) -> None:
    """Refuse a dataset that would take too long to read, or more memory than there is.

    HDF5 gives zeros where nothing is stored, so a file of 4 kB can claim 10^18 events; and a chunk
    of zeros shrinks to a thousandth.

    Raises:
        FileFormatError: more values are claimed than stored, or chunks are too large.
    """
    if dataset.chunks is None:
        stored = dataset.id.get_storage_size() // dataset.dtype.itemsize
    else:
        length = math.prod(dataset.chunks)
        if length * dataset.dtype.itemsize > MAX_CHUNK_BYTES:
            raise FileFormatError(
                f"{path}: {dataset.name} has chunks of {length * dataset.dtype.itemsize} bytes; "
                f"at most {MAX_CHUNK_BYTES}. If the file is sound, h5repack makes them smaller"
            )
        stored = dataset.id.get_num_chunks() * length
    if stored < dataset.size:
        raise FileFormatError(
            f"{path} is damaged: {dataset.name} claims {dataset.size} values and stores at most "
            f"{stored}"
        )


def check_filters(dataset: Any, path: Path) -> None:
    """Load hdf5plugin where a file, such as DSEC's, is compressed with a foreign filter.

    Raises:
        MissingDependencyError: it is not installed.
    """
    properties = dataset.id.get_create_plist()
    filters = [properties.get_filter(index)[0] for index in range(properties.get_nfilters())]
    if all(h5py.h5z.filter_avail(code) for code in filters):
        return
    try:
        require("hdf5plugin")
    except MissingDependencyError as error:
        raise MissingDependencyError(
            f"{path} is compressed with an HDF5 filter that h5py does not bring (blosc in DSEC "
            "files); install it with: pip install hdf5plugin"
        ) from error
