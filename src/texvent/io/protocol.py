"""Interfaces of event-file formats."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, ClassVar, Protocol, Self, TypeAlias, runtime_checkable

from numpy.typing import NDArray

from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.reading import ReadOptions
from texvent.sensor import SensorSize

Columns: TypeAlias = Mapping[str, NDArray[Any]]
"""Name → column of events: x, y, t, p, and label where it is known."""
SideData: TypeAlias = Mapping[str, Callable[[], Iterator[Columns]]]
"""triggers, imu: what a recording holds beside its events → reads its columns, of which t is µs."""


class EventWriter(Protocol):
    """Writes one file, packet by packet; an exception inside its `with` block leaves no file."""

    def append(self, packet: EventStream) -> None:
        """Add the events of a packet, which starts no earlier than the one before it ended."""
        ...

    def add_metadata(self, facts: Mapping[str, Any]) -> None:
        """Store more metadata, known only after the file was begun, such as that it is cut off."""
        ...

    def __enter__(self) -> Self: ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None: ...


class EventReader(Protocol):
    """Reads one event-file format. Units, order and polarity are converted here only."""

    name: ClassVar[str]
    extensions: ClassVar[tuple[str, ...]]
    """Lower case, with the dot; the first one is the usual one."""

    def read(self, path: Path, options: ReadOptions | None = None) -> EventPackets:
        """Events of a file, packet by packet.

        Args:
            path: the file.
            options: facts that the file does not state, such as the sensor size.

        Raises:
            InputError: no such file, or the size is not stored and not given.
            FileFormatError: the file is damaged or of another format.
        """
        ...


@runtime_checkable
class EventCodec(EventReader, Protocol):
    """Reads and writes one event-file format."""

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> EventWriter:
        """Start a file. It appears under its name only when it is complete.

        Raises:
            OutputError: it exists already, or its folder cannot be written.
            InputError: the format cannot hold this sensor size.
        """
        ...


@runtime_checkable
class RecognisingCodec(Protocol):
    """A format that recognises its own files among others of the same extension."""

    def recognises(self, path: Path) -> bool:
        """True if the beginning of the file is of this format; False too if it cannot be read."""
        ...
