"""NumPy archives: x, y, t, p and width, height, timestamp_scale_ms; read by eventcv and evutils.

Two more arrays hold what those do not look for: `texvent`, all metadata as JSON, and `label`
(1 = noise) where the run was told to store it.

The format holds each column as one array, so writer and reader need the whole recording in
memory (13 bytes per event). Use HDF5 for long recordings.
"""

from __future__ import annotations

import struct
import tokenize
import zipfile
import zlib
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, ClassVar, Self

import numpy as np

from texvent.errors import FileFormatError, InputError, OutputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.arrays.archives import check_archive
from texvent.io.atomic import atomic_file, check_output
from texvent.io.columns import (
    existing_file,
    metadata_from_json,
    metadata_to_json,
    stored_or_given_size,
    stream_from_file,
)
from texvent.io.magic import begins_with
from texvent.sensor import SensorSize

TIMESTAMP_SCALE_MS = 0.001

_DAMAGE = (
    OSError,
    ValueError,
    KeyError,
    TypeError,
    EOFError,
    MemoryError,
    OverflowError,
    NotImplementedError,
    RuntimeError,
    SyntaxError,
    struct.error,
    tokenize.TokenError,
    zipfile.BadZipFile,
    zlib.error,
)
"""NumPy and zipfile raise any of these on a damaged archive."""


class NpzCodec:
    """NumPy archives."""

    name: ClassVar[str] = "npz"
    extensions: ClassVar[tuple[str, ...]] = (".npz",)

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of an archive, as one packet in memory.

        Raises:
            InputError: no such file, or it stores no sensor size and none is given.
            FileFormatError: it is damaged or lacks a column.
        """
        path = existing_file(path)
        arrays = read_arrays(path)
        missing = [name for name in "xytp" if name not in arrays]
        if missing:
            raise FileFormatError(
                f"{path} has no array {missing[0]!r} (it has: {', '.join(arrays) or 'none'}); "
                "texvent reads archives of x, y, t, p"
            )
        stored = None
        if "width" in arrays and "height" in arrays:
            stored = read_whole(path, arrays, "width"), read_whole(path, arrays, "height")
        _check_scale(path, arrays)
        metadata = {}
        if "texvent" in arrays:
            metadata = metadata_from_json(path, str(arrays["texvent"]))
        final_size = stored_or_given_size(path, stored, size)
        stream = stream_from_file(path, arrays, final_size, metadata)
        return EventPackets((stream,), final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> NpzWriter:
        """Start an archive; see `EventCodec.open_writer`."""
        return NpzWriter(path, size=size, metadata=metadata, overwrite=overwrite)


class NpzWriter:
    """Collects packets and writes the archive at the end of its `with` block.

    Raises:
        OutputError: the file exists already, its folder refuses it, or the disk is full.
        InputError: a packet of another size, or before the one before it.
    """

    def __init__(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> None:
        check_output(path, overwrite=overwrite)
        self._path = path
        self._size = size
        self._overwrite = overwrite
        self._json = metadata_to_json(metadata)
        self._packets = [EventStream.empty(size)]
        self._stack = ExitStack()
        self._part: Path | None = None

    def __enter__(self) -> Self:
        self._part = self._stack.enter_context(atomic_file(self._path, overwrite=self._overwrite))
        return self

    def append(self, packet: EventStream) -> None:
        """Add the events of a packet, which starts no earlier than the one before it ended."""
        if self._part is None:
            raise OutputError(f"{self._path} is not open; append inside the writer's with block")
        if packet.size != self._size:
            raise InputError(f"the packet is {packet.size}, the file is {self._size}")
        if len(packet):
            self._packets.append(packet)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is not None:
            self._stack.__exit__(kind, error, trace)
            return
        with self._stack:
            self._write()

    def _write(self) -> None:
        whole = EventStream.concat(self._packets)
        if self._part is None:
            return
        arrays: dict[str, Any] = {
            **whole.columns(),
            # eventcv reads no other integers here.
            "width": np.uint64(self._size.width),
            "height": np.uint64(self._size.height),
            "timestamp_scale_ms": np.float64(TIMESTAMP_SCALE_MS),
            "texvent": np.array(self._json),
        }
        with self._part.open("wb") as file:
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
    try:
        # Opened here, because np.load leaves a damaged file open.
        with path.open("rb") as file:
            archive = np.load(file, allow_pickle=False)
            if not isinstance(archive, np.lib.npyio.NpzFile):
                raise FileFormatError(f"{path} holds a single NumPy array, not an archive")
            with archive:
                with zipfile.ZipFile(path) as contents:
                    check_archive(path, contents)
                return {name: archive[name] for name in archive.files}
    except InputError:
        raise
    except _DAMAGE as error:
        reason = " ".join(str(error).split())[:200]
        raise FileFormatError(f"{path} is damaged or not a NumPy archive ({reason})") from error


def read_whole(path: Path, arrays: Mapping[str, Any], name: str) -> int:
    """One whole number.

    Raises:
        FileFormatError: the array holds something else.
    """
    value = np.asarray(arrays[name])
    if value.size != 1 or value.dtype.kind not in "iu":
        raise FileFormatError(f"{path}: {name} must be one whole number; it is {value!r}")
    return int(value.reshape(-1)[0])


def _check_scale(path: Path, arrays: Mapping[str, Any]) -> None:
    if "timestamp_scale_ms" not in arrays:
        return
    scale = np.asarray(arrays["timestamp_scale_ms"])
    if scale.size != 1 or not np.isclose(scale.astype(float).reshape(-1)[0], TIMESTAMP_SCALE_MS):
        raise FileFormatError(f"{path} counts time in units of {scale} ms; texvent reads 0.001")
