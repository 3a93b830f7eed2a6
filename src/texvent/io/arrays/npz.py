"""NumPy archives: x, y, t, p and width, height, timestamp_scale_ms; read by eventcv and evutils.

More arrays hold what those do not look for: `texvent`, all metadata as JSON, and `label`
(1 = noise), `instance` and `class_id` if the run stores them.

The format holds each column as one array, so writer and reader need the whole recording in
memory (13 bytes per event). Use HDF5 for long recordings.

Read too: every archive in which `texvent.io.tables` finds a recording; BS-ERGB's, whose coordinates
are 1/32 of a pixel, and single arrays (.npy), which are read block by block.

N-ImageNet's npz is one array `event_data` with fields x u2, y u2, t i8 (µs), p bool; older files
call them x_pos, y_pos, timestamp and polarity. Further arrays are width, height and texvent, which
its loader does not look for; files of the data set itself have none: it is 640x480, to be given.

Source: Kim et al., N-ImageNet: Towards Robust, Fine-Grained Object Recognition, ICCV 2021.
"""

from __future__ import annotations

import math
import tokenize
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, shown, warn
from texvent.events import COLUMN_TYPES, EventStream
from texvent.io.arrays.npy_file import StoredArray, read_header
from texvent.io.block_codec import (
    BlockCodec,
    BlockReader,
    FileContents,
    TimedRows,
    already_open,
    contents_of_rows,
)
from texvent.io.block_writer import Columns, FileTarget, FormatLimits, WriteBlock
from texvent.io.files import load
from texvent.io.input_checks import (
    TIMESTAMP_SCALE_MS,
    ZIP_DAMAGE,
    begins_with,
    check_zip,
    reporting_damage,
    stated_unit,
)
from texvent.io.metadata import metadata_from_json, metadata_to_json, read_sidecar
from texvent.io.reading import ReadOptions, TimeUnit, choose
from texvent.io.table_search import find_tables
from texvent.io.tables import TABLE_OPTIONS, time_offset
from texvent.runtime.memory import check_claim
from texvent.sensor import SensorSize

BLOCK_EVENTS = 2**18
N_IMAGENET = "event_data"
"""Array of N-ImageNet, whose times are µs."""
FIXED_POINT = 32
"""Steps of a pixel in the coordinates of BS-ERGB."""
FAR_BEYOND = 4
"""So many times the sensor's size is no sensor given wrongly."""

NPZ_DAMAGE = (
    *ZIP_DAMAGE,
    KeyError,
    TypeError,
    OverflowError,
    SyntaxError,
    UserWarning,
    tokenize.TokenError,
)
"""NumPy and zipfile raise any of these on a damaged archive."""


class NpzCodec(BlockCodec):
    """NumPy archives."""

    name: ClassVar[str] = "npz"
    has_checksums: ClassVar[bool] = True
    extensions: ClassVar[tuple[str, ...]] = (".npz",)
    limits: ClassVar[FormatLimits] = FormatLimits(
        "NumPy archive", 1 << 16, 1 << 63, start_us=-(1 << 63), keeps_labels=True
    )

    takes: ClassVar[tuple[str, ...]] = TABLE_OPTIONS

    def recognises(self, path: Path) -> bool:
        """True if it is a zip archive of arrays."""
        return begins_with(path, b"PK") and bool(array_names(path))

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """The archive's arrays of events, in memory."""
        arrays = open_arrays(path)
        unit = stated_unit(path, arrays.get("timestamp_scale_ms"))
        unit = unit or ("us" if N_IMAGENET in arrays else None)
        return stored_contents(path, arrays, options, unit=unit)

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Collect the events; the archive is written at the end."""
        blocks: list[Columns] = []
        yield blocks.append
        parts = blocks or [{name: np.empty(0, COLUMN_TYPES[name]) for name in "xytp"}]
        arrays: dict[str, Any] = {
            **{name: np.concatenate([one[name] for one in parts]) for name in parts[0]},
            # eventcv reads no other integers here.
            "width": np.uint64(target.size.width),
            "height": np.uint64(target.size.height),
            "timestamp_scale_ms": np.float64(TIMESTAMP_SCALE_MS),
            "texvent": np.array(metadata_to_json(target.metadata)),
        }
        with part.open("wb") as file:
            np.savez(file, **arrays)


class ArchivedArray:
    """An array of an archive, whose values are read when they are asked for.

    So arrays that hold Python objects, which could run code, or that are large do no harm where
    they are not needed.
    """

    def __init__(self, path: Path, name: str) -> None:
        self._path, self._name = path, name
        self._values: NDArray[Any] | None = None
        with (
            self._reporting_damage(),
            zipfile.ZipFile(path) as archive,
            archive.open(f"{name}.npy") as file,
        ):
            self.shape, _, self.dtype = read_header(file)

    def __getitem__(self, rows: slice) -> NDArray[Any]:
        """The rows of a slice."""
        return self.__array__()[rows]

    def __array__(self, *how: Any, **more: Any) -> NDArray[Any]:
        """All values.

        Raises:
            FileFormatError: they are damaged, or Python objects.
        """
        if self._values is None:
            check_claim(math.prod(self.shape) * self.dtype.itemsize, self._path)
            with self._reporting_damage(), self._path.open("rb") as file:
                self._values = _checked(np.load(file)[self._name], self._name, self._path)
        return np.asarray(self._values, *how, **more)

    def _reporting_damage(self) -> AbstractContextManager[None]:
        return reporting_damage(self._path, "a NumPy archive", NPZ_DAMAGE)


def open_arrays(path: Path) -> dict[str, ArchivedArray]:
    """Every array of the archive, unread.

    Raises:
        FileFormatError: the archive is damaged, no archive, or would fill the memory.
    """
    # NumPy takes anything else for a pickle, and advises to load it "unsafely".
    if begins_with(path, b"\x93NUMPY"):
        raise FileFormatError(f"{path} holds a single NumPy array, not an archive")
    if not begins_with(path, b"PK"):
        raise FileFormatError(
            f"{path} is not a NumPy archive: it does not begin as a zip file does"
        )
    with reporting_damage(path, "a NumPy archive", NPZ_DAMAGE), zipfile.ZipFile(path) as archive:
        check_zip(path, archive)
        names = archive.namelist()
    return {name[:-4]: ArchivedArray(path, name[:-4]) for name in names if name.endswith(".npy")}


def read_arrays(path: Path) -> dict[str, NDArray[Any]]:
    """Every array of the archive; errors as of `open_arrays` and of reading each."""
    return {name: np.asarray(one) for name, one in open_arrays(path).items()}


def _checked(member: Any, name: str, path: Path) -> NDArray[Any]:
    """A member that is an array of numbers or text.

    Raises:
        FileFormatError: it is text, a pickle, or claims items of no bytes.
    """
    if not isinstance(member, np.ndarray):
        raise FileFormatError(f"{path}: its member {shown(name)} is not a NumPy array")
    kinds = [member.dtype[field] for field in member.dtype.names or ()] or [member.dtype]
    if member.size and any(kind.itemsize == 0 for kind in kinds):
        raise FileFormatError(f"{path}: its array {shown(name)} claims items of no bytes")
    return member


def array_names(path: Path) -> list[str]:
    """Names of the arrays of an archive; none if it cannot be read."""
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
    except (OSError, ValueError, NotImplementedError, zipfile.BadZipFile):
        return []
    return [name.removesuffix(".npy") for name in names if name.endswith(".npy")]


def stored_contents(
    path: Path, arrays: Mapping[str, Any], options: ReadOptions, *, unit: TimeUnit | None
) -> FileContents:
    """Contents of an archive with arrays `width`, `height` and `texvent`, where it has them.

    Raises:
        FileFormatError: one of them is damaged, or there are no events.
        SeveralRecordingsError: it holds several recordings and the options choose none.
    """
    size = None
    if "width" in arrays and "height" in arrays:
        size = _read_whole(path, arrays["width"]), _read_whole(path, arrays["height"])
    metadata: dict[str, Any] = {}
    if "texvent" in arrays:
        metadata = metadata_from_json(path, str(np.asarray(arrays["texvent"])))
    tables = find_tables(path, arrays, options)
    table = tables[choose(path, [one.name for one in tables], options.stream)]
    table = replace(table, unit=table.unit or unit)
    table.check(path, arrays)
    used = {name: np.asarray(arrays[name]) for name in table.arrays}
    stored = arrays.get("t_offset")
    offset = None if stored is None else time_offset(path, np.asarray(stored))
    rows = table.rows(path, used, options, offset=offset, block=BLOCK_EVENTS)
    return FileContents(size, metadata, partial(_one_block, path, rows, options.size))


def _one_block(path: Path, rows: TimedRows, size: SensorSize | None) -> Iterator[Columns]:
    """All events, which are in memory; those of BS-ERGB in whole pixels."""
    columns = rows.read(0, rows.count)
    if size is not None and rows.count:
        largest = [int(columns[name].max()) for name in "xy"]
        if all(
            limit * FAR_BEYOND <= one < limit * FIXED_POINT
            for one, limit in zip(largest, size, strict=True)
        ):
            warn(
                f"{path} holds coordinates up to {largest[0]}, {largest[1]} on a sensor of {size}; "
                "they are read as 1/32 of a pixel, as BS-ERGB has them"
            )
            columns = {**columns, **{name: columns[name] // FIXED_POINT for name in "xy"}}
    yield columns


def _read_whole(path: Path, stored: Any) -> int:
    value = np.asarray(stored)
    if value.size != 1 or value.dtype.kind not in "iu":
        raise FileFormatError(
            f"{path}: width and height must be whole numbers; one is {shown(value)}"
        )
    return int(value.reshape(-1)[0])


class NpyCodec(BlockReader):
    """A single array of records, or of rows of four numbers."""

    name: ClassVar[str] = "npy"
    extensions: ClassVar[tuple[str, ...]] = (".npy",)
    takes: ClassVar[tuple[str, ...]] = TABLE_OPTIONS

    def recognises(self, path: Path) -> bool:
        """True if it is an array of records or of four columns; others are frames."""
        try:
            array = StoredArray(path) if begins_with(path, b"\x93NUMPY") else None
        except (OSError, FileFormatError):
            return False
        return array is not None and (
            bool(array.dtype.names) or (array.ndim == 2 and array.shape[1] == 4)
        )

    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Its type names the columns, or their order is guessed where it is certain."""
        arrays = {"events": StoredArray(path)}
        table = find_tables(path, arrays, options)[0]
        table.check(path, arrays)
        rows = table.rows(path, arrays, options, block=BLOCK_EVENTS)
        size, metadata = read_sidecar(path)
        return contents_of_rows(size, metadata, already_open(rows))


SENSOR = SensorSize(640, 480)
"""Size of the recordings of the data set."""
EVENT = np.dtype([("x", "<u2"), ("y", "<u2"), ("t", "<i8"), ("p", "?")])


class NImageNetCodec(NpzCodec):
    """npz of one structured array."""

    name: ClassVar[str] = "n-imagenet"
    limits: ClassVar[FormatLimits] = FormatLimits("N-ImageNet npz", 1 << 16, 1 << 63)

    def recognises(self, path: Path) -> bool:
        """True if it is an archive with an array event_data."""
        return N_IMAGENET in array_names(path)

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Collect the events; the archive is written at the end."""
        blocks = [np.empty(0, dtype=EVENT)]

        def write(columns: Columns) -> None:
            block = np.empty(len(columns["t"]), dtype=EVENT)
            for name in "xytp":
                block[name] = columns[name]
            blocks.append(block)

        yield write
        arrays: dict[str, Any] = {
            N_IMAGENET: np.concatenate(blocks),
            "width": np.int64(target.size.width),
            "height": np.int64(target.size.height),
            "texvent": np.array(metadata_to_json(target.metadata)),
        }
        with part.open("wb") as file:
            np.savez(file, **arrays)


def load_stream(path: Path) -> EventStream:
    """Events of a file of any format; one that stores no sensor size is N-ImageNet's own."""
    try:
        return load(path)
    except InputError:
        return load(path, size=SENSOR)
