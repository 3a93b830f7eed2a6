"""Base classes of formats that are read, and mostly written, block by block.

`inspect` reads the beginning of a file and returns a reader of its events; `start` opens a file
and returns a writer.
"""

from __future__ import annotations

import itertools
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.errors import FileFormatError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.block_writer import BlockWriter, FileTarget, WriteBlock
from texvent.io.input_checks import (
    existing_file,
    existing_folder,
    stored_or_given_size,
    stream_from_file,
)
from texvent.io.limits import FormatLimits
from texvent.io.protocol import Columns
from texvent.sensor import SensorSize

BLOCK_BYTES = 2**21
"""Bytes read at once from files of fixed records."""


@dataclass(frozen=True)
class TimeSeek:
    """How a file finds a time without reading all before it."""

    time_range: Callable[[], tuple[int, int] | None]
    """Half-open range of the event times, µs; None without events."""
    blocks: Callable[[int, int], Iterator[Columns]]
    """Gives the columns of `start_us <= t < stop_us`, block by block."""


@dataclass(frozen=True)
class FileContents:
    """What a file states, and its events."""

    size: tuple[int, int] | None
    """Width and height, pixels; None where the file does not state them."""
    metadata: Mapping[str, Any]
    blocks: Callable[[], Iterator[Columns]]
    """Gives columns x, y, t, p, and label if known, block by block, anew at each call."""
    seek: TimeSeek | None = None
    """For files that can find a time."""


class BlockReader(ABC):
    """Reads one format; see `EventReader`."""

    name: ClassVar[str]
    extensions: ClassVar[tuple[str, ...]] = ()
    has_checksums: ClassVar[bool] = False
    """Whether events that were changed by damage are noticed; `texvent validate` says where not."""
    is_folder: ClassVar[bool] = False
    """Whether a recording is a folder of files."""

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of a file, block by block; the file is opened anew for each pass.

        Raises:
            InputError: no such file, or it stores no sensor size and none is given.
            FileFormatError: the file is damaged or of another format.
            MissingDependencyError: reading it needs a package that is not installed.
        """
        path = existing_folder(path) if self.is_folder else existing_file(path)
        contents = self.inspect(path)
        final_size = stored_or_given_size(path, contents.size, size)
        packets = BlockPackets(path, contents, final_size)
        if contents.seek is not None:
            packets = SeekableBlockPackets(path, contents, final_size, contents.seek)
        return EventPackets(packets, final_size, contents.metadata)

    @abstractmethod
    def inspect(self, path: Path) -> FileContents:
        """Facts that an existing file states, and a function that reads its events.

        Raises:
            InputError: it does not say enough to be read.
            FileFormatError: the file is damaged or of another format.
        """


class BlockCodec(BlockReader):
    """Reads and writes one format; see `EventCodec`."""

    limits: ClassVar[FormatLimits]
    has_sidecar: ClassVar[bool] = False
    """Whether size and metadata are written beside the file."""
    writer: ClassVar[type[BlockWriter]] = BlockWriter

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> BlockWriter:
        """Start a file; see `EventCodec.open_writer`."""
        target = FileTarget(path, size, metadata, overwrite)
        self.check_target(target)
        return self.writer(
            target,
            partial(self.start, target),
            limits=self.limits,
            copy=self.copy,
            has_sidecar=self.has_sidecar,
        )

    def copy(self, source: Path, target: FileTarget) -> None:
        """Copy the events of a complete file to a target, which has metadata of its own."""
        writer = self.open_writer(
            target.path, size=target.size, metadata=target.metadata, overwrite=target.overwrite
        )
        with writer:
            for packet in self.read(source, size=target.size):
                writer.append(packet)

    @abstractmethod
    def start(self, target: FileTarget, part: Path) -> AbstractContextManager[WriteBlock]:
        """Open the file `part`; see `block_writer.StartFile`."""

    def check_target(self, target: FileTarget) -> None:  # most refuse no more
        """Refuse, before a file is made, what `limits` do not say.

        Raises:
            InputError: the format cannot hold this sensor.
            MissingDependencyError: writing needs a package that is not installed.
        """


@dataclass(frozen=True)
class BlockPackets:
    """Re-iterable packets of a file."""

    path: Path
    contents: FileContents
    size: SensorSize

    def __iter__(self) -> Iterator[EventStream]:
        return self._packets(self.contents.blocks())

    def _packets(self, blocks: Iterator[Columns]) -> Iterator[EventStream]:
        last_us: int | None = None
        for columns in blocks:
            packet = stream_from_file(self.path, columns, self.size, self.contents.metadata)
            if len(packet) == 0:
                continue
            first = int(packet.t[0])
            if last_us is not None and first < last_us:
                raise FileFormatError(f"{self.path}: time decreases from {last_us} to {first} µs")
            last_us = int(packet.t[-1])
            yield packet


@dataclass(frozen=True)
class SeekableBlockPackets(BlockPackets):
    """Packets of a file that finds times; see `SeekablePackets`."""

    seek: TimeSeek

    @property
    def time_range(self) -> tuple[int, int] | None:
        """Half-open range [first, last + 1) of the event times, µs, or None without events."""
        return self.seek.time_range()

    def between(self, start_us: int, stop_us: int) -> Iterator[EventStream]:
        """The packets of `start_us <= t < stop_us`."""
        return self._packets(self.seek.blocks(start_us, stop_us))


def split_by_time(columns: Columns, length_us: int) -> Iterator[Columns]:
    """Columns x, y, t, p in parts, none across a multiple of `length_us`."""
    windows = columns["t"] // length_us
    cuts = np.flatnonzero(windows[1:] != windows[:-1]) + 1
    for start, stop in itertools.pairwise([0, *cuts.tolist(), len(windows)]):
        yield {name: columns[name][start:stop] for name in "xytp"}


@contextmanager
def write_records(
    part: Path, header: bytes, encode: Callable[[Columns], bytes | memoryview]
) -> Iterator[WriteBlock]:
    """A file that is a header followed by records, which a function makes of the columns."""
    with part.open("wb") as file:
        file.write(header)
        yield lambda columns: file.write(encode(columns))


def read_records(path: Path, start: int, record_bytes: int) -> Iterator[bytes]:
    """The bytes of whole records, from `start` on, a block at a time.

    Raises:
        FileFormatError: the file ends inside a record.
    """
    block_bytes = BLOCK_BYTES // record_bytes * record_bytes
    with path.open("rb") as file:
        file.seek(start)
        while block := file.read(block_bytes):
            if len(block) % record_bytes:
                raise FileFormatError(
                    f"{path} ends inside a record of {record_bytes} bytes; the file was cut off"
                )
            yield block
