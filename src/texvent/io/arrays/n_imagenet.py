"""N-ImageNet's npz: one array `event_data` with fields x u2, y u2, t i8 (µs), p bool.

Beside it lie width, height and texvent (all metadata as JSON), which its loader does not look
for; files of the data set itself have none: it is 640x480, to be given. As with every npz, writer
and reader hold the whole recording in memory (13 bytes per event).

Source: Kim et al., N-ImageNet: Towards Robust, Fine-Grained Object Recognition, ICCV 2021.
"""

from __future__ import annotations

import zipfile
from contextlib import ExitStack
from pathlib import Path
from typing import Any, BinaryIO, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.io.arrays.npz import read_arrays, stored_contents
from texvent.io.block_codec import BlockCodec, FileContents
from texvent.io.block_writer import FileTarget
from texvent.io.limits import FormatLimits
from texvent.io.metadata import metadata_to_json
from texvent.io.protocol import Columns

ARRAY = "event_data"
EVENT = np.dtype([("x", "<u2"), ("y", "<u2"), ("t", "<i8"), ("p", "?")])


class NImageNetCodec(BlockCodec):
    """npz of one structured array."""

    name: ClassVar[str] = "n-imagenet"
    extensions: ClassVar[tuple[str, ...]] = (".npz",)
    limits: ClassVar[FormatLimits] = FormatLimits("N-ImageNet npz", 1 << 16, 1 << 63)

    def recognises(self, path: Path) -> bool:
        """True if it is an archive with an array event_data."""
        try:
            with zipfile.ZipFile(path) as archive:
                return f"{ARRAY}.npy" in archive.namelist()
        except (OSError, ValueError, NotImplementedError, zipfile.BadZipFile):
            return False

    def inspect(self, path: Path) -> FileContents:
        """The archive's arrays, all in memory."""
        arrays = read_arrays(path)
        events = arrays.get(ARRAY)
        names = getattr(getattr(events, "dtype", None), "names", None) or ()
        if events is None or events.ndim != 1 or not {*"xytp"} <= {*names}:
            raise FileFormatError(f"{path} has no array {ARRAY} with fields x, y, t, p")
        columns = {name: events[name] for name in "xytp"}
        if columns["p"].dtype.kind == "b":
            columns["p"] = columns["p"].astype(np.uint8)
        return stored_contents(path, arrays, columns)

    def start(self, target: FileTarget, part: Path, stack: ExitStack) -> NImageNetSink:
        """Collect the events; the archive is written at the end."""
        return NImageNetSink(stack.enter_context(part.open("wb")), target)


class NImageNetSink:
    """Collects events and writes the archive at the end."""

    def __init__(self, file: BinaryIO, target: FileTarget) -> None:
        self._file = file
        self._target = target
        self._blocks: list[NDArray[Any]] = [np.empty(0, dtype=EVENT)]

    def write(self, columns: Columns) -> None:
        """Add events."""
        block = np.empty(len(columns["t"]), dtype=EVENT)
        for name in "xytp":
            block[name] = columns[name]
        self._blocks.append(block)

    def finish(self) -> None:
        """Write the archive."""
        arrays: dict[str, Any] = {
            ARRAY: np.concatenate(self._blocks),
            "width": np.int64(self._target.size.width),
            "height": np.int64(self._target.size.height),
            "texvent": np.array(metadata_to_json(self._target.metadata)),
        }
        np.savez(self._file, **arrays)
