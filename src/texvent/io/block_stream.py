"""Event files as blocks of columns: the checks that every writer and reader makes, made once.

A format brings two small parts. Reading: a generator of columns x, y, t, p, called anew for each
pass over the file. Writing: a sink that takes columns and knows how the file begins and ends.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol, Self

from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, OutputError
from texvent.events import EventStream
from texvent.io.atomic import atomic_file, check_output
from texvent.io.columns import metadata_to_json, stream_from_file
from texvent.io.limits import FormatLimits
from texvent.io.sidecar import sidecar_path, sidecar_text
from texvent.sensor import SensorSize

BLOCK_EVENTS = 2**18
"""Events given to a sink at once, except the last."""
BLOCK_BYTES = 2**21
"""Bytes read at once from files of fixed records."""

Columns = Mapping[str, NDArray[Any]]


@dataclass(frozen=True)
class FileTarget:
    """What a codec is asked to write."""

    path: Path
    size: SensorSize
    metadata: Mapping[str, Any]
    overwrite: bool


class BlockSink(Protocol):
    """The open file of one format."""

    def write(self, columns: Columns) -> None:
        """Add events: columns x, y, t, p, at least one event, in time order."""
        ...

    def finish(self) -> None:
        """Write what follows the last event; not called after an error."""
        ...


StartSink = Callable[[Path, ExitStack], BlockSink]
"""Opens the file at a path, on a stack that closes it after `finish` or an error."""


class BlockWriter:
    """Checks packets, gathers them into blocks and hands these to a sink; memory stays flat.

    Args:
        target: what to write.
        start: opens the sink when the `with` block is entered.
        limits: what the format holds.
        sidecar: whether size and metadata are written beside the file.
        place: gives a path that becomes the target's when its block ends without error.

    Raises:
        OutputError: the file exists already, its folder refuses it, or the disk is full.
        InputError: the format cannot hold the sensor or an event; a packet of another size, or
            before the one before it; metadata that is not JSON-serialisable.
    """

    def __init__(
        self,
        target: FileTarget,
        start: StartSink,
        *,
        limits: FormatLimits,
        sidecar: bool = False,
        place: Callable[..., AbstractContextManager[Path]] = atomic_file,
    ) -> None:
        if place is atomic_file:
            check_output(target.path, overwrite=target.overwrite)
        if sidecar:
            check_output(sidecar_path(target.path), overwrite=target.overwrite)
        limits.check_size(target.path, target.size)
        metadata_to_json(target.metadata)
        self._target = target
        self._start = start
        self._limits = limits
        self._sidecar = sidecar
        self._place = place
        self._stack = ExitStack()
        self._sink: BlockSink | None = None
        self._pending: list[EventStream] = []
        self._pending_events = 0
        self._first_us: int | None = None
        self._last_us = 0

    def __enter__(self) -> Self:
        target = self._target
        with ExitStack() as stack:
            if self._sidecar:
                beside = stack.enter_context(
                    atomic_file(sidecar_path(target.path), overwrite=target.overwrite)
                )
                beside.write_text(sidecar_text(target.size, target.metadata), encoding="utf-8")
            part = stack.enter_context(self._place(target.path, overwrite=target.overwrite))
            # On a stack of its own: the file is closed before it gets its name.
            inner = stack.enter_context(ExitStack())
            self._sink = self._start(part, inner)
            self._stack = stack.pop_all()
        return self

    def append(self, packet: EventStream) -> None:
        """Add the events of a packet, which starts no earlier than the one before it ended."""
        path, size = self._target.path, self._target.size
        if self._sink is None:
            raise OutputError(f"{path} is not open; append inside the writer's with block")
        if packet.size != size:
            raise InputError(f"the packet is {packet.size}, the file is {size}")
        if len(packet) == 0:
            return
        first = int(packet.t[0])
        self._first_us = first if self._first_us is None else self._first_us
        self._limits.check_packet(path, packet, self._first_us)
        if first < self._last_us:
            raise InputError(
                f"a packet starts at {first} µs, before the one before it ends "
                f"({self._last_us} µs); append packets in time order"
            )
        self._last_us = int(packet.t[-1])
        self._pending.append(packet)
        self._pending_events += len(packet)
        if self._pending_events >= BLOCK_EVENTS:
            self._write_pending(self._sink, final=False)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is not None or self._sink is None:
            self._stack.__exit__(kind, error, trace)
            return
        with self._stack:
            self._write_pending(self._sink, final=True)
            self._sink.finish()

    def _write_pending(self, sink: BlockSink, *, final: bool) -> None:
        """Write whole blocks, so that how packets were cut does not show in the file."""
        if not self._pending:
            return
        only = self._pending[0] if len(self._pending) == 1 else EventStream.concat(self._pending)
        columns = only.columns()
        count = len(only) if final else len(only) // BLOCK_EVENTS * BLOCK_EVENTS
        for start in range(0, count, BLOCK_EVENTS):
            piece = slice(start, min(start + BLOCK_EVENTS, count))
            sink.write({name: column[piece] for name, column in columns.items()})
        rest = only[count:]
        self._pending = [rest] if len(rest) else []
        self._pending_events = len(rest)


class BlockPackets:
    """Re-iterable packets of a file.

    Args:
        path: the file.
        blocks: gives the file's columns x, y, t, p block by block, anew at each call.
        size: sensor size, pixels.
        metadata: of every packet.
    """

    def __init__(
        self,
        path: Path,
        blocks: Callable[[], Iterator[Columns]],
        size: SensorSize,
        metadata: Mapping[str, Any],
    ) -> None:
        self._path = path
        self._blocks = blocks
        self._size = size
        self._metadata = metadata

    def __iter__(self) -> Iterator[EventStream]:
        last_us: int | None = None
        for columns in self._blocks():
            packet = stream_from_file(self._path, columns, self._size, self._metadata)
            if len(packet) == 0:
                continue
            first = int(packet.t[0])
            if last_us is not None and first < last_us:
                raise FileFormatError(f"{self._path}: time decreases from {last_us} to {first} µs")
            last_us = int(packet.t[-1])
            yield packet


class RecordSink:
    """A file that is a header followed by records, made by a function of the columns.

    Args:
        file: open for writing bytes.
        encode: makes bytes of columns x, y, t, p.
    """

    def __init__(self, file: Any, encode: Callable[[Columns], bytes | memoryview]) -> None:
        self._file = file
        self._encode = encode

    def write(self, columns: Columns) -> None:
        """Add events."""
        self._file.write(self._encode(columns))

    def finish(self) -> None:
        """Nothing follows the last record."""


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
