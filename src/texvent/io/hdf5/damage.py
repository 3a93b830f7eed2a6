"""Damaged and hostile HDF5 files, as one clear error."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError, MissingDependencyError

HDF5_DAMAGE = (OSError, RuntimeError, KeyError, ValueError, TypeError, AttributeError, MemoryError)
"""h5py raises any of these on a damaged file."""
MAX_CHUNK_BYTES = 256 * 2**20
"""HDF5 unpacks whole chunks: larger ones would fill the memory."""


@contextmanager
def reporting_damage(path: Path) -> Iterator[None]:
    """Turn what h5py raises inside the block into a FileFormatError that names the file.

    Raises:
        FileFormatError: the file is damaged.
    """
    try:
        yield
    except (InputError, MissingDependencyError):
        raise
    except HDF5_DAMAGE as error:
        reason = " ".join(str(error).split())[:200]
        raise FileFormatError(f"{path} is damaged or not an HDF5 event file ({reason})") from error


def check_claims(dataset: Any, path: Path) -> None:
    """Refuse a dataset that would take for ever to read, or more memory than there is.

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
