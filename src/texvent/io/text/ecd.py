"""Text rows `t x y p` (seconds, pixels, 0/1): the Event Camera Dataset's events.txt.

The rows hold neither the sensor size nor how the events were made, so texvent writes both into
`NAME.txt.json` beside the text, and reads the size from there. Any other file needs the size
from the caller; it is never guessed from the largest coordinate.

The signal/noise label of events has no place in these rows and is left out.

Times are written with exactly six decimals: whole µs, read back unchanged.

Source: Mueggler et al., The Event-Camera Dataset and Simulator, IJRR 2017.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import Any, ClassVar, Self

from texvent.errors import FileFormatError, InputError, OutputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.atomic import atomic_file, check_output
from texvent.io.columns import existing_file, stored_or_given_size, stream_from_file
from texvent.io.sidecar import read_sidecar, sidecar_path, sidecar_text
from texvent.io.text.rows import make_rows, parse_rows, read_text_blocks
from texvent.sensor import SensorSize


class EcdCodec:
    """Event Camera Dataset text."""

    name: ClassVar[str] = "ecd"
    extensions: ClassVar[tuple[str, ...]] = (".txt",)

    def read(self, path: Path, *, size: SensorSize | None = None) -> EventPackets:
        """Events of a text file, block by block.

        Raises:
            InputError: no such file, or no size is given and none lies beside it.
            FileFormatError: a row is not `t x y p`.
        """
        path = existing_file(path)
        stored, metadata = read_sidecar(path)
        final_size = stored_or_given_size(path, stored, size)
        return EventPackets(_Packets(path, final_size, metadata), final_size, metadata)

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> EcdWriter:
        """Start a text file; see `EventCodec.open_writer`."""
        return EcdWriter(path, size=size, metadata=metadata, overwrite=overwrite)


class EcdWriter:
    """Appends rows as packets come, and writes size and metadata beside them.

    Raises:
        OutputError: a file exists already, its folder refuses it, or the disk is full.
        InputError: a packet of another size, before the one before it, or before time 0.
    """

    def __init__(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> None:
        self._path = Path(path)
        self._sidecar = sidecar_path(path)
        for one in (self._path, self._sidecar):
            check_output(one, overwrite=overwrite)
        self._size = size
        self._overwrite = overwrite
        self._sidecar_text = sidecar_text(size, metadata)
        self._stack = ExitStack()
        self._file: Any = None
        self._last_us = 0

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            beside = stack.enter_context(atomic_file(self._sidecar, overwrite=self._overwrite))
            part = stack.enter_context(atomic_file(self._path, overwrite=self._overwrite))
            beside.write_text(self._sidecar_text, encoding="utf-8")
            self._file = stack.enter_context(part.open("w", encoding="ascii", newline="\n"))
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
        first = int(packet.t[0])
        if first < self._last_us:
            raise InputError(
                f"a packet starts at {first} µs, before {self._last_us} µs; "
                "append packets in time order, from 0 on"
            )
        self._last_us = int(packet.t[-1])
        self._file.write(make_rows(packet.columns()))

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.__exit__(kind, error, trace)


class _Packets:
    """Re-iterable packets of a text file."""

    def __init__(self, path: Path, size: SensorSize, metadata: Mapping[str, Any]) -> None:
        self._path = path
        self._size = size
        self._metadata = metadata

    def __iter__(self) -> Iterator[EventStream]:
        last_us: int | None = None
        with self._path.open("rb") as file:
            for block in read_text_blocks(file):
                columns = parse_rows(block, self._path)
                packet = stream_from_file(self._path, columns, self._size, self._metadata)
                if len(packet) == 0:
                    continue
                if last_us is not None and int(packet.t[0]) < last_us:
                    raise FileFormatError(f"{self._path}: time decreases at {packet.t[0]} µs")
                last_us = int(packet.t[-1])
                yield packet
