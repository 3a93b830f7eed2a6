"""Universal HDF5: DSEC's layout with absolute times, read by most event-camera software.

    events/x  u2   events/y  u2   events/t  i8, µs   events/p  u1, 1 = ON
    events/label u1, 1 = noise, where the run was told to store it
    ms_to_idx u8   ms_to_idx[m] = index of the first event with t >= 1000 m (n if there is none)
    t_offset  i8   added to events/t; 0
    root attributes: width, height, timestamp_scale_ms = 0.001, t_offset again (checksummed),
                     texvent = all metadata as JSON, and its top-level scalars by name

Files are streamed in compressed chunks (gzip 1 + shuffle), so plain h5py reads them. Metadata
blocks carry HDF5's checksums (file version 1.10) and gzip checks its data, so damage is noticed
instead of read as events. DSEC's own files (t u4 relative to t_offset) are read too.

Deviation from DSEC: ms_to_idx has one closing entry n, so that a window that ends after the last
event needs no special case. A recording that starts more than 19 hours after zero (clock times)
is stored relative to its first millisecond in t_offset, as DSEC does, because ms_to_idx would
not fit otherwise.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, ClassVar

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import FileFormatError, InputError, MissingDependencyError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.columns import (
    existing_file,
    metadata_from_json,
    stored_or_given_size,
    stream_from_file,
)
from texvent.io.hdf5.chunks import append_chunks
from texvent.io.hdf5.damage import check_claims, reporting_damage
from texvent.io.hdf5.writer import BatchedHdf5Writer
from texvent.sensor import SensorSize

TIMESTAMP_SCALE_MS = 0.001
"""Milliseconds per unit of events/t: µs."""
CHUNK_EVENTS = 65_536
CHUNK_INDEX = 4096
PACKET_EVENTS = 1_048_576
INDEX_PIECE = 1_048_576
MAX_START_US = 1 << 36
"""19 h: a later start is stored in t_offset."""
MAX_SPAN_US = 1 << 37
"""38 h: ms_to_idx would pass 1 GB beyond this."""
MAX_ATTRIBUTE_BYTES = 32_768
"""Longer metadata goes to a dataset: many readers stop at 64 kB per attribute."""
MAX_PLAIN_ATTRIBUTES = 64
MAX_PLAIN_BYTES = 2048
COLUMNS: Mapping[str, str] = {"x": "<u2", "y": "<u2", "t": "<i8", "p": "|u1"}
RESERVED = ("width", "height", "timestamp_scale_ms", "texvent")


class Hdf5Codec:
    """Universal HDF5 and DSEC files."""

    name: ClassVar[str] = "hdf5"
    extensions: ClassVar[tuple[str, ...]] = (".h5", ".hdf5")

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of a file, a million at a time; the file is opened anew for each pass.

        Raises:
            InputError: no such file, or it stores no sensor size and none is given.
            FileFormatError: the file is damaged or has another layout.
            MissingDependencyError: it is compressed with a filter that needs hdf5plugin.
        """
        path = existing_file(path)
        with reporting_damage(path), h5py.File(path, "r") as file:
            _checked_columns(file, path)
            stored = stored_size(file)
            metadata = read_metadata(file, path)
        final_size = stored_or_given_size(path, stored, size)
        return EventPackets(_Packets(path, final_size, metadata), final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> Hdf5Writer:
        """Start a file; see `EventCodec.open_writer`."""
        return Hdf5Writer(path, size=size, metadata=metadata, overwrite=overwrite)


class Hdf5Writer(BatchedHdf5Writer):
    """Appends packets to a universal HDF5 file; memory does not grow with the recording.

    Raises:
        OutputError: the file exists already, its folder refuses it, or the disk is full.
        InputError: a packet of another size, before the one before it, or before time 0.
    """

    chunk_events: ClassVar[int] = CHUNK_EVENTS
    time_type: ClassVar[str] = COLUMNS["t"]
    filters: Mapping[str, Any] = MappingProxyType(
        {"compression": "gzip", "compression_opts": 1, "shuffle": True}
    )
    max_start_us: ClassVar[int] = MAX_START_US
    max_span_us: ClassVar[int] = MAX_SPAN_US

    def __init__(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> None:
        super().__init__(path, size=size, metadata=metadata, overwrite=overwrite)
        self._next_ms = 0
        self._offset_us: int | None = None
        self._has_label: bool | None = None

    def _check(self, packet: EventStream) -> None:
        self._check_time(packet)
        self._check_label(packet)

    def _check_time(self, packet: EventStream) -> None:
        first, last = int(packet.t[0]), int(packet.t[-1])
        if first < 0:
            raise InputError(f"an event has time {first} µs; event files start at 0 or later")
        if self._offset_us is None:
            self._offset_us = first // 1000 * 1000 if first >= self.max_start_us else 0
        if last - self._offset_us > self.max_span_us:
            raise InputError(
                f"events span {(last - self._offset_us) / 3.6e9:.3g} h; this file holds up to "
                f"{self.max_span_us / 3.6e9:.3g} h: split the recording, or check its time unit"
            )

    def _check_label(self, packet: EventStream) -> None:
        """The first events decide whether the file has a label column."""
        has_label = packet.label is not None
        if self._has_label is None:
            self._has_label = has_label
            if has_label:
                self._create_column("events/label", "|u1", self.chunk_events)
        elif has_label != self._has_label:
            raise InputError(
                "some packets have a signal/noise label and some do not; give all or none one"
            )

    def _create_layout(self) -> None:
        file = self._file
        for name, dtype in {**COLUMNS, "t": self.time_type}.items():
            self._create_column(f"events/{name}", dtype, self.chunk_events)
        self._create_column("ms_to_idx", "<u8", CHUNK_INDEX)
        file.attrs["width"], file.attrs["height"] = self._size
        file.attrs["timestamp_scale_ms"] = TIMESTAMP_SCALE_MS
        write_metadata(file, self._json, self._metadata)

    def _create_column(self, name: str, dtype: str, chunk: int) -> None:
        self._file.create_dataset(
            name,
            shape=(0,),
            maxshape=(None,),
            dtype=dtype,
            chunks=(chunk,),
            **self.filters,
        )

    def _store(self, events: EventStream, count: int) -> None:
        times = events.t[:count] - (self._offset_us or 0)
        self._index(times)
        for name, values in events.columns().items():
            self._extend_column(name, times if name == "t" else values[:count])

    def _extend_column(self, name: str, values: NDArray[Any]) -> None:
        append_chunks(self._file[f"events/{name}"], values)

    def _index(self, times: NDArray[np.int64]) -> None:
        """Extend ms_to_idx up to the last of these times, µs after t_offset."""
        last_ms = int(times[-1]) // 1000
        while self._next_ms <= last_ms:
            stop = min(last_ms + 1, self._next_ms + INDEX_PIECE)
            starts_us = np.arange(self._next_ms, stop, dtype=np.int64) * 1000
            indexes = np.searchsorted(times, starts_us, side="left") + self._written
            self._extend("ms_to_idx", indexes)
            self._next_ms = stop

    def _complete(self) -> None:
        self._extend("ms_to_idx", np.array([self._written], dtype=np.uint64))
        self._file["t_offset"] = np.int64(self._offset_us or 0)
        # A single value has no checksum; attributes lie in the header, which has one.
        self._file.attrs["t_offset"] = np.int64(self._offset_us or 0)


class _Packets:
    """Re-iterable packets of a checked file."""

    def __init__(self, path: Path, size: SensorSize, metadata: Mapping[str, Any]) -> None:
        self._path = path
        self._size = size
        self._metadata = metadata

    def __iter__(self) -> Iterator[EventStream]:
        return self._read(None)

    def between(self, start_us: int, stop_us: int) -> Iterator[EventStream]:
        """The packets of `start_us <= t < stop_us`, found by bisection of the times."""
        return self._read((start_us, stop_us))

    @property
    def time_range(self) -> tuple[int, int] | None:
        """Half-open range [first, last + 1) of the event times, µs, or None without events."""
        with reporting_damage(self._path), h5py.File(self._path, "r") as file:
            times = _checked_columns(file, self._path)["t"]
            offset_us = _time_offset(file, self._path)
            if not len(times):
                return None
            return int(times[0]) + offset_us, int(times[-1]) + offset_us + 1

    def _read(self, window_us: tuple[int, int] | None) -> Iterator[EventStream]:
        with reporting_damage(self._path):
            file = h5py.File(self._path, "r")
        with file:
            with reporting_damage(self._path):
                columns = _checked_columns(file, self._path)
                offset_us = _time_offset(file, self._path)
                first, end = _find(columns["t"], window_us, offset_us)
            last_us: int | None = None
            for start in range(first, end, PACKET_EVENTS):
                with reporting_damage(self._path):
                    stop = min(start + PACKET_EVENTS, end)
                    packet = self._packet(columns, slice(start, stop), offset_us)
                if last_us is not None and int(packet.t[0]) < last_us:
                    raise FileFormatError(f"{self._path}: time decreases at event {start}")
                last_us = int(packet.t[-1])
                # Outside `reporting_damage`: the caller's own errors are not the file's.
                yield packet

    def _packet(self, columns: Mapping[str, Any], where: slice, offset_us: int) -> EventStream:
        part = {name: column[where] for name, column in columns.items()}
        part["t"] = part["t"].astype(np.int64) + offset_us
        return stream_from_file(self._path, part, self._size, self._metadata)


def _find(times: Any, window_us: tuple[int, int] | None, offset_us: int) -> tuple[int, int]:
    """Index of the first event of a window, and of the first after it; the column is not read.

    Not by ms_to_idx: files of others lack it or have it in other units.
    """
    if window_us is None:
        return 0, len(times)
    everything, first = range(len(times)), 0
    found = []
    for t_us in window_us:
        first = bisect_left(everything, t_us - offset_us, lo=first, key=lambda i: int(times[i]))
        found.append(first)
    return found[0], found[1]


def _checked_columns(file: Any, path: Path) -> dict[str, Any]:
    """The four or five datasets, if the file has this layout."""
    missing = [name for name in COLUMNS if f"events/{name}" not in file]
    if missing:
        raise FileFormatError(
            f"{path} is HDF5 but has no events/{missing[0]}; texvent reads the DSEC and universal "
            "layout: events/x, events/y, events/t, events/p"
        )
    names = [*COLUMNS, "label"] if "events/label" in file else [*COLUMNS]
    columns = {name: file[f"events/{name}"] for name in names}
    shapes = {name: column.shape for name, column in columns.items()}
    if any(len(shape) != 1 for shape in shapes.values()) or len(set(shapes.values())) != 1:
        raise FileFormatError(f"{path}: the columns of events differ in length: {shapes}")
    for name, column in columns.items():
        if column.dtype.kind not in "iub":
            raise FileFormatError(f"{path}: events/{name} holds {column.dtype}, not integers")
        check_filters(column, path)
        check_claims(column, path)
    scale = float(file.attrs.get("timestamp_scale_ms", TIMESTAMP_SCALE_MS))
    if not np.isclose(scale, TIMESTAMP_SCALE_MS):
        raise FileFormatError(f"{path} counts time in units of {scale:g} ms; texvent reads 0.001")
    return columns


def check_filters(column: Any, path: Path) -> None:
    """Ask for hdf5plugin where a file, such as DSEC's, is compressed with a foreign filter."""
    properties = column.id.get_create_plist()
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


def _time_offset(file: Any, path: Path) -> int:
    if "t_offset" not in file:
        return 0
    value = file["t_offset"]
    if value.size != 1 or value.dtype.kind not in "iu":
        raise FileFormatError(f"{path}: t_offset must be one whole number; it is {value!r}")
    offset_us = int(np.asarray(value[()]).reshape(-1)[0])
    if int(file.attrs.get("t_offset", offset_us)) != offset_us:
        raise FileFormatError(
            f"{path} is damaged: t_offset is {offset_us}, written as {file.attrs['t_offset']}"
        )
    return offset_us


def stored_size(file: Any) -> tuple[int, int] | None:
    """Width and height, pixels, from the root's attributes."""
    if "width" not in file.attrs or "height" not in file.attrs:
        return None
    return int(file.attrs["width"]), int(file.attrs["height"])


def write_metadata(file: Any, text: str, metadata: Mapping[str, Any]) -> None:
    """All metadata as JSON, and its top-level scalars by name for people who look inside.

    The JSON has a fixed length, so it lies in the checksummed header. HDF5 keeps text of variable
    length in a heap without checksums, where one flipped bit can hang it; texvent never reads
    the named scalars back.
    """
    fixed = np.bytes_(text.encode("ascii"))
    if len(text) <= MAX_ATTRIBUTE_BYTES:
        file.attrs["texvent"] = fixed
    else:
        file.create_dataset("texvent", data=fixed)
    scalars = [
        (name, value)
        for name, value in metadata.items()
        if name not in RESERVED and _is_plain_attribute(name) and _is_plain_attribute(value)
    ]
    for name, value in scalars[:MAX_PLAIN_ATTRIBUTES]:
        file.attrs[name] = value


def _is_plain_attribute(value: Any) -> bool:
    if isinstance(value, str):
        # HDF5 text cannot hold NUL or unpaired surrogates; the JSON form can.
        encoded = value.encode("utf-8", errors="replace")
        sound = encoded.decode("utf-8") == value and "\0" not in value
        return sound and 0 < len(encoded) <= MAX_PLAIN_BYTES
    if isinstance(value, int):
        return -(2**63) <= value < 2**63
    return isinstance(value, float)


def read_metadata(file: Any, path: Path) -> dict[str, Any]:
    """What `write_metadata` wrote, or nothing."""
    text = file.attrs.get("texvent")
    if text is None and isinstance(file.get("texvent"), h5py.Dataset):
        check_claims(file["texvent"], path)
        text = file["texvent"][()]
    return {} if text is None else metadata_from_json(path, text)
