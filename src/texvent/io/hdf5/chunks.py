"""Chunks of an HDF5 dataset packed as its gzip and shuffle filters would, but outside HDF5.

HDF5 holds the interpreter's lock while it compresses, so nothing else would run meanwhile; zlib
and NumPy release it. Matches are searched only at distance one: in shuffled columns of events
that takes a third less time than gzip's own level 1 and packs a few percent tighter. Any reader of
HDF5 unpacks it, since how matches are found is the packer's choice (RFC 1951).
"""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

LEVEL = 1
WINDOW_BITS = 15
MEMORY_LEVEL = 9


def append_chunks(dataset: Any, values: NDArray[Any]) -> None:
    """Append to a dataset that has whole chunks, and the filters shuffle and gzip.

    Args:
        dataset: one-dimensional h5py dataset; its length is a multiple of its chunks'.
        values: what to append; the last chunk is filled up with zeros beyond the dataset's end.
    """
    known, chunk = dataset.shape[0], dataset.chunks[0]
    dataset.resize((known + len(values),))
    for start in range(0, len(values), chunk):
        full = np.zeros(chunk, dataset.dtype)
        part = values[start : start + chunk]
        full[: len(part)] = part
        dataset.id.write_direct_chunk((known + start,), pack(full))


def pack(values: NDArray[Any]) -> bytes:
    """Values as HDF5's shuffle and deflate filters store them.

    Args:
        values: [n] contiguous, any type.

    Returns:
        A zlib stream of all first bytes, then all second bytes, and so on.
    """
    shuffled = np.ascontiguousarray(values.view(np.uint8).reshape(-1, values.itemsize).T)
    packer = zlib.compressobj(LEVEL, zlib.DEFLATED, WINDOW_BITS, MEMORY_LEVEL, zlib.Z_RLE)
    return packer.compress(shuffled.data) + packer.flush()
