"""Events in HDF5: every layout that `texvent.io.tables` finds; universal and DSEC's are written.

The universal layout is DSEC's with absolute times, read by most event-camera software:

    events/x  u2   events/y  u2   events/t  i8, µs   events/p  u1, 1 = ON
    events/label u1, 1 = noise, if the run stores it
    events/instance u2, events/class_id u2: the object of each event, with --truth events
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

DSEC's own layout (`dsec`) has times in u4 after t_offset, the first event's millisecond, so a file
spans at most 2^32 µs (71.6 min), and closes ms_to_idx one entry earlier. Read with hdf5plugin are
also files packed with blosc, as DSEC's own. v2e's files, one data set `events` u4 [n, 4] of rows
t (µs), x, y, p, store no size, and after 17 s they have lost the µs, because v2e passes times
through float32.

Source: Gehrig et al., DSEC: A Stereo Event Camera Dataset for Driving Scenarios, RA-L 2021; Hu, Liu
and Delbruck, v2e: From Video Frames to Realistic DVS Events, 2021, and its files.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar, Protocol

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, shown
from texvent.events import COLUMN_TYPES, OPTIONAL_COLUMNS
from texvent.io.block_codec import BlockCodec, FileContents, TimedRows, contents_of_rows
from texvent.io.block_writer import BlockWriter, Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.hdf5.attributes import (
    read_metadata,
    stored_size,
    whole_attribute,
    write_metadata,
    write_scalars,
)
from texvent.io.hdf5.storage import (
    DeferredErrorFile,
    Hdf5Writer,
    append_chunks,
    as_stated,
    check_claims,
    check_filters,
    open_hdf5,
)
from texvent.io.input_checks import TIMESTAMP_SCALE_MS, begins_with, stated_unit
from texvent.io.reading import ReadOptions, choose, texts_of, unit_in_words
from texvent.io.table_search import find_tables
from texvent.io.tables import TABLE_OPTIONS, EventTable, time_offset

CHUNK_EVENTS = 65_536
INDEX_CHUNK = 4096
PACKET_EVENTS = 1_048_576
INDEX_BATCH = 1_048_576
MAX_START_US = 1 << 36
"""19 h: a later start is stored in t_offset."""
MAX_SPAN_US = 1 << 37
"""38 h: ms_to_idx would pass 1 GB beyond this."""
GZIP: Mapping[str, Any] = {"compression": "gzip", "compression_opts": 1, "shuffle": True}
COLUMN_FORMATS: Mapping[str, str] = {"x": "<u2", "y": "<u2", "t": "<i8", "p": "|u1"}
MOST_ARRAYS = 10_000
"""A file with more data sets is no recording."""
OFFSET = "t_offset"
"""Name of a single value that is added to the times of its group."""
UNIT_NAME = re.compile(r"((t|ts|times?|timestamps?)[_ ]?)?units?")
"""Name of an attribute that states the unit of times."""
ORIGIN = re.compile(r"(upper|top|lower|bottom)[ _-]*(left|right)?")
"""Attribute `origin`: the corner of the sensor from which x and y count."""
BESIDE = re.compile("(^|[/_])(images?|frames?|triggers?|imu)([/_]|$)")
"""Names of data sets of other sensors, or of what happened beside the events."""


@dataclass(frozen=True)
class OffsetLimits(FormatLimits):
    """Limits of a file whose times count from `t_offset`."""

    max_absolute_us: int = MAX_START_US
    """A recording that starts at this time or later is stored relative to its first millisecond."""

    def origin_us(self, first_us: int) -> int:
        """`t_offset` of a recording whose first event has this time, µs."""
        return first_us // 1000 * 1000 if first_us >= self.max_absolute_us else 0


class StoredColumns(Protocol):
    """The data sets of an open file, to which events are appended."""

    def store(self, columns: Columns) -> None:
        """Write events behind those stored so far, whole chunks except the last."""

    def complete(self) -> None:
        """Write what is known only at the end."""


class Hdf5Columns:
    """The columns of an open file, to which blocks are appended, and their index by millisecond.

    Blocks hold whole chunks, except the last.
    """

    def __init__(self, file: Any, target: FileTarget, limits: OffsetLimits, time_type: str) -> None:
        self._file = file
        self._limits = limits
        self._written = self._next_ms = self._offset_us = 0
        for name, dtype in {**COLUMN_FORMATS, "t": time_type}.items():
            self._create_column(f"events/{name}", dtype, CHUNK_EVENTS)
        self._create_column("ms_to_idx", "<u8", INDEX_CHUNK)
        file.attrs["width"], file.attrs["height"] = target.size
        file.attrs["timestamp_scale_ms"] = TIMESTAMP_SCALE_MS
        write_metadata(file, target.metadata)
        write_scalars(file, target.metadata)

    def store(self, columns: Columns) -> None:
        """Write events behind those stored so far."""
        if self._written == 0:
            self._offset_us = self._limits.origin_us(int(columns["t"][0]))
            for name in OPTIONAL_COLUMNS:
                if name in columns:
                    dtype = np.dtype(COLUMN_TYPES[name]).newbyteorder("<").str
                    self._create_column(f"events/{name}", dtype, CHUNK_EVENTS)
        times = columns["t"] - self._offset_us
        self._index(times)
        for name, values in columns.items():
            append_chunks(self._file[f"events/{name}"], times if name == "t" else values)
        self._written += len(times)

    def complete(self) -> None:
        """Write what is known only at the end."""
        self._extend_index(np.array([self._written], dtype=np.uint64))
        self._file["t_offset"] = np.int64(self._offset_us)
        # A single value has no checksum; attributes are in the header, which has one.
        self._file.attrs["t_offset"] = np.int64(self._offset_us)

    def _create_column(self, name: str, dtype: str, chunk: int) -> None:
        self._file.create_dataset(name, (0,), dtype, maxshape=(None,), chunks=(chunk,), **GZIP)

    def _index(self, times: NDArray[np.int64]) -> None:
        """Extend ms_to_idx up to the last of these times, µs after t_offset."""
        last_ms = int(times[-1]) // 1000
        while self._next_ms <= last_ms:
            stop = min(last_ms + 1, self._next_ms + INDEX_BATCH)
            starts_us = np.arange(self._next_ms, stop, dtype=np.int64) * 1000
            self._extend_index(np.searchsorted(times, starts_us, side="left") + self._written)
            self._next_ms = stop

    def _extend_index(self, values: NDArray[Any]) -> None:
        dataset = self._file["ms_to_idx"]
        known = dataset.shape[0]
        dataset.resize(known + len(values), axis=0)
        dataset[known:] = values


class Hdf5Codec(BlockCodec):
    """HDF5 whose data sets have names that are known, written in the universal layout."""

    name: ClassVar[str] = "hdf5"
    extensions: ClassVar[tuple[str, ...]] = (".h5", ".hdf5")
    writer: ClassVar[type[BlockWriter]] = Hdf5Writer
    has_checksums: ClassVar[bool] = True
    takes: ClassVar[tuple[str, ...]] = TABLE_OPTIONS
    limits: ClassVar[OffsetLimits] = OffsetLimits(
        "HDF5", 1 << 16, 1 << 63, MAX_SPAN_US, keeps_labels=True
    )
    time_type: ClassVar[str] = COLUMN_FORMATS["t"]

    def recognises(self, path: Path) -> bool:
        """True if it is HDF5, and not in a layout of its own such as Metavision's."""
        if not begins_with(path, b"\x89HDF\r\n\x1a\n"):
            return False
        try:
            with open_hdf5(path) as file:
                return "CD/events" not in file
        except InputError:  # damaged, or open elsewhere
            return True

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Size and metadata are attributes of the root or of the group."""
        with open_hdf5(path) as file:
            table, _ = _find_table(file, path, options)
            groups = _groups_of(file, table)
            sizes = (stored_size(group, path) for group in groups)
            size = next((one for one in sizes if one is not None), None)
            metadata = read_metadata(file, path) or {}
        rows = partial(_open_rows, path, options)
        return contents_of_rows(size, metadata, rows)

    def beside(self, path: Path) -> Iterator[str]:
        """Data sets of images, triggers and an IMU, by their names."""
        return data_sets_beside(path)

    def layout(self, file: Any, target: FileTarget) -> StoredColumns:
        """The empty data sets of a new file, h5py's and open."""
        return Hdf5Columns(file, target, self.limits, self.time_type)

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Create the empty data sets; what HDF5 holds back is written at the end."""
        # v110: object headers and chunk indexes then carry checksums.
        with (
            DeferredErrorFile(part) as disk,
            h5py.File(disk, "w", libver=("v110", "v110")) as file,
        ):
            stored = self.layout(file, target)

            def write(columns: Columns) -> None:
                stored.store(columns)
                disk.raise_failure()

            yield write
            stored.complete()
            file.close()
            disk.raise_failure()


def _find_table(file: Any, path: Path, options: ReadOptions) -> tuple[EventTable, dict[str, Any]]:
    """The recording of an open file that the options choose, and its checked data sets.

    Raises:
        FileFormatError: it has no events, or is damaged.
        SeveralRecordingsError: it holds several recordings and the options choose none.
        MissingDependencyError: it is compressed by a filter that is not installed.
    """
    arrays = _arrays_of(file)
    tables = find_tables(path, arrays, options)
    table = tables[choose(path, [one.name for one in tables], options.stream)]
    table.check(path, arrays)
    used = {name: arrays[name] for name in table.arrays}
    for array in used.values():
        check_filters(array, path)
        check_claims(array, path)
    groups = _groups_of(file, table)
    unit = table.unit or stated_unit(path, file.attrs.get("timestamp_scale_ms"))
    for node in (arrays[table.columns["t"].array], *groups):
        unit = unit or next(filter(None, map(unit_in_words, _units_of(node))), None)
    if unit is None and any("ms_to_idx" in group for group in groups):
        unit = "us"  # DSEC's
    return replace(table, unit=unit), used


def _arrays_of(file: Any) -> dict[str, Any]:
    """Data sets by all their names: those of links in the file too, one object for each."""
    links: list[tuple[str, bool]] = []

    def visit(name: bytes, link: Any) -> bool | None:
        links.append((name.decode(errors="surrogateescape"), link.type == h5py.h5l.TYPE_SOFT))
        return True if len(links) > MOST_ARRAYS else None

    file.id.links.visit(visit, info=True)
    arrays: dict[str, Any] = {}
    known: dict[Any, Any] = {}
    for name, is_soft in links:
        node = _target(file, name) if is_soft else file[name]
        found = {name: node}
        if is_soft and isinstance(node, h5py.Group):
            found = {f"{name}/{leaf}": _target(node, leaf) for leaf in node}
        for one, array in found.items():
            if isinstance(array, h5py.Dataset) and array.shape is not None:
                arrays[one] = known.setdefault(array, array)
    return arrays


def data_sets_beside(path: Path) -> Iterator[str]:
    """Names of data sets of images, triggers or an IMU that hold something."""
    with open_hdf5(path) as file:
        for name, array in _arrays_of(file).items():
            if BESIDE.search(name.lower()) and array.size:
                yield name


def _target(group: Any, name: str) -> Any:
    """Object that a link leads to; None where it leads nowhere, or round and round."""
    try:
        return group[name]
    except (KeyError, RuntimeError, OSError):
        return None


def _units_of(node: Any) -> list[Any]:
    """Values of the attributes that name the unit of the times of a data set or a group."""
    return [node.attrs[name] for name in node.attrs if UNIT_NAME.fullmatch(name.lower())]


def _groups_of(file: Any, table: EventTable) -> list[Any]:
    """The group of a recording's arrays and those above it, the root last."""
    group = file[table.columns["t"].array].parent
    groups = [group]
    while group.name != "/":
        group = group.parent
        groups.append(group)
    return groups


@contextmanager
def _open_rows(path: Path, options: ReadOptions) -> Iterator[TimedRows]:
    """Not by ms_to_idx: files of others lack it or have it in other units."""
    with open_hdf5(path) as file:
        table, arrays = _find_table(file, path, options)
        groups = _groups_of(file, table)
        far = _far_sides(table, [*arrays.values(), *groups])
        sizes = filter(None, (stored_size(group, path) for group in groups))
        size = next(sizes, options.size) or (0, 0)
        arrays = {
            name: as_stated(one, path, size[far[name]] - 1 if name in far else None)
            for name, one in arrays.items()
        }
        groups = [one for one in groups if OFFSET in one or OFFSET in one.attrs]
        offset = next((_time_offset(one, path) for one in groups), None)
        yield table.rows(path, arrays, options, offset=offset, block=PACKET_EVENTS)


def _far_sides(table: EventTable, nodes: Sequence[Any]) -> dict[str, int]:
    """Arrays of coordinates that count from the right (0) or from below (1), as attributes say."""
    words = {
        key: "".join(texts_of(node.attrs[key])[:1]).strip().lower()
        for node in reversed(nodes)
        for key in ("origin", "y_up")
        if key in node.attrs
    }
    corner = ORIGIN.fullmatch(words.get("origin", "")) or ("", "", "")
    is_up = corner[1] in ("lower", "bottom") or words.get("y_up") in ("true", "1")
    far = {"x": corner[2] == "right", "y": is_up}
    return {table.columns[name].array: side for side, name in enumerate("xy") if far[name]}


def _time_offset(group: Any, path: Path) -> NDArray[Any]:
    """Time that is added to those of a group, in their unit, [1]."""
    if OFFSET not in group:
        return time_offset(path, np.asarray(group.attrs[OFFSET]))
    check_claims(group[OFFSET], path)
    offset = time_offset(path, group[OFFSET])
    if OFFSET in group.attrs and whole_attribute(group, OFFSET) != offset[0]:
        raise FileFormatError(
            f"{path} is damaged: {OFFSET} is {offset[0]}, written as {shown(group.attrs[OFFSET])}"
        )
    return offset


class DsecCodec(Hdf5Codec):
    """DSEC files, compressed with gzip."""

    name: ClassVar[str] = "dsec"
    extensions: ClassVar[tuple[str, ...]] = ()
    limits: ClassVar[OffsetLimits] = OffsetLimits(
        "DSEC HDF5", 1 << 16, 1 << 63, 2**32 - 1, keeps_labels=True, max_absolute_us=0
    )
    time_type: ClassVar[str] = "<u4"
