"""NumPy archives: x, y, t, p and width, height, timestamp_scale_ms; read by eventcv and evutils.

Two more arrays hold what those do not look for: `texvent`, all metadata as JSON, and `label`
(1 = noise) where the run was told to store it.

The format holds each column as one array, so writer and reader need the whole recording in
memory (13 bytes per event). Use HDF5 for long recordings.
"""

from __future__ import annotations

import tokenize
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.events import COLUMN_TYPES
from texvent.io.block_codec import BlockCodec, FileContents
from texvent.io.block_writer import FileTarget, WriteBlock
from texvent.io.input_checks import ZIP_DAMAGE, begins_with, check_zip, reporting_damage
from texvent.io.limits import FormatLimits
from texvent.io.metadata import metadata_from_json, metadata_to_json
from texvent.io.protocol import Columns

TIMESTAMP_SCALE_MS = 0.001

NPZ_DAMAGE = (
    *ZIP_DAMAGE,
    KeyError,
    TypeError,
    OverflowError,
    SyntaxError,
    tokenize.TokenError,
)
"""NumPy and zipfile raise any of these on a damaged archive."""


class NpzCodec(BlockCodec):
    """NumPy archives."""

    name: ClassVar[str] = "npz"
    extensions: ClassVar[tuple[str, ...]] = (".npz",)
    limits: ClassVar[FormatLimits] = FormatLimits(
        "NumPy archive", 1 << 16, 1 << 63, start_us=-(1 << 63), label="kept"
    )

    def inspect(self, path: Path) -> FileContents:
        """The archive's arrays, all in memory."""
        arrays = read_arrays(path)
        missing = [name for name in "xytp" if name not in arrays]
        if missing:
            raise FileFormatError(
                f"{path} has no array {missing[0]!r} (it has: {', '.join(arrays) or 'none'}); "
                "texvent reads archives of x, y, t, p"
            )
        _check_scale(path, arrays)
        columns = {name: arrays[name] for name in COLUMN_TYPES if name in arrays}
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
            return {name: archive[name] for name in archive.files}


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


def _one_block(columns: Columns) -> Iterator[Columns]:
    yield columns


def _read_whole(path: Path, value: NDArray[Any]) -> int:
    if value.size != 1 or value.dtype.kind not in "iu":
        raise FileFormatError(f"{path}: width and height must be whole numbers; one is {value!r}")
    return int(value.reshape(-1)[0])


def _check_scale(path: Path, arrays: Mapping[str, Any]) -> None:
    if "timestamp_scale_ms" not in arrays:
        return
    scale = np.asarray(arrays["timestamp_scale_ms"])
    if scale.size != 1 or not np.isclose(scale.astype(float).reshape(-1)[0], TIMESTAMP_SCALE_MS):
        raise FileFormatError(f"{path} counts time in units of {scale} ms; texvent reads 0.001")
