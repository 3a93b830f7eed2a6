"""v2e's HDF5: one dataset `events`, u4 [n, 4], rows t (µs), x, y, p, compressed with gzip.

Times stay below 2^32 µs (71.6 min). texvent adds root attributes that v2e does not write: width,
height and texvent (all metadata as JSON). Files of v2e itself store no size: it is asked for.

v2e itself passes times through float32 before they get here, so after 17 s its own files have
lost the µs; texvent's keep them.

Source: Hu, Liu and Delbruck, v2e: From Video Frames to Realistic DVS Events, 2021, and its files.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import h5py
import numpy as np

from texvent.errors import FileFormatError
from texvent.io.block_codec import FileContents, TimedRows, read_rows, seek_rows
from texvent.io.block_writer import FileTarget, FormatLimits
from texvent.io.hdf5.native import read_metadata, stored_size, write_metadata
from texvent.io.hdf5.storage import Hdf5BlockCodec, Hdf5Sink, check_claims, check_filters, open_hdf5
from texvent.io.protocol import Columns

CHUNK_EVENTS = 65_536
PACKET_EVENTS = 8 * CHUNK_EVENTS
STOP_US = 1 << 32
ORDER = "txyp"


class V2eHdf5Sink(Hdf5Sink):
    """Appends rows to the dataset."""

    def _create_layout(self, target: FileTarget) -> None:
        self._file.attrs["width"], self._file.attrs["height"] = target.size
        write_metadata(self._file, target.metadata)
        self._file.create_dataset(
            "events",
            shape=(0, 4),
            maxshape=(None, 4),
            dtype="<u4",
            chunks=(CHUNK_EVENTS, 4),
            compression="gzip",
            compression_opts=1,
            shuffle=True,
        )

    def store(self, columns: Columns) -> None:
        """As `Hdf5Sink.store`."""
        rows = np.stack([columns[name].astype(np.uint32) for name in ORDER], axis=1)
        self._extend("events", rows)


class V2eHdf5Codec(Hdf5BlockCodec):
    """HDF5 as v2e writes it."""

    name: ClassVar[str] = "v2e"
    has_checksums: ClassVar[bool] = True
    limits: ClassVar[FormatLimits] = FormatLimits("v2e HDF5", 1 << 16, STOP_US)
    sink: ClassVar[type[Hdf5Sink]] = V2eHdf5Sink

    def recognises(self, path: Path) -> bool:
        """True if it is HDF5 with a dataset of four columns called events."""
        try:
            with open_hdf5(path) as file:
                return isinstance(file.get("events"), h5py.Dataset)
        except FileFormatError:
            return False

    def inspect(self, path: Path) -> FileContents:
        """Size and metadata are attributes that texvent adds."""
        with open_hdf5(path) as file:
            _checked_events(file, path)
            size, metadata = stored_size(file), read_metadata(file, path) or {}
        rows = partial(_open_rows, path)
        return FileContents(size, metadata, partial(read_rows, rows), seek_rows(path, rows))


def _checked_events(file: Any, path: Path) -> Any:
    """The dataset, if the file has this layout."""
    events = file.get("events")
    if not isinstance(events, h5py.Dataset):
        raise FileFormatError(f"{path} is HDF5 but has no dataset `events` as v2e writes it")
    if events.ndim != 2 or events.shape[1] != 4 or events.dtype.kind not in "iu":
        raise FileFormatError(
            f"{path}: events is {events.dtype} of shape {events.shape}; v2e writes integers [n, 4]"
        )
    check_filters(events, path)
    check_claims(events, path)
    return events


@contextmanager
def _open_rows(path: Path) -> Iterator[TimedRows]:
    with open_hdf5(path) as file:
        events = _checked_events(file, path)

        def read(start: int, stop: int) -> Columns:
            rows = events[start:stop].astype(np.int64)
            return {name: rows[:, index] for index, name in enumerate(ORDER)}

        yield TimedRows(events.shape[0], lambda index: int(events[index, 0]), read, PACKET_EVENTS)
