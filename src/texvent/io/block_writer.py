"""Write an event file block by block: the checks that every writer makes, made once.

A format opens a file, adds columns to it, and knows how it begins and ends.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self, TypeAlias

from numpy.typing import NDArray

from texvent.errors import InputError, OutputError, warn
from texvent.events import EventStream
from texvent.io.atomic import atomic_file, check_output
from texvent.io.metadata import metadata_to_json, sidecar_path, sidecar_text
from texvent.sensor import SensorSize

Columns: TypeAlias = Mapping[str, NDArray[Any]]
"""Name → column of events: x, y, t, p, and label where it is known."""
SideData: TypeAlias = Mapping[str, Callable[[], Iterator[Columns]]]
"""triggers, imu: what a recording holds beside its events → reads its columns, of which t is µs."""
UNLIMITED = "hdf5 (.h5), npz (.npz) and ecd (.txt)"
"""Formats that hold every sensor size and time."""
LONGEST = "npz (.npz) or ecd (.txt)"
"""Formats that hold any span of time."""
LABELLED = "hdf5 (.h5), npz (.npz) and dsec"
"""Formats that keep labels."""


@dataclass(frozen=True)
class FormatLimits:
    """The largest sensor and time of a format."""

    name: str
    """As messages say it: `EVT3`."""
    max_side: int
    """Largest width and height, pixels."""
    stop_us: int
    """Exclusive upper limit of event times, µs."""
    max_span_us: int | None = None
    """Longest time from the origin of the file's times to the last event, µs, where limited."""
    start_us: int = 0
    """Lower limit of event times, µs."""
    keeps_labels: bool = False
    """Whether it has a place for the signal/noise label, the instance and the class of events; else
    they are left out, with a warning."""

    def check_size(self, path: Path, size: SensorSize) -> None:
        """Refuse a sensor that is too large.

        Raises:
            InputError: a side is longer than `max_side`.
        """
        if max(size) > self.max_side:
            raise InputError(
                f"cannot write {path}: {self.name} holds sensors up to "
                f"{self.max_side}x{self.max_side}, not {size}; {UNLIMITED} hold it"
            )

    def origin_us(self, first_us: int) -> int:
        """Origin of the file's times, µs, for the span: the time of its first event."""
        return first_us

    def check_packet(self, path: Path, packet: EventStream, first_us: int) -> None:
        """Refuse times that do not fit; the first event of the file is at `first_us`.

        Raises:
            InputError: see above.
        """
        start_us, last_us = int(packet.t[0]), int(packet.t[-1])
        if start_us < self.start_us:
            raise InputError(f"an event has time {start_us} µs; event files start at 0 or later")
        if last_us >= self.stop_us:
            raise InputError(
                f"cannot write {path}: an event has time {last_us} µs; {self.name} holds times "
                f"below {self.stop_us} µs ({self.stop_us / 3.6e9:.3g} h). {UNLIMITED} hold it; or "
                "check the time unit, or start the recording near 0 (texvent convert --from-zero)"
            )
        span_us = last_us - self.origin_us(first_us)
        if self.max_span_us is not None and span_us > self.max_span_us:
            raise InputError(
                f"cannot write {path}: events span {span_us / 3.6e9:.3g} h; {self.name} holds up "
                f"to {self.max_span_us / 3.6e9:.3g} h. Split the recording, check its time unit, "
                f"or write {LONGEST}"
            )


BLOCK_EVENTS = 2**18
"""Events given to a format at once, except the last."""


@dataclass(frozen=True)
class FileTarget:
    """The file that a codec is to write."""

    path: Path
    size: SensorSize
    metadata: Mapping[str, Any]
    overwrite: bool


WriteBlock: TypeAlias = Callable[[Columns], object]
"""Adds events to an open file: columns x, y, t, p, and label if known; at least one event, in time
order."""
StartFile: TypeAlias = Callable[[Path], AbstractContextManager[WriteBlock]]
"""Opens the file at a path; its `with` block ends with what follows the last event, and closes it.
After an error it is only closed."""


CopyFile: TypeAlias = Callable[[Path, FileTarget], None]
"""Copies the events of a complete file to a target, which has metadata of its own."""


class BlockWriter:
    """Checks packets, gathers them into blocks and hands these to the format; memory stays flat.

    Args:
        target: the file to write.
        start: opens the file when the `with` block is entered.
        limits: of the format.
        copy: copies a complete file of the format, with other metadata; see `add_metadata`.
        has_sidecar: whether size and metadata are written beside the file.

    Raises:
        OutputError: the file exists already, its folder refuses it, or the disk is full.
        InputError: the format cannot hold the sensor or an event; a packet of another size, or
            before the one before it; only some packets have a label; metadata that is not
            JSON-serialisable.
    """

    def __init__(
        self,
        target: FileTarget,
        start: StartFile,
        *,
        limits: FormatLimits,
        copy: CopyFile,
        has_sidecar: bool = False,
    ) -> None:
        check_output(target.path, overwrite=target.overwrite)
        if has_sidecar:
            check_output(sidecar_path(target.path), overwrite=target.overwrite)
        limits.check_size(target.path, target.size)
        metadata_to_json(target.metadata)
        self._target = target
        self._start = start
        self._limits = limits
        self._copy = copy
        self._added: dict[str, Any] = {}
        self._has_sidecar = has_sidecar
        self._stack = ExitStack()
        self._part = self._beside = target.path
        self._write: WriteBlock | None = None
        self._pending: list[EventStream] = []
        self._pending_events = 0
        self._last_us: int | None = None
        self._left_out: set[str] = set()

    def __enter__(self) -> Self:
        target = self._target
        with ExitStack() as stack:
            if self._has_sidecar:
                self._beside = stack.enter_context(
                    atomic_file(sidecar_path(target.path), overwrite=target.overwrite)
                )
                self._write_sidecar(target.metadata)
            self._part = stack.enter_context(atomic_file(target.path, overwrite=target.overwrite))
            stack.push(self._store_added)
            # Entered last: the file is closed before it gets its name.
            self._write = stack.enter_context(self._start(self._part))
            self._stack = stack.pop_all()
        return self

    def append(self, packet: EventStream) -> None:
        """Add the events of a packet, which starts no earlier than the one before it ended."""
        if self._write is None:
            raise OutputError(
                f"{self._target.path} is not open; append inside the writer's with block"
            )
        if packet.size != self._target.size:
            raise InputError(f"the packet is {packet.size}, the file is {self._target.size}")
        if len(packet) == 0:
            return
        if not self._limits.keeps_labels:
            packet = self._without_labels(packet)
        self._check(packet)
        self._last_us = int(packet.t[-1])
        self._pending.append(packet)
        self._pending_events += len(packet)
        if self._pending_events >= BLOCK_EVENTS:
            self._write_pending(self._write, final=False)

    def __exit__(self, *raised: Any) -> None:
        if raised[0] is not None or self._write is None:
            self._stack.__exit__(*raised)
            return
        with self._stack:
            self._write_pending(self._write, final=True)

    def add_metadata(self, facts: Mapping[str, Any]) -> None:
        """Store more metadata, known only now: at its end the file is written once more with it."""
        metadata_to_json(facts)
        self._added.update(facts)

    def _store_added(self, *raised: object) -> None:
        """Give the closed file, which has no name yet, the metadata that came late."""
        if raised[0] is not None or not self._added:
            return
        metadata = {**self._target.metadata, **self._added}
        if self._has_sidecar:
            self._write_sidecar(metadata)
            return
        part = self._part
        copy = part.with_stem(f"{part.stem}-copy")
        self._copy(part, FileTarget(copy, self._target.size, metadata, overwrite=True))
        os.replace(copy, part)

    def _write_sidecar(self, metadata: Mapping[str, Any]) -> None:
        self._beside.write_text(sidecar_text(self._target.size, metadata), encoding="utf-8")

    @property
    def keeps_labels(self) -> bool:
        """Whether the file holds the signal/noise label, the instance and class of events."""
        return self._limits.keeps_labels

    def _without_labels(self, packet: EventStream) -> EventStream:
        """The packet without what has no place in the file, which is said once."""
        if packet.instance is not None:
            self._warn_of("instance and class of events, which are left out", "hold them")
            packet = packet.with_ids(None, None)
        if packet.label is not None:
            silence = "hold it; without_label() or label_noise=False silences this"
            self._warn_of("signal/noise label, which is left out", silence)
            packet = packet.without_label()
        return packet

    def _warn_of(self, what: str, advice: str) -> None:
        if what not in self._left_out:
            name = self._limits.name
            warn(f"{self._target.path}: {name} has no place for the {what}; {LABELLED} {advice}")
        self._left_out.add(what)

    def _check(self, packet: EventStream) -> None:
        first_us, has_label = int(packet.t[0]), packet.label is not None
        if self._last_us is None:
            self._first_us, self._has_label = first_us, has_label
            self._has_ids = packet.instance is not None
        self._limits.check_packet(self._target.path, packet, self._first_us)
        if self._last_us is not None and first_us < self._last_us:
            raise InputError(
                f"a packet starts at {first_us} µs, before the one before it ends "
                f"({self._last_us} µs); append packets in time order"
            )
        if has_label != self._has_label:
            raise InputError(
                "some packets have a signal/noise label and some do not; give all or none one"
            )
        if (packet.instance is not None) != self._has_ids:
            raise InputError(
                "some packets have the instances of their events and some do not; give all or none"
            )

    def _write_pending(self, write: WriteBlock, *, final: bool) -> None:
        """Write whole blocks, so that how packets were cut does not show in the file."""
        if not self._pending:
            return
        only = self._pending[0] if len(self._pending) == 1 else EventStream.concat(self._pending)
        columns = only.columns()
        count = len(only) if final else len(only) // BLOCK_EVENTS * BLOCK_EVENTS
        for start in range(0, count, BLOCK_EVENTS):
            block = slice(start, min(start + BLOCK_EVENTS, count))
            write({name: column[block] for name, column in columns.items()})
        rest = only[count:]
        self._pending = [rest] if len(rest) else []
        self._pending_events = len(rest)
