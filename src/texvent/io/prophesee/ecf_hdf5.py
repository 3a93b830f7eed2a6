"""HDF5 files of Prophesee's Metavision: events in chunks that their own filter, ECF, compresses.

    /CD/events            x u2, y u2, p i2, t i8 in 16 bytes; chunks of 16384, filter 0x8ECF
    /CD/indexes           id u8, ts i8, every 2 ms (`texvent.io.prophesee.ecf_index`);
                          attribute offset = −(time of the first event), as text
    /EXT_TRIGGER/events   p i2, t i8, id i2; empty
    /EXT_TRIGGER/indexes  empty
    root attributes       version, format, geometry (1280x720), …: all text

OpenEB reads every root attribute as ASCII text of variable length and fails on any other kind;
how the events were made is therefore an attribute of /CD: `texvent` as JSON, `width`, `height`.
Those are stored in checksummed headers, as in `texvent.io.hdf5.native`. Chunks are coded by texvent
(`io.prophesee.ecf_chunks`) and passed by HDF5 as they are, so no HDF5 filter needs to be installed.

Coordinates below 2048; at most 9.5 hours from the first event to the last, because the index
grows with the duration: 8 kB per second.

Read are also files whose chunks are not coded, or by a filter that HDF5 knows.

Source: Prophesee, "HDF5 Event Files", and OpenEB.
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
from texvent.io.block_codec import FileContents
from texvent.io.block_writer import FileTarget
from texvent.io.hdf5.damage import open_hdf5
from texvent.io.hdf5.native import read_metadata, stored_size, write_metadata
from texvent.io.hdf5.writer import Hdf5BlockCodec, Hdf5Sink
from texvent.io.limits import FormatLimits
from texvent.io.prophesee import ecf_chunks
from texvent.io.prophesee.ecf_dataset import ECF_FILTER, check_storage, read_columns, whole_chunks
from texvent.io.prophesee.ecf_index import ENTRY, TimeIndex
from texvent.io.protocol import Columns
from texvent.io.timed_rows import TimedRows, read_rows, seek_rows

CHUNK_EVENTS = 16_384
PACKET_CHUNKS = 16
MAX_SPAN_US = 1 << 35
EVENT = np.dtype(
    {
        "names": ["x", "y", "p", "t"],
        "formats": ["<u2", "<u2", "<i2", "<i8"],
        "offsets": [0, 2, 4, 8],
        "itemsize": 16,
    }
)
TRIGGER = np.dtype(
    {
        "names": ["p", "t", "id"],
        "formats": ["<i2", "<i8", "<i2"],
        "offsets": [0, 8, 16],
        "itemsize": 24,
    }
)


class EcfHdf5Sink(Hdf5Sink):
    """Appends coded chunks, and keeps the time index."""

    def _create_layout(self, target: FileTarget) -> None:
        self._index = TimeIndex()
        file = self._file
        properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        # Optional, as in Metavision: HDF5 then does not ask for the filter itself.
        properties.set_filter(ECF_FILTER, h5py.h5z.FLAG_OPTIONAL)
        self._create("CD/events", EVENT, properties)
        self._create("CD/indexes", ENTRY)
        self._create("EXT_TRIGGER/events", TRIGGER)
        self._create("EXT_TRIGGER/indexes", ENTRY)
        for name, text in {
            "version": "1.0",
            "format": "ECF",
            "geometry": str(target.size),
            "generation": "0.0",
            "camera_integrator_name": "Prophesee",
            "plugin_integrator_name": "Prophesee",
        }.items():
            _set_text(file, name, text)
        group = file["CD"]
        group.attrs["width"], group.attrs["height"] = target.size
        write_metadata(group, target.metadata)

    def _create(self, name: str, dtype: np.dtype[Any], properties: Any = None) -> None:
        self._file.create_dataset(
            name,
            shape=(0,),
            maxshape=(None,),
            chunks=(CHUNK_EVENTS,),
            dtype=dtype,
            dcpl=properties,
        )

    def store(self, columns: Columns) -> None:
        """As `Hdf5Sink.store`."""
        count = len(columns["t"])
        dataset = self._file["CD/events"]
        dataset.resize((self.written + count,))
        for start in range(0, count, CHUNK_EVENTS):
            part = slice(start, min(start + CHUNK_EVENTS, count))
            chunk = ecf_chunks.encode_chunk({name: columns[name][part] for name in "xytp"})
            dataset.id.write_direct_chunk((self.written + start,), chunk)
        for entries in self._index.add(columns["t"]):
            self._extend("CD/indexes", entries)

    def complete(self) -> None:
        """As `Hdf5Sink.complete`."""
        if self._index.start_us is not None:
            self._extend("CD/indexes", self._index.close())
            _set_text(self._file["CD/indexes"], "offset", str(-self._index.start_us))


class EcfHdf5Codec(Hdf5BlockCodec):
    """HDF5 files of Metavision."""

    name: ClassVar[str] = "prophesee-hdf5"
    extensions: ClassVar[tuple[str, ...]] = (".hdf5", ".h5")
    limits: ClassVar[FormatLimits] = FormatLimits(
        "Prophesee HDF5", ecf_chunks.MAX_SIDE, ecf_chunks.MAX_START_US, MAX_SPAN_US
    )
    sink: ClassVar[type[Hdf5Sink]] = EcfHdf5Sink

    def recognises(self, path: Path) -> bool:
        """True if it is HDF5 with events where Metavision puts them."""
        try:
            with open_hdf5(path) as file:
                return "CD/events" in file
        except FileFormatError:
            return False

    def inspect(self, path: Path) -> FileContents:
        """Size and metadata are attributes of the root and of /CD."""
        with open_hdf5(path) as file:
            _checked_events(file, path)
            size, metadata = _stored_size(file), _read_metadata(file, path)
        rows = partial(_open_rows, path)
        return FileContents(size, metadata, partial(read_rows, rows), seek_rows(path, rows))


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


def _stored_size(file: Any) -> tuple[int, int] | None:
    stored = stored_size(file["CD"])
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


def _set_text(node: Any, name: str, text: str) -> None:
    """ASCII of variable length, the only kind OpenEB reads; h5py's own text is UTF-8."""
    node.attrs.create(name, text, dtype=h5py.string_dtype("ascii"))
