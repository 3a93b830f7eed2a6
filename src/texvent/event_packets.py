"""Recordings as packets of events, which need not fit in memory."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from texvent.event_methods import EventMethods, call_method, time_edit, with_edit
from texvent.events import EventStream
from texvent.options.time_range import SeenTimes, check_time_range, warn_of_doubtful_range
from texvent.runtime.progress import Progress
from texvent.runtime.progress_option import ProgressOption, open_progress
from texvent.runtime.read_once import ReadOnce
from texvent.sensor import SensorSize, as_size


@runtime_checkable
class SeekablePackets(Protocol):
    """Packets of a file that finds a time without reading all before it."""

    @property
    def time_range(self) -> tuple[int, int] | None:
        """As `EventPackets.time_range`."""
        ...

    def between(self, start_us: int, stop_us: int) -> Iterator[EventStream]:
        """The packets of `start_us <= t < stop_us`."""
        ...


@runtime_checkable
class ReportingPackets(Protocol):
    """Packets that take long to make, and report how far they are."""

    def report_to(self, progress: Progress) -> Iterator[EventStream]:
        """The packets; `progress` receives each step."""
        ...


@dataclass(frozen=True)
class LazyPackets:
    """Packets that a function makes again for each pass."""

    make: Callable[[], Iterator[EventStream]]

    def __iter__(self) -> Iterator[EventStream]:
        return self.make()


def _ignore(times: SeenTimes) -> None:
    """Say nothing."""


@dataclass(frozen=True, eq=False, repr=False)
class EventPackets(EventMethods):
    """Events packet by packet, for recordings that need not fit in memory.

    Every pass reads or simulates them again; of a generator or a camera there is one pass.

    Example:
        >>> from texvent import EventPackets, EventStream
        >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
        >>> packets = EventPackets([events[:1], events[1:]], events.size)
        >>> packets.time_range, len(packets.between(15, 30).collect())
        ((10, 21), 1)
        >>> [int(array.sum()) for array in packets.represent("event-frame", duration_us=8)]
        [1, -1]
    """

    packets: Iterable[EventStream]
    """Packets in time order; each starts no earlier than the one before it ends."""
    size: SensorSize
    metadata: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "size", as_size(self.size))
        if isinstance(self.packets, Iterator):
            once = ReadOnce(self.packets, "a generator of packets")
            object.__setattr__(self, "packets", once)

    def __iter__(self) -> Iterator[EventStream]:
        return iter(self.packets)

    def __repr__(self) -> str:
        return f"EventPackets({self.size}, read when iterated)"

    def collect(self, *, progress: ProgressOption = False) -> EventStream:
        """All packets in one stream, in memory; for `progress` see `save`.

        Example:
            >>> from texvent import EventPackets, EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> EventPackets([events[:1], events[1:]], events.size).collect() == events
            True
        """
        with open_progress(progress) as shown:
            packets = list(self._reporting_to(shown))
        whole = EventStream.concat([EventStream.empty(self.size), *packets])
        return whole.with_metadata(self.metadata)

    @property
    def time_range(self) -> tuple[int, int] | None:
        """Half-open range [first, last + 1) of the event times, µs, or None without events.

        An HDF5 file is asked for its first and last event; all other packets are read.
        """
        if isinstance(self.packets, SeekablePackets):
            return self.packets.time_range
        ranges = [packet.time_range for packet in self]
        known = [one for one in ranges if one is not None]
        return (known[0][0], known[-1][1]) if known else None

    def between(self, start_us: int, stop_us: int) -> EventPackets:
        """The events with `start_us <= t < stop_us`; what comes later is not read.

        In an HDF5 file, what comes before is not read either.

        Raises:
            InputError: the stop lies before the start.

        Warns:
            TexventWarning: the range is empty, outside of the recording, or looks like seconds;
                found while reading, where the format does not tell its times before.

        Example:
            >>> from texvent import EventPackets, EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> EventPackets([events[:1], events[1:]], events.size).between(10, 20).collect()
            EventStream(1 events, 8x6, t 10..10 µs)
        """
        check_time_range(start_us, stop_us)
        part = self.cut(start_us, stop_us, partial(warn_of_doubtful_range, start_us, stop_us))
        noted = with_edit(self.metadata, time_edit(start_us, stop_us))
        return EventPackets(part.packets, part.size, noted)

    def cut(
        self, start_us: int, stop_us: int, on_times: Callable[[SeenTimes], None] = _ignore
    ) -> EventPackets:
        """As `between`, for programs that go through time: any range is taken without a word.

        Args:
            start_us: first time, µs.
            stop_us: the time before which the events end, µs.
            on_times: given the times of the recording as soon as they are known, if it has events.

        Example:
            >>> from texvent import EventPackets, EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> packets = EventPackets([events[:1], events[1:]], events.size)
            >>> [len(one) for one in packets.cut(15, 90)]
            [0, 1]
        """
        packets = self.packets
        if not isinstance(packets, SeekablePackets):
            make = partial(_packets_between, packets, start_us, stop_us, on_times)
            return EventPackets(LazyPackets(make), self.size, self.metadata)
        span = None if on_times is _ignore else packets.time_range
        if span is not None:
            on_times(SeenTimes(*span))
        make = partial(packets.between, start_us, stop_us)
        return EventPackets(LazyPackets(make), self.size, self.metadata)

    def save(
        self,
        path: str | Path,
        *,
        format: str | None = None,
        overwrite: bool = False,
        progress: ProgressOption = None,
    ) -> Path:
        """Write to a file with flat memory, its format taken from the extension unless given.

        Args:
            path: the file; see `texvent.io.files` for the formats.
            format: its format, where the extension does not say.
            overwrite: whether an existing file may be replaced.
            progress: a bar (True), none (False), a function that takes steps done, steps in all or
                None, and what is done; default: a bar in a terminal or notebook.

        Raises:
            OutputError: it exists already, its folder cannot be written, or the disk is full.
            ConfigError: unknown format or extension.

        Example:
            >>> import texvent
            >>> packets = texvent.generate(
            ...     "a red ball bounces", sensor="48x36", duration=0.2, as_packets=True
            ... )
            >>> packets.save("ball.npz", progress=False).name
            'ball.npz'
        """
        with open_progress(progress) as shown:
            packets = self.reporting_to(shown)
            saved: Path = call_method("save", path, packets, format=format, overwrite=overwrite)
        return saved

    def represent(
        self,
        name: str,
        *,
        duration_us: int | None = None,
        count: int | None = None,
        device: str | None = None,
        **options: Any,
    ) -> Iterator[Any]:
        """A dense array for every slice of the recording, in time order, with flat memory.

        For one array of everything, use `collect().represent(name)`.

        Args:
            name: such as "voxel-e2vid".
            duration_us: length of a slice, µs, from the first event on.
            count: events per slice. Give either this or `duration_us`.
            device: give torch tensors on this device.
            **options: of the representation, such as `bins=5`; those that name its window are
                filled in.

        Raises:
            ConfigError: unknown name or option, or both or none of `duration_us` and `count`.

        Example:
            >>> from texvent import EventPackets, EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> frames = EventPackets([events], events.size).represent("event-frame", count=1)
            >>> [int(frame.sum()) for frame in frames]
            [1, -1]
        """
        given = {"duration_us": duration_us, "count": count, "device": device, **options}
        arrays: Iterator[Any] = call_method("represent_slices", name, self, **given)
        return arrays

    def reporting_to(self, progress: Progress) -> EventPackets:
        """The same packets; `progress` is called for each, at every pass."""
        make = partial(self._reporting_to, progress)
        return EventPackets(LazyPackets(make), self.size, self.metadata)

    def _reporting_to(self, progress: Progress) -> Iterator[EventStream]:
        """The packets; `progress` is called for each."""
        if isinstance(self.packets, ReportingPackets):
            yield from self.packets.report_to(progress)
            return
        events = 0
        for packet in self.packets:
            events += len(packet)
            progress.advance("events", events, None)
            yield packet


def _packets_between(
    packets: Iterable[EventStream],
    start_us: int,
    stop_us: int,
    on_times: Callable[[SeenTimes], None],
) -> Iterator[EventStream]:
    seen = None
    for packet in packets:
        yield packet.cut(start_us, stop_us)
        if len(packet):
            first_us = int(packet.t[0]) if seen is None else seen.first_us
            seen = SeenTimes(first_us, int(packet.t[-1]) + 1)
            if seen.end_us > stop_us:
                on_times(seen._replace(is_whole=False))
                return
    if seen is not None:
        on_times(seen)
