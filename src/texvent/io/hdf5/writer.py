"""What writing any HDF5 event file takes: errors of the disk seen in time, Ctrl-C kept out."""

from __future__ import annotations

from abc import ABC, abstractmethod
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import h5py

from texvent.io.block_writer import BlockSink, BlockWriter, FileTarget
from texvent.io.hdf5.deferred_error_file import DeferredErrorFile
from texvent.io.protocol import Columns
from texvent.runtime.interrupts import delay_interrupts


class Hdf5Writer(BlockWriter):
    """Keeps Ctrl-C out of HDF5's callbacks; see `delay_interrupts`."""

    def __enter__(self) -> Self:
        with delay_interrupts():
            return super().__enter__()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        with delay_interrupts():
            super().__exit__(kind, error, trace)

    def _write_pending(self, sink: BlockSink, *, final: bool) -> None:
        with delay_interrupts():
            super()._write_pending(sink, final=final)


class Hdf5Sink(ABC):
    """An HDF5 file to write; a layout says how blocks are stored.

    Blocks hold whole chunks, except the last.
    """

    def __init__(self, target: FileTarget, part: Path, stack: ExitStack) -> None:
        self._disk = stack.enter_context(DeferredErrorFile(part))
        # v110: object headers and chunk indexes then carry checksums.
        self._file: Any = h5py.File(self._disk, "w", libver=("v110", "v110"))
        stack.callback(self._file.close)
        self._written = 0
        """Events stored so far."""
        self._create_layout(target)

    def write(self, columns: Columns) -> None:
        """Add events.

        Raises:
            OSError: the disk is full, or refuses them.
        """
        self._store(columns)
        self._disk.raise_failure()
        self._written += len(columns["t"])

    def finish(self) -> None:
        """Write what is known only at the end, and all that HDF5 holds back.

        Raises:
            OSError: the disk is full, or refuses it.
        """
        self._complete()
        self._file.close()
        self._disk.raise_failure()

    @abstractmethod
    def _create_layout(self, target: FileTarget) -> None:
        """Create the data sets and attributes of an empty file."""

    @abstractmethod
    def _store(self, columns: Columns) -> None:
        """Write events behind the `_written` ones."""

    def _complete(self) -> None:  # noqa: B027  # some layouts have nothing to add
        """Write what is known only at the end."""

    def _extend(self, name: str, values: Any) -> None:
        """Append to a data set along its first axis."""
        dataset = self._file[name]
        known = dataset.shape[0]
        dataset.resize(known + len(values), axis=0)
        dataset[known:] = values
