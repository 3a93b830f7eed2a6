"""HDF5 files of Prophesee's Metavision, read without their HDF5 filter, ECF (0x8ECF).

    /CD/events        x u2, y u2, p i2, t i8 in 16 bytes; chunks of 16384
    root attributes   geometry (1280x720), …: all text

A chunk of ECF, little-endian:

    u32   number of events n (at most 65535) << 2 | f1 << 1 | f0
    u64   time of the first event, µs
    times     runs of equal times; a byte is the step from the time before << 4 | number of events.
              Number 15: the number follows in 16 bits. Step 15: no run, but four bits of a longer
              step, lowest first, that the next run adds to its own.
    f1 = 1    24 bits per event, y << 12 | x << 1 | p, in groups of four; three words of 32 bits:
              a << 8 | b & 0xff · (b >> 8) << 16 | c & 0xffff · (c >> 16) << 24 | d
    f1 = 0    rows: words y << 5 | number of events, 31: the number follows in 16 bits; then
      f0 = 1      12 bits per event, x << 1 | p, in groups of four; three words of 16 bits:
                  a << 4 | b & 0xf · (b >> 4) << 8 | c & 0xff · (c >> 8) << 12 | d
      f0 = 0      columns: words x << 5 | mask; bit 4 − j: another event at x + j + 1; then
                  polarities: bytes p << 7 | number of events, 127: the number follows in 16 bits

Uncompressed files and standard HDF5 filters are read too, and `texvent`, `width`, `height` of /CD,
which development versions of texvent wrote.

Source: Prophesee, "HDF5 Event Files", OpenEB and `hdf5_ecf` (the reference filter).
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError
from texvent.events import COLUMN_TYPES
from texvent.io.block_codec import BlockReader, FileContents, TimedRows, contents_of_rows
from texvent.io.block_writer import Columns
from texvent.io.hdf5.attributes import read_metadata, stored_size
from texvent.io.hdf5.dsec import data_sets_beside
from texvent.io.hdf5.storage import check_claims, open_hdf5
from texvent.io.reading import ReadOptions

MAX_EVENTS = 65_535
MAX_START_US = 1 << 62
"""Largest start of the times of a chunk; see `texvent.io.prophesee.ecf_coding`."""
_HEAD = struct.Struct("<IQ")


def decode_chunk(chunk: bytes) -> Columns:
    """Columns x, y, t, p of a chunk.

    Raises:
        FileFormatError: the chunk is damaged.
    """
    if len(chunk) < _HEAD.size:
        raise FileFormatError(f"an ECF chunk has {len(chunk)} bytes; at least {_HEAD.size}")
    head, origin = _HEAD.unpack_from(chunk)
    count = head >> 2
    if count > MAX_EVENTS or origin >= MAX_START_US:
        raise FileFormatError(
            f"an ECF chunk claims {count} events from {origin} µs on; at most {MAX_EVENTS}"
        )
    columns = {name: np.empty(count, dtype=COLUMN_TYPES[name]) for name in "xytp"}
    body = np.frombuffer(chunk, dtype=np.uint8, offset=_HEAD.size)
    _decode_body(body, origin, head & 0b11, columns)
    return columns


def _decode_body(body: NDArray[np.uint8], origin: int, flags: int, columns: Columns) -> None:
    from texvent.io.prophesee import ecf_coding  # brings Numba

    x, y, t, p = (columns[name] for name in "xytp")
    rest = _skip(body, ecf_coding.decode_times(body, origin, t))
    if flags & 0b10:
        _skip(rest, ecf_coding.decode_packed(rest, (x, y, p)))
        return
    rest = _skip(rest, ecf_coding.decode_rows(rest, y))
    if flags & 0b01:
        _skip(rest, ecf_coding.decode_pairs(rest, (x, p)))
        return
    rest = _skip(rest, ecf_coding.decode_masked(rest, x))
    _skip(rest, ecf_coding.decode_polarities(rest, p))


def _skip(body: NDArray[np.uint8], used: int) -> NDArray[np.uint8]:
    if used < 0:
        raise FileFormatError("an ECF chunk is damaged: its events do not add up")
    return body[used:]


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


CHUNK_EVENTS = 16_384
PACKET_CHUNKS = 16


class EcfHdf5Codec(BlockReader):
    """HDF5 files of Metavision."""

    name: ClassVar[str] = "prophesee-hdf5"
    extensions: ClassVar[tuple[str, ...]] = (".hdf5", ".h5")

    def recognises(self, path: Path) -> bool:
        """True if it is HDF5 with events where Metavision puts them."""
        try:
            with open_hdf5(path) as file:
                return "CD/events" in file
        except InputError:  # damaged, or open elsewhere
            return False

    def beside(self, path: Path) -> Iterator[str]:
        """External triggers."""
        return data_sets_beside(path)

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata are attributes of the root and of /CD."""
        with open_hdf5(path) as file:
            _checked_events(file, path)
            size, metadata = _stored_size(file, path), _read_metadata(file, path)
        rows = partial(_open_rows, path)
        return contents_of_rows(size, metadata, rows)


@contextmanager
def _open_rows(path: Path) -> Iterator[TimedRows]:
    """Not by CD/indexes: its times are relative, and files of others lack it."""
    with open_hdf5(path) as file:
        events = _checked_events(file, path)
        count, unit = events.shape[0], whole_chunks(events, 1)

        def read(start: int, stop: int) -> Columns:
            return read_columns(events, start, stop)

        def time_of(index: int) -> int:
            first = index // unit * unit
            return int(read(first, index + 1)["t"][-1])

        yield TimedRows(
            count, time_of, read, whole_chunks(events, PACKET_CHUNKS * CHUNK_EVENTS), unit
        )


def _checked_events(file: Any, path: Path) -> Any:
    """The dataset of events, if it has the fields, and the chunks it claims."""
    events = file.get("CD/events")
    if not isinstance(events, h5py.Dataset):
        raise FileFormatError(
            f"{path} is HDF5 but has no dataset CD/events, where Metavision stores events"
        )
    names = events.dtype.names or ()
    wrong = [name for name in "xypt" if name not in names or events.dtype[name].kind not in "iu"]
    if wrong or len(events.shape) != 1:
        raise FileFormatError(
            f"{path}: CD/events must be a list of x, y, p, t; it holds {events.dtype}"
        )
    check_storage(events, path)
    return events


def _stored_size(file: Any, path: Path) -> tuple[int, int] | None:
    stored = stored_size(file["CD"], path)
    if stored is not None or "geometry" not in file.attrs:
        return stored
    width, _, height = _text(file.attrs["geometry"]).partition("x")
    return int(width), int(height)


def _read_metadata(file: Any, path: Path) -> dict[str, Any]:
    metadata = read_metadata(file["CD"], path)
    if metadata is not None:
        return metadata
    # What Metavision wrote about the recording.
    return {"header": {name: _text(value) for name, value in file.attrs.items()}}


def _text(value: Any) -> str:
    return value.decode("utf-8", errors="replace") if isinstance(value, bytes) else str(value)
