"""v2e's HDF5: one dataset `events`, u4 [n, 4], rows t (µs), x, y, p, compressed with gzip.

Times stay below 2^32 µs (71.6 min). texvent adds root attributes that v2e does not write: width,
height and texvent (all metadata as JSON). Files of v2e itself store no size: it is asked for.

v2e itself passes times through float32 before they get here, so after 17 s its own files have
lost the µs; texvent's keep them.

Source: Hu, Liu and Delbruck, v2e: From Video Frames to Realistic DVS Events, 2021, and its files.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Any, ClassVar, Self

import h5py
import numpy as np

from texvent.errors import FileFormatError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.block_stream import BlockPackets, BlockWriter, Columns, FileTarget
from texvent.io.columns import existing_file, metadata_to_json, stored_or_given_size
from texvent.io.hdf5.damage import check_claims, reporting_damage
from texvent.io.hdf5.deferred_error_file import DeferredErrorFile
from texvent.io.hdf5.native import check_filters, read_metadata, stored_size, write_metadata
from texvent.io.limits import FormatLimits
from texvent.runtime.interrupts import delay_interrupts
from texvent.sensor import SensorSize

CHUNK_EVENTS = 65_536
PACKET_EVENTS = 8 * CHUNK_EVENTS
STOP_US = 1 << 32
ORDER = "txyp"


class V2eCodec:
    """HDF5 as v2e writes it."""

    name: ClassVar[str] = "v2e"
    extensions: ClassVar[tuple[str, ...]] = (".h5", ".hdf5")
    limits: ClassVar[FormatLimits] = FormatLimits("v2e HDF5", 1 << 16, STOP_US)

    def recognises(self, path: Path) -> bool:
        """True if it is HDF5 with a dataset of four columns called events."""
        try:
            with reporting_damage(path), h5py.File(path, "r") as file:
                return isinstance(file.get("events"), h5py.Dataset)
        except FileFormatError:
            return False

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of a file, half a million at a time; the file is opened anew for each pass.

        Raises:
            InputError: no such file, or it stores no sensor size and none is given.
            FileFormatError: the file is damaged or has another layout.
        """
        path = existing_file(path)
        with reporting_damage(path), h5py.File(path, "r") as file:
            _checked_events(file, path)
            stored = stored_size(file)
            metadata = read_metadata(file, path)
        final_size = stored_or_given_size(path, stored, size)
        blocks = partial(_read_blocks, path)
        return EventPackets(BlockPackets(path, blocks, final_size, metadata), final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> V2eWriter:
        """Start a file; see `EventCodec.open_writer`."""
        target = FileTarget(path, size, metadata, overwrite)
        return V2eWriter(target, partial(V2eSink, target=target), limits=self.limits)


class V2eWriter(BlockWriter):
    """Keeps Ctrl-C out of HDF5's callbacks; see `delay_interrupts`."""

    def __enter__(self) -> Self:
        with delay_interrupts():
            return super().__enter__()

    def append(self, packet: EventStream) -> None:
        """Add the events of a packet, which starts no earlier than the one before it ended."""
        with delay_interrupts():
            super().append(packet)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        with delay_interrupts():
            super().__exit__(kind, error, trace)


class V2eSink:
    """Appends rows to the dataset."""

    def __init__(self, part: Path, stack: ExitStack, *, target: FileTarget) -> None:
        self._disk = stack.enter_context(DeferredErrorFile(part))
        self._file = h5py.File(self._disk, "w", libver=("v110", "v110"))
        stack.callback(self._file.close)
        self._file.attrs["width"], self._file.attrs["height"] = target.size
        write_metadata(self._file, metadata_to_json(target.metadata), {})
        self._events = self._file.create_dataset(
            "events",
            shape=(0, 4),
            maxshape=(None, 4),
            dtype="<u4",
            chunks=(CHUNK_EVENTS, 4),
            compression="gzip",
            compression_opts=1,
            shuffle=True,
        )

    def write(self, columns: Columns) -> None:
        """Add events."""
        rows = np.stack([columns[name].astype(np.uint32) for name in ORDER], axis=1)
        start = self._events.shape[0]
        self._events.resize((start + len(rows), 4))
        self._events[start:] = rows
        self._disk.raise_failure()

    def finish(self) -> None:
        """Flush what HDF5 holds back, where a full disk still can be reported."""
        self._file.close()
        self._disk.raise_failure()


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


def _read_blocks(path: Path) -> Iterator[Columns]:
    with reporting_damage(path):
        file = h5py.File(path, "r")
    with file:
        with reporting_damage(path):
            events = _checked_events(file, path)
            count = events.shape[0]
        for start in range(0, count, PACKET_EVENTS):
            with reporting_damage(path):
                rows = events[start : start + PACKET_EVENTS].astype(np.int64)
            yield {name: rows[:, index] for index, name in enumerate(ORDER)}
