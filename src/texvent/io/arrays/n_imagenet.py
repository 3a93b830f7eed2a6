"""N-ImageNet's npz: one array `event_data` with fields x u2, y u2, t i8 (µs), p bool.

Beside it lie width, height and texvent (all metadata as JSON), which its loader does not look
for; files of the data set itself have none: it is 640x480, to be given. As with every npz, writer
and reader hold the whole recording in memory (13 bytes per event).

Source: Kim et al., N-ImageNet: Towards Robust, Fine-Grained Object Recognition, ICCV 2021.
"""

from __future__ import annotations

import zipfile
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.event_packets import EventPackets
from texvent.io.arrays.npz import read_arrays, read_whole
from texvent.io.block_stream import BlockPackets, BlockWriter, Columns, FileTarget
from texvent.io.columns import (
    existing_file,
    metadata_from_json,
    metadata_to_json,
    stored_or_given_size,
)
from texvent.io.limits import FormatLimits
from texvent.sensor import SensorSize

ARRAY = "event_data"
EVENT = np.dtype([("x", "<u2"), ("y", "<u2"), ("t", "<i8"), ("p", "?")])


class NImageNetCodec:
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

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of an archive, as one packet in memory.

        Raises:
            InputError: no such file, or it stores no sensor size and none is given.
            FileFormatError: it is damaged or lacks the array.
        """
        path = existing_file(path)
        arrays = read_arrays(path)
        events = arrays.get(ARRAY)
        names = getattr(getattr(events, "dtype", None), "names", None) or ()
        if events is None or events.ndim != 1 or not {*"xytp"} <= {*names}:
            raise FileFormatError(f"{path} has no array {ARRAY} with fields x, y, t, p")
        stored = None
        if "width" in arrays and "height" in arrays:
            stored = read_whole(path, arrays, "width"), read_whole(path, arrays, "height")
        metadata: dict[str, Any] = {}
        if "texvent" in arrays:
            metadata = metadata_from_json(path, str(arrays["texvent"]))
        final_size = stored_or_given_size(path, stored, size)
        blocks = partial(_columns, events)
        return EventPackets(BlockPackets(path, blocks, final_size, metadata), final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> BlockWriter:
        """Start an archive; see `EventCodec.open_writer`."""
        target = FileTarget(path, size, metadata, overwrite)
        return BlockWriter(target, partial(NImageNetSink, target=target), limits=self.limits)


class NImageNetSink:
    """Collects events and writes the archive at the end."""

    def __init__(self, part: Path, stack: ExitStack, *, target: FileTarget) -> None:
        self._file = stack.enter_context(part.open("wb"))
        self._target = target
        self._pieces: list[NDArray[Any]] = [np.empty(0, dtype=EVENT)]

    def write(self, columns: Columns) -> None:
        """Add events."""
        piece = np.empty(len(columns["t"]), dtype=EVENT)
        for name in "xytp":
            piece[name] = columns[name]
        self._pieces.append(piece)

    def finish(self) -> None:
        """Write the archive."""
        arrays: dict[str, Any] = {
            ARRAY: np.concatenate(self._pieces),
            "width": np.int64(self._target.size.width),
            "height": np.int64(self._target.size.height),
            "texvent": np.array(metadata_to_json(self._target.metadata)),
        }
        np.savez(self._file, **arrays)


def _columns(events: NDArray[Any]) -> Iterator[Columns]:
    columns = {name: events[name] for name in "xytp"}
    if columns["p"].dtype.kind == "b":
        columns["p"] = columns["p"].astype(np.uint8)
    yield columns
