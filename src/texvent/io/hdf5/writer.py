"""What writing any HDF5 event file takes: errors of the disk seen in time, Ctrl-C kept out."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any, ClassVar, Self

import h5py

from texvent.io.block_codec import BlockCodec
from texvent.io.block_writer import BlockWriter, FileTarget, WriteBlock
from texvent.io.hdf5.deferred_error_file import DeferredErrorFile
from texvent.io.limits import FormatLimits
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

    def _write_pending(self, write: WriteBlock, *, final: bool) -> None:
        with delay_interrupts():
            super()._write_pending(write, final=final)


class Hdf5BlockCodec(BlockCodec):
    """An HDF5 layout; its sink says how blocks are stored."""

    extensions: ClassVar[tuple[str, ...]] = (".h5", ".hdf5")
    writer: ClassVar[type[BlockWriter]] = Hdf5Writer
    sink: ClassVar[type[Hdf5Sink]]

    @contextmanager
    def start(self, target: FileTarget, part: Path) -> Iterator[WriteBlock]:
        """Create the empty data sets; what HDF5 holds back is written at the end."""
        # v110: object headers and chunk indexes then carry checksums.
        with (
            DeferredErrorFile(part) as disk,
            h5py.File(disk, "w", libver=("v110", "v110")) as file,
        ):
            sink = self.sink(file, target, self.limits)

            def write(columns: Columns) -> None:
                sink.store(columns)
                disk.raise_failure()
                sink.written += len(columns["t"])

            yield write
            sink.complete()
            file.close()
            disk.raise_failure()


class Hdf5Sink(ABC):
    """Stores blocks in an HDF5 file. They hold whole chunks, except the last.

    Args:
        file: h5py's, new and open.
        target: what is written.
        limits: of the format.
    """

    def __init__(self, file: Any, target: FileTarget, limits: FormatLimits) -> None:
        self._file = file
        self._limits = limits
        self.written = 0
        """Events stored so far."""
        self._create_layout(target)

    @abstractmethod
    def store(self, columns: Columns) -> None:
        """Write events behind the `written` ones."""

    def complete(self) -> None:  # noqa: B027  # some layouts have nothing to add
        """Write what is known only at the end."""

    @abstractmethod
    def _create_layout(self, target: FileTarget) -> None:
        """Create the data sets and attributes of an empty file."""

    def _extend(self, name: str, values: Any) -> None:
        """Append to a data set along its first axis."""
        dataset = self._file[name]
        known = dataset.shape[0]
        dataset.resize(known + len(values), axis=0)
        dataset[known:] = values
