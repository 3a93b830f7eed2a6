"""NumPy archives: x, y, t, p and width, height, timestamp_scale_ms; read by eventcv and evutils.

More arrays hold what those do not look for: `texvent`, all metadata as JSON, and `label`
(1 = noise), `instance` and `class_id` if the run stores them.

The format holds each column as one array, so writer and reader need the whole recording in
memory (13 bytes per event). Use HDF5 for long recordings.
"""

from __future__ import annotations

import tokenize
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown
from texvent.events import COLUMN_TYPES
from texvent.io.block_codec import BlockCodec, FileContents
from texvent.io.block_writer import FileTarget, FormatLimits, WriteBlock
from texvent.io.input_checks import (
    TIMESTAMP_SCALE_MS,
    ZIP_DAMAGE,
    begins_with,
    check_time_unit,
    check_zip,
    optional_columns,
    reporting_damage,
)
from texvent.io.metadata import metadata_from_json, metadata_to_json
from texvent.io.protocol import Columns

SPELLINGS = {
    "t": ("t", "ts", "timestamp", "timestamps", "time", "times", "t_us", "timestamp_us"),
    "x": ("x", "xs", "x_pos"),
    "y": ("y", "ys", "y_pos"),
    "p": ("p", "ps", "pol", "polarity", "polarities"),
}
"""Column → its names, in lower case."""


def find_columns(path: Path, names: Iterable[str], *, kind: str = "column") -> dict[str, str]:
    """t, x, y, p → the name that a file gives each.

    Args:
        path: the file, for messages.
        names: all names in the file, with capitals or without.
        kind: kind of the named objects, such as "array".

    Raises:
        FileFormatError: a column is missing or there twice; the message says what is accepted.
    """
    names, found = list(names), {}
    for column, spellings in SPELLINGS.items():
        matching = [name for name in names if name.lower() in spellings]
        if len(matching) != 1:
            what = f"{len(matching)} {kind}s" if matching else f"no {kind}"
            others = " or ".join(spellings[1:4])
            raise FileFormatError(
                f"{path} has {what} {column!r} (it has: {shown(', '.join(names) or 'none')}); "
                f"texvent reads {kind}s t, x, y, p; {column} may be called {others}"
            )
        found[column] = matching[0]
    return found


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

    def inspect(self, path: Path) -> FileContents:
        """The archive's arrays, all in memory."""
        arrays = read_arrays(path)
        check_time_unit(path, arrays.get("timestamp_scale_ms", TIMESTAMP_SCALE_MS))
        columns = _find_events(path, arrays)
        return stored_contents(path, arrays, columns)

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


def read_arrays(path: Path) -> dict[str, Any]:
    """Every array of the archive; pickled objects are refused, since they could run code.

    Raises:
        FileFormatError: the archive is damaged, no archive, or would fill the memory.
    """
    # NumPy takes anything else for a pickle, and advises to load it "unsafely".
    if not begins_with(path, b"PK") and not begins_with(path, b"\x93NUMPY"):
        raise FileFormatError(
            f"{path} is not a NumPy archive: it does not begin as a zip file does"
        )
    # Opened here, because np.load leaves a damaged file open.
    with reporting_damage(path, "a NumPy archive", NPZ_DAMAGE), path.open("rb") as file:
        archive = np.load(file, allow_pickle=False)
        if not isinstance(archive, np.lib.npyio.NpzFile):
            raise FileFormatError(f"{path} holds a single NumPy array, not an archive")
        with archive:
            with zipfile.ZipFile(path) as contents:
                check_zip(path, contents)
            return {name: _checked(archive[name], name, path) for name in archive.files}


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


def stored_contents(
    path: Path, arrays: Mapping[str, Any], columns: Mapping[str, NDArray[Any]]
) -> FileContents:
    """Contents of an archive with arrays `width`, `height` and `texvent`, where it has them.

    Raises:
        FileFormatError: one of them is damaged.
    """
    size = None
    if "width" in arrays and "height" in arrays:
        size = _read_whole(path, arrays["width"]), _read_whole(path, arrays["height"])
    metadata: dict[str, Any] = {}
    if "texvent" in arrays:
        metadata = metadata_from_json(path, str(arrays["texvent"]))
    return FileContents(size, metadata, partial(_one_block, columns))


def _find_events(path: Path, arrays: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    """Columns x, y, t, p, and others if known: arrays of their own, or fields of the only records.

    Raises:
        FileFormatError: a column is missing.
    """
    records = [name for name, array in arrays.items() if array.dtype.names]
    if len(records) == 1:
        table = arrays[records[0]]
        found = find_columns(path, table.dtype.names, kind="field")
        return {name: table[field] for name, field in found.items()}
    found = find_columns(path, arrays, kind="array")
    columns = {name: arrays[array] for name, array in found.items()}
    return columns | {name: arrays[name] for name in optional_columns(arrays)}


def _one_block(columns: Columns) -> Iterator[Columns]:
    yield columns


def _read_whole(path: Path, value: NDArray[Any]) -> int:
    if value.size != 1 or value.dtype.kind not in "iu":
        raise FileFormatError(
            f"{path}: width and height must be whole numbers; one is {shown(value)}"
        )
    return int(value.reshape(-1)[0])
