"""What writing any HDF5 event file takes: whole chunks, flat memory, nothing half-written."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, ClassVar, Self

import h5py

from texvent.errors import InputError, OutputError
from texvent.events import EventStream
from texvent.io.atomic import atomic_file, check_output
from texvent.io.columns import metadata_to_json
from texvent.io.hdf5.deferred_error_file import DeferredErrorFile
from texvent.runtime.interrupts import delay_interrupts
from texvent.sensor import SensorSize

BATCH_EVENTS = 262_144
"""Events held before they are coded and written."""


class BatchedHdf5Writer(ABC):
    """Gathers packets into batches of whole chunks; a layout says how a batch is stored.

    Raises:
        OutputError: the file exists already, its folder refuses it, or the disk is full.
        InputError: a packet of another size, or before the one before it.
    """

    chunk_events: ClassVar[int]
    """Events per chunk of the file."""

    def __init__(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> None:
        check_output(path, overwrite=overwrite)
        self._path = path
        self._size = size
        self._overwrite = overwrite
        self._metadata = metadata
        self._json = metadata_to_json(metadata)
        self._stack = ExitStack()
        self._file: Any = None
        self._disk: Any = None
        self._pending: list[EventStream] = []
        self._pending_events = 0
        self._written = 0
        self._last_us = 0

    def __enter__(self) -> Self:
        with delay_interrupts(), ExitStack() as stack:
            part = stack.enter_context(atomic_file(self._path, overwrite=self._overwrite))
            self._disk = stack.enter_context(DeferredErrorFile(part))
            # v110: object headers and chunk indexes then carry checksums.
            self._file = h5py.File(self._disk, "w", libver=("v110", "v110"))
            stack.callback(self._file.close)
            self._create_layout()
            self._stack = stack.pop_all()
        return self

    def append(self, packet: EventStream) -> None:
        """Add the events of a packet, which starts no earlier than the one before it ended."""
        if self._file is None:
            raise OutputError(f"{self._path} is not open; append inside the writer's with block")
        if packet.size != self._size:
            raise InputError(f"the packet is {packet.size}, the file is {self._size}")
        if len(packet) == 0:
            return
        self._check(packet)
        first = int(packet.t[0])
        if first < self._last_us:
            raise InputError(
                f"a packet starts at {first} µs, before the one before it ends "
                f"({self._last_us} µs); append packets in time order"
            )
        self._last_us = int(packet.t[-1])
        self._pending.append(packet)
        self._pending_events += len(packet)
        if self._pending_events >= BATCH_EVENTS:
            with delay_interrupts():
                self._write_pending(final=False)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        with delay_interrupts():
            if error is not None:
                self._stack.__exit__(kind, error, trace)
                return
            with self._stack:
                self._finish()

    @abstractmethod
    def _create_layout(self) -> None:
        """Create the data sets and attributes of an empty file."""

    @abstractmethod
    def _check(self, packet: EventStream) -> None:
        """Refuse events that the layout cannot hold; `packet` has at least one."""

    @abstractmethod
    def _store(self, events: EventStream, count: int) -> None:
        """Write the first `count` events behind the `_written` ones."""

    @abstractmethod
    def _complete(self) -> None:
        """Write what is known only at the end."""

    def _write_pending(self, *, final: bool) -> None:
        """Write whole chunks, so that none is coded twice; at the end, the rest too."""
        whole = EventStream.concat(self._pending)
        chunk = self.chunk_events
        count = len(whole) if final else len(whole) // chunk * chunk
        self._store(whole, count)
        self._disk.raise_failure()
        self._written += count
        self._pending = [whole[count:]]
        self._pending_events = len(whole) - count

    def _extend(self, name: str, values: Any) -> None:
        """Append to a one-dimensional data set."""
        dataset = self._file[name]
        known = dataset.shape[0]
        dataset.resize((known + len(values),))
        dataset[known:] = values

    def _finish(self) -> None:
        if self._pending_events:
            self._write_pending(final=True)
        self._complete()
        self._file.close()
        self._disk.raise_failure()
