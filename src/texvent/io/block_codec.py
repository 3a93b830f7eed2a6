"""Base classes of formats that are read, and mostly written, block by block.

`inspect` reads the beginning of a file and returns a reader of its events; `start` opens a file
and returns a writer.
"""

from __future__ import annotations

import itertools
from abc import ABC, abstractmethod
from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from texvent.errors import ConfigError, FileFormatError, warn
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.block_writer import (
    BlockWriter,
    Columns,
    FileTarget,
    FormatLimits,
    SideData,
    WriteBlock,
)
from texvent.io.byte_blocks import LONGER, SHORTER
from texvent.io.input_checks import (
    existing_file,
    existing_folder,
    stored_or_given_size,
    stream_from_file,
)
from texvent.io.reading import ReadOptions, TimeUnitError
from texvent.io.repair import RepairCounts, repair_blocks, valid_events
from texvent.sensor import SensorSize


@dataclass(frozen=True)
class FileContents:
    """Facts stated by a file, and a reader of its events."""

    size: tuple[int, int] | None
    """Width and height, pixels; None where the file does not state them."""
    metadata: Mapping[str, Any]
    blocks: Callable[[], Iterator[Columns]]
    """Gives columns x, y, t, p, and label if known, block by block, from the start at each call."""
    rows: OpenRows | None = None
    """For files that find a time without reading all before it."""
    left_out: list[int] = field(default_factory=list)
    """Receives how many rows could not be read, where that is repaired."""


class BlockReader(ABC):
    """Reads one event-file format. Units, order and polarity are converted here only."""

    name: ClassVar[str]
    extensions: ClassVar[tuple[str, ...]] = ()
    """Lower case, with the dot; the first one is the usual one."""
    has_checksums: ClassVar[bool] = False
    """Whether events that were changed by damage are noticed; `texvent validate` says where not."""
    is_folder: ClassVar[bool] = False
    """Whether a recording is a folder of files."""

    takes: ClassVar[tuple[str, ...]] = ()
    """Options of reading besides size and repair."""

    def read(self, path: Path, options: ReadOptions | None = None) -> EventPackets:
        """Events of a file, block by block; each pass opens the file again.

        Args:
            path: the file.
            options: facts that the file does not state, such as the sensor size.

        Raises:
            ConfigError: the format does not take an option.
            InputError: no such file, or it stores no sensor size and none is given.
            FileFormatError: the file is damaged or of another format.
            MissingDependencyError: reading it needs a package that is not installed.
        """
        path = existing_folder(path) if self.is_folder else existing_file(path)
        options = options or ReadOptions()
        for name in ("time_unit", "columns", "stream"):
            if getattr(options, name) is not None and name not in self.takes:
                raise ConfigError(f"{path} is {self.name}, which states its {name}; leave it out")
        length = path.stat().st_size
        contents = self.inspect(path, options)
        final_size = stored_or_given_size(path, contents.size, options.size)
        if options.repair:
            return _repaired(path, contents, final_size, length)
        packets = BlockPackets(path, contents, final_size, length)
        if contents.rows is not None:
            packets = SeekableBlockPackets(path, contents, final_size, length, contents.rows)
        return EventPackets(packets, final_size, contents.metadata)

    def recognises(self, path: Path) -> bool | None:
        """True if the beginning of a file is of this format; None: the format has no mark."""
        del path
        return None

    def side_data(self, path: Path) -> SideData:
        """Triggers and IMU samples of an existing file; most formats have none.

        Raises:
            FileFormatError: the file is damaged.
        """
        del path
        return {}

    def beside(self, path: Path) -> Iterator[str]:
        """Names of what an existing file holds beside its events.

        Raises:
            FileFormatError: the file is damaged.
        """
        for name, read in self.side_data(path).items():
            if any(len(block["t"]) for block in read()):
                yield name

    @abstractmethod
    def inspect(self, path: Path, options: ReadOptions) -> FileContents:
        """Facts that an existing file states, and a function that reads its events.

        Raises:
            InputError: it does not say enough to be read.
            FileFormatError: the file is damaged or of another format.
        """


class BlockCodec(BlockReader):
    """Reads and writes one event-file format."""

    limits: ClassVar[FormatLimits]
    has_sidecar: ClassVar[bool] = False
    """Whether size and metadata are written beside the file."""
    only_read: ClassVar[tuple[str, ...]] = ()
    """Extensions of files that it reads and does not write."""
    writer: ClassVar[type[BlockWriter]] = BlockWriter

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> BlockWriter:
        """Start a file. It appears under its name only when it is complete.

        Raises:
            OutputError: it exists already, or its folder cannot be written.
            InputError: the format cannot hold this sensor size.
        """
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
            for packet in self.read(source, ReadOptions(size=target.size)):
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
    length: int
    """Bytes of the file when it was opened."""

    def __iter__(self) -> Iterator[EventStream]:
        return self._packets(self.contents.blocks())

    def _packets(self, blocks: Iterator[Columns]) -> Iterator[EventStream]:
        last_us = -(2**62)
        try:
            for columns in blocks:
                if len(columns["t"]) == 0:
                    continue
                try:
                    packet = self._stream(columns, last_us)
                except FileFormatError:
                    # What comes before the damage can be used: the error comes after it.
                    sound = valid_events(columns, self.size, last_us)
                    if sound:
                        yield self._stream({name: one[:sound] for name, one in columns.items()})
                    raise
                last_us = int(packet.t[-1])
                yield packet
            if self._change() == SHORTER:
                raise FileFormatError(SHORTER)
        except TimeUnitError:
            raise
        except FileFormatError as error:
            change = self._change()
            if change is not None:
                raise FileFormatError(f"{self.path} {change}") from error
            raise FileFormatError(f"{error}; repair=True (--repair) reads what is sound") from error

    def _change(self) -> str | None:
        """Change of the file's length since it was opened, which explains its damage."""
        now = self.path.stat().st_size if self.path.is_file() else self.length
        return None if now == self.length else SHORTER if now < self.length else LONGER

    def _stream(self, columns: Columns, last_us: int | None = None) -> EventStream:
        packet = stream_from_file(self.path, columns, self.size, self.contents.metadata)
        first_us = int(packet.t[0])
        if last_us is not None and first_us < last_us:
            raise FileFormatError(f"{self.path}: time decreases from {last_us} to {first_us} µs")
        return packet


def _repaired(path: Path, contents: FileContents, size: SensorSize, length: int) -> EventPackets:
    """Events of a damaged file; one pass counts what is repaired.

    Raises:
        FileFormatError: nothing of it can be read.

    Warns:
        TexventWarning: how much was repaired.
    """
    counts = RepairCounts()
    kept = sum(len(block["t"]) for block in repair_blocks(contents.blocks(), size, counts))
    if counts.cut_off and not kept:
        raise FileFormatError(counts.cut_off)
    counts.unreadable_rows += sum(contents.left_out)
    counts.cut_off = counts.cut_off.removeprefix(f"{path} ").removeprefix(f"{path}: ")
    facts = counts.facts()
    if facts:
        said = ", ".join(f"{name.replace('_', ' ')}: {value}" for name, value in facts.items())
        warn(f"{path} was repaired ({said})")
    metadata = {**contents.metadata, "repair": facts}

    def make() -> Iterator[Columns]:
        return repair_blocks(contents.blocks(), size, RepairCounts())

    sound = FileContents(contents.size, metadata, make)
    return EventPackets(BlockPackets(path, sound, size, length), size, metadata)


@dataclass(frozen=True)
class SeekableBlockPackets(BlockPackets):
    """Packets of a file that finds times; see `SeekablePackets`."""

    open_rows: OpenRows

    @property
    def time_range(self) -> tuple[int, int] | None:
        """Half-open range [first, last + 1) of the event times, µs, or None without events."""
        with self.open_rows() as rows:
            if not rows.count:
                return None
            first, last = rows.time_of(0), rows.time_of(rows.count - 1)
        _check_order(self.path, [first, last])
        return first, last + 1

    def between(self, start_us: int, stop_us: int) -> Iterator[EventStream]:
        """The packets of `start_us <= t < stop_us`; times read on the way must be in order."""
        return self._packets(read_between(self.path, self.open_rows, start_us, stop_us))


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


@dataclass(frozen=True)
class TimedRows:
    """The events of an open file."""

    count: int
    """Number of events."""
    time_of: Callable[[int], int]
    """Time of an event by its number, µs."""
    read: Callable[[int, int], Columns]
    """Columns of the events from one number to another, which is excluded."""
    block: int
    """Events of a packet, a multiple of `unit`."""
    unit: int = 1
    """Events that the file keeps in one piece: reading begins at a multiple."""

    def find(self, t_us: int) -> int:
        """Number of units that begin before a time; the rest of the file is not read."""
        units = range(-(-self.count // self.unit))
        return bisect_left(units, t_us, key=lambda unit: self.time_of(unit * self.unit))


OpenRows: TypeAlias = Callable[[], AbstractContextManager[TimedRows]]


def already_open(rows: TimedRows) -> OpenRows:
    """Rows that need no opening, as of arrays that open their file at each read."""
    return lambda: nullcontext(rows)


def contents_of_rows(
    size: tuple[int, int] | None, metadata: Mapping[str, Any], open_rows: OpenRows
) -> FileContents:
    """Facts of a file that finds times, and readers of its events."""
    return FileContents(size, metadata, partial(_read_rows, open_rows), open_rows)


def _read_rows(open_rows: OpenRows) -> Iterator[Columns]:
    with open_rows() as rows:
        for start in range(0, rows.count, rows.block):
            yield rows.read(start, min(start + rows.block, rows.count))


def _check_order(path: Path, times: ArrayLike) -> None:
    """Refuse times that decrease: bisection would lose events.

    Raises:
        FileFormatError: they do.
    """
    t = np.asarray(times, np.int64)
    later = np.flatnonzero(t[1:] < t[:-1])
    if len(later):
        before, after = t[later[0] : later[0] + 2].tolist()
        raise FileFormatError(f"{path}: time decreases from {before} to {after} µs")


def read_between(path: Path, open_rows: OpenRows, start_us: int, stop_us: int) -> Iterator[Columns]:
    """Columns of `start_us <= t < stop_us`, block by block.

    Raises:
        FileFormatError: times that are read on the way decrease.
    """
    with open_rows() as opened:
        seen: dict[int, int] = {}

        def time_of(index: int) -> int:
            seen[index] = opened.time_of(index)
            return seen[index]

        rows = replace(opened, time_of=time_of)
        # The unit before the first that begins at the time or later may end after it.
        first = max(rows.find(start_us) - 1, 0) * rows.unit
        end = min(rows.find(stop_us) * rows.unit, rows.count)
        _check_order(path, [seen[index] for index in sorted(seen)])
        last: list[int] = []
        for start in range(first, end, rows.block):
            columns = rows.read(start, min(start + rows.block, end))
            _check_order(path, [*last, *columns["t"][:1]])
            _check_order(path, columns["t"])
            last = columns["t"][-1:].tolist()
            a, b = np.searchsorted(columns["t"], (start_us, stop_us), side="left")
            yield {name: column[a:b] for name, column in columns.items()}
