"""An HDF5 dataset of events, its chunks coded by ECF or not, read without an HDF5 filter."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.io.hdf5.damage import check_claims
from texvent.io.prophesee.ecf_chunks import MAX_EVENTS, decode_chunk
from texvent.io.protocol import Columns

ECF_FILTER = 0x8ECF
MAX_CHUNK_EVENTS = 1 << 22
"""Larger chunks would take more than 64 MB each."""


def check_storage(events: Any, path: Path) -> None:
    """Refuse a length beyond what is stored: it would take too long to read.

    Raises:
        FileFormatError: more events are claimed than stored, or chunks are too large.
    """
    largest = MAX_EVENTS if is_ecf(events) else MAX_CHUNK_EVENTS
    if events.chunks is not None and events.chunks[0] > largest:
        raise FileFormatError(
            f"{path}: CD/events has chunks of {events.chunks[0]} events; at most {largest}"
        )
    check_claims(events, path)


def is_ecf(events: Any) -> bool:
    """True if the chunks are coded by ECF and nothing else."""
    properties = events.id.get_create_plist()
    filters = [properties.get_filter(index)[0] for index in range(properties.get_nfilters())]
    return filters == [ECF_FILTER]


def whole_chunks(events: Any, count: int) -> int:
    """About `count` events: with ECF, the number in one or more whole chunks."""
    return events.chunks[0] * max(1, count // events.chunks[0]) if is_ecf(events) else count


def read_columns(events: Any, start: int, stop: int) -> Columns:
    """Columns x, y, t, p of the events from `start` on; with ECF, `start` begins a chunk.

    Raises:
        FileFormatError: a chunk is damaged.
    """
    if not is_ecf(events):
        return _columns_of(events[start:stop])
    length = events.chunks[0]
    parts = [
        _read_chunk(events, first, min(length, stop - first))
        for first in range(start, stop, length)
    ]
    return {name: np.concatenate([part[name] for part in parts]) for name in "xytp"}


def _read_chunk(events: Any, start: int, count: int) -> Columns:
    """Columns of a chunk of at least `count` events, of which those are taken."""
    limit = 64 * events.chunks[0] + 4096
    stored = events.id.get_chunk_info_by_coord((start,)).size
    if stored > limit:
        raise FileFormatError(f"the chunk at event {start} has {stored} bytes; at most {limit}")
    skipped, chunk = events.id.read_direct_chunk((start,))
    # HDF5 sets the bit of a filter it could not apply to this chunk.
    if skipped:
        columns = _columns_of(np.frombuffer(chunk, dtype=events.dtype))
    else:
        columns = decode_chunk(bytes(chunk))
    if len(columns["t"]) < count:
        raise FileFormatError(
            f"the chunk at event {start} holds {len(columns['t'])} events instead of {count}"
        )
    return {name: column[:count] for name, column in columns.items()}


def _columns_of(records: NDArray[Any]) -> Columns:
    return {name: np.ascontiguousarray(records[name]) for name in "xytp"}
