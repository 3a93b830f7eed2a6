"""Events: `(x, y, t, p)` in four arrays, with the size of the sensor they came from.

What always holds:

* `x`, `y` are uint16 inside the sensor, origin top left; `t` is int64 µs, non-decreasing;
  `p` is uint8, 1 = ON (brighter), 0 = OFF. `polarity` gives the signed ±1 form.
* Ties in time are ordered by (t, y, x, p).
* Arrays are read-only views; the caller's own array stays writable.
* "No events" is an empty stream, never None.
* Other codings (±1, seconds, other column orders) are converted in `texvent.io` only.
"""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from texvent.errors import InputError, one_line, shown
from texvent.event_methods import StreamMethods, time_edit, with_edit
from texvent.options.arrays import HOW_TO_ROUND, as_array, whole_numbers
from texvent.options.time_range import SeenTimes, check_time_range, warn_of_doubtful_range
from texvent.sensor import MAX_SIDE, SensorSize, SizeLike, as_size

SIGNAL, NOISE = 0, 1
"""Values of `EventStream.label`: fired by a brightness change, or by noise."""

COLUMN_TYPES: dict[str, type[np.generic]] = {
    "x": np.uint16,
    "y": np.uint16,
    "t": np.int64,
    "p": np.uint8,
    "label": np.uint8,
    "instance": np.uint16,
    "class_id": np.uint16,
}
ID_COLUMNS = ("instance", "class_id")
MAX_ID = 2**16 - 1
OPTIONAL_COLUMNS = ("label", *ID_COLUMNS)
"""Columns that only some streams have."""


@dataclass(frozen=True, eq=False, repr=False)
class EventStream(StreamMethods):
    """Events in time order: a whole recording, or one packet of it.

    Raises:
        InputError: lengths differ, a coordinate lies outside the sensor, time decreases, or a
            polarity is not 0/1.

    Example:
        >>> from texvent import EventStream
        >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
        >>> len(events), events.polarity.tolist()
        (2, [1, -1])
    """

    x: NDArray[np.uint16]
    """Column, pixels, [n] uint16."""
    y: NDArray[np.uint16]
    """Row, pixels from the top, [n] uint16."""
    t: NDArray[np.int64]
    """Time, µs, [n] int64, non-decreasing."""
    p: NDArray[np.uint8]
    """Polarity, [n] uint8: 1 = ON, 0 = OFF."""
    size: SensorSize
    """Width and height of the sensor, pixels."""
    metadata: Mapping[str, Any] = field(default_factory=dict, repr=False)
    """Origin of the events (JSON-serialisable): prompt, config, seed, version."""
    label: NDArray[np.uint8] | None = field(default=None, repr=False)
    """Origin of each event, [n] uint8: `SIGNAL` or `NOISE`; None where it is not known."""
    instance: NDArray[np.uint16] | None = field(default=None, repr=False)
    """The object that each event shows, [n] uint16, 0 = none; None where it is not known."""
    class_id: NDArray[np.uint16] | None = field(default=None, repr=False)
    """The class of that object, [n] uint16, 0 = none; None where it is not known."""

    def __post_init__(self) -> None:
        size = as_size(self.size)
        columns = {name: whole_numbers(getattr(self, name), name) for name in "xyp"}
        columns["t"] = whole_numbers(self.t, "t", f"integers, µs: {HOW_TO_ROUND}")
        _check_columns(columns, size)
        for name in OPTIONAL_COLUMNS:
            if getattr(self, name) is not None:
                values = as_array(getattr(self, name), name)
                columns[name] = _checked_optional(name, values, len(columns["t"]))
        for name in columns:
            dtype = COLUMN_TYPES[name]
            view = columns[name].astype(dtype, copy=False).view()
            view.flags.writeable = False
            object.__setattr__(self, name, view)
        object.__setattr__(self, "size", size)

    @classmethod
    def empty(cls, size: SizeLike, metadata: Mapping[str, Any] | None = None) -> EventStream:
        """A stream with no event.

        Example:
            >>> from texvent import EventStream
            >>> EventStream.empty("davis346")
            EventStream(0 events, 346x260)
        """
        return cls.from_columns([], [], [], [], size=size, metadata=metadata)

    @classmethod
    def from_columns(
        cls,
        x: ArrayLike,
        y: ArrayLike,
        t: ArrayLike,
        p: ArrayLike,
        *,
        size: SizeLike,
        metadata: Mapping[str, Any] | None = None,
        sort: bool = False,
    ) -> EventStream:
        """A stream from anything array-like, such as lists; empty columns may have any dtype.

        With `sort`, events are brought into time order; those of one time keep theirs.

        Example:
            >>> from texvent import EventStream
            >>> EventStream.from_columns([3, 4], [0, 0], [20, 10], [1, 0], size="8x6", sort=True).t
            array([10, 20])
        """
        x, y, t, p = (as_array(one, name) for one, name in zip((x, y, t, p), "xytp", strict=True))
        if sort and t.ndim == 1 == len({x.shape, y.shape, t.shape, p.shape}):
            order = np.argsort(t, kind="stable")
            x, y, t, p = x[order], y[order], t[order], p[order]
        return cls(x, y, t, p, as_size(size), metadata or {})

    @classmethod
    def concat(cls, streams: Iterable[EventStream]) -> EventStream:
        """One stream from packets in time order; metadata comes from the first.

        Raises:
            InputError: there is no packet, the sizes differ, or a packet starts before the end
                of the one before it.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> EventStream.concat([events[:1], events[1:]]) == events
            True
        """
        packets = list(streams)
        if not packets:
            raise InputError("nothing to concatenate; give at least one (possibly empty) packet")
        size = packets[0].size
        for packet in packets:
            if packet.size != size:
                raise InputError(f"cannot concatenate sensors of {size} and {packet.size}")
        whole = {
            name: np.concatenate([getattr(packet, name) for packet in packets]) for name in "xytp"
        }
        for name in OPTIONAL_COLUMNS:
            # Packets without events need not have them; where there are no others, one is enough.
            found = [getattr(packet, name) for packet in packets if len(packet)]
            found = found or [
                one for packet in packets if (one := getattr(packet, name)) is not None
            ]
            if found and all(one is not None for one in found):
                whole[name] = np.concatenate(found)
        return cls(**whole, size=size, metadata=packets[0].metadata)

    @classmethod
    def unchecked(
        cls, *columns: NDArray[Any], size: SensorSize, label: NDArray[np.uint8] | None
    ) -> EventStream:
        """A stream from columns x, y, t, p that a kernel just made in the right order and types.

        Checking costs more than a small packet. The arrays themselves become read-only.
        """
        stream = object.__new__(cls)
        x, y, t, p = columns
        for column in columns if label is None else (*columns, label):
            column.setflags(write=False)
        vars(stream).update(x=x, y=y, t=t, p=p, size=size, metadata={}, label=label)
        return stream

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        span = f", t {int(self.t[0])}..{int(self.t[-1])} µs" if len(self) else ""
        return f"EventStream({len(self):,} events, {self.size}{span})"

    def __getitem__(self, index: slice | NDArray[np.bool_]) -> EventStream:
        """The events of a slice with a positive step, or where a mask is true.

        Raises:
            InputError: it is neither, such as the number of an event, or of another length.
        """
        if not isinstance(index, slice | np.ndarray | list):
            raise InputError(
                f"events[{index!r:.40}] is no part of a stream; give a slice such as [0:1] or "
                "a mask, or take a column, such as events.t[0]"
            )
        if not isinstance(index, slice):
            index = as_array(index, "the mask")
        try:
            chosen = {name: column[index] for name, column in self.columns().items()}
        except IndexError as error:
            raise InputError(f"{shown(index)} chooses no events ({one_line(error)})") from error
        return EventStream(**chosen, size=self.size, metadata=self.metadata)

    def columns(self) -> dict[str, NDArray[Any]]:
        """Name → array: x, y, t, p, and label, instance, class_id where they are known.

        Example:
            >>> from texvent import EventStream
            >>> list(EventStream.empty("8x6").columns())
            ['x', 'y', 't', 'p']
        """
        named = {name: getattr(self, name) for name in COLUMN_TYPES}
        return {name: column for name, column in named.items() if column is not None}

    @property
    def polarity(self) -> NDArray[np.int8]:
        """Polarity as ±1 (ON = +1, OFF = −1), [n] int8."""
        return self.p.astype(np.int8) * np.int8(2) - np.int8(1)

    @property
    def time_range(self) -> tuple[int, int] | None:
        """Half-open range [first, last + 1) of the event times, µs, or None without events."""
        return (int(self.t[0]), int(self.t[-1]) + 1) if len(self) else None

    def between(self, start_us: int, stop_us: int) -> EventStream:
        """Events with `start_us <= t < stop_us`.

        Raises:
            InputError: the stop lies before the start.

        Warns:
            TexventWarning: the range is empty, outside of the recording, or looks like seconds.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.between(10, 20)
            EventStream(1 events, 8x6, t 10..10 µs)
        """
        check_time_range(start_us, stop_us)
        if len(self):
            seen = SeenTimes(int(self.t[0]), int(self.t[-1]) + 1)
            warn_of_doubtful_range(start_us, stop_us, seen)
        part = self.cut(start_us, stop_us)
        return part.with_metadata(with_edit(self.metadata, time_edit(start_us, stop_us)))

    def cut(self, start_us: int, stop_us: int) -> EventStream:
        """As `between`, for programs that go through time: any range is taken without a word.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> [len(events.cut(start_us, start_us + 10)) for start_us in (0, 10, 20, 30)]
            [0, 1, 1, 0]
        """
        first, last = np.searchsorted(self.t, (start_us, stop_us), side="left")
        return self[int(first) : int(last)]

    def __eq__(self, other: object) -> bool:
        """True for a stream of the same size and columns; metadata does not count."""
        if not isinstance(other, EventStream):
            return NotImplemented
        mine, theirs = self.columns(), other.columns()
        return (
            self.size == other.size
            and mine.keys() == theirs.keys()
            and all(np.array_equal(mine[name], theirs[name]) for name in mine)
        )

    def equals(self, other: EventStream) -> bool:
        """As `==`.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.equals(events[:1])
            False
        """
        return self == other

    def with_metadata(self, metadata: Mapping[str, Any]) -> EventStream:
        """The same events with other metadata.

        Example:
            >>> from texvent import EventStream
            >>> EventStream.empty("8x6").with_metadata({"scene": "at night"}).metadata
            {'scene': 'at night'}
        """
        changed = copy.copy(self)  # the columns were checked
        object.__setattr__(changed, "metadata", metadata)
        return changed

    def without_label(self) -> EventStream:
        """The same events without the signal/noise column.

        Example:
            >>> import texvent
            >>> events = texvent.generate(
            ...     "a red ball bounces", sensor="48x36", duration=0.2, label_noise=True
            ... )
            >>> events.label is None, events.without_label().label is None
            (False, True)
        """
        changed = copy.copy(self)  # the columns were checked
        object.__setattr__(changed, "label", None)
        return changed

    def with_ids(self, instance: NDArray[Any] | None, class_id: NDArray[Any] | None) -> EventStream:
        """The same events with other ids of their objects, [n] each; None: without.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.with_ids([1, 2], None).instance
            array([1, 2], dtype=uint16)
        """
        return replace(self, instance=instance, class_id=class_id)


def _checked_optional(name: str, values: NDArray[Any], count: int) -> NDArray[Any]:
    """A column that only some streams have.

    Raises:
        InputError: it has another length or type, or a value out of range.
    """
    if values.shape != (count,) or values.dtype.kind not in "iub":
        raise InputError(
            f"{name} must hold {count} integers; got {values.dtype} of shape {values.shape}"
        )
    highest = NOISE if name == "label" else MAX_ID
    if count and not 0 <= int(values.min()) <= int(values.max()) <= highest:
        allowed = "0 (signal) or 1 (noise)" if name == "label" else f"0..{highest}"
        raise InputError(f"{name} runs up to {int(values.max())}; it must be {allowed}")
    return values


def _check_columns(columns: Mapping[str, NDArray[Any]], size: SensorSize) -> None:
    lengths = {name: column.shape for name, column in columns.items()}
    if any(column.ndim != 1 for column in columns.values()) or len(set(lengths.values())) != 1:
        raise InputError(f"x, y, t, p must be one-dimensional and equally long; got {lengths}")
    if columns["t"].size == 0:
        return
    for name, side in (("x", size.width), ("y", size.height)):
        low, high = int(columns[name].min()), int(columns[name].max())
        if low < 0 or high >= side:
            raise InputError(
                f"{name} runs from {low} to {high}; a {size} sensor allows 0..{side - 1} "
                f"(largest possible: {MAX_SIDE - 1})"
            )
    low, high = int(columns["p"].min()), int(columns["p"].max())
    if low < 0 or high > 1:
        raise InputError(
            f"p runs from {low} to {high}; it must be 0 (OFF) or 1 (ON). "
            + (
                "Of -1 and +1, or 0 and 255, make them by p > 0"
                if low == -1 or (low == 0 and np.isin(columns["p"], (low, high)).all())
                else "Is p given in the place of another column? The order is x, y, t, p"
            )
        )
    backwards = np.flatnonzero(columns["t"][1:] < columns["t"][:-1])
    if backwards.size:
        raise InputError(
            f"time decreases after event {int(backwards[0])} "
            f"({int(columns['t'][backwards[0]])} → {int(columns['t'][backwards[0] + 1])} µs); "
            "events must be in time order"
        )
