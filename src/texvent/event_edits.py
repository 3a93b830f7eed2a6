"""Edits that a stream and packets have as methods: parts, other sizes, turned, filtered.

Each is one function of `texvent.transform`, for both kinds of recordings; a stream gives a stream,
packets give packets that are made as they are read. Each is noted under `edits` in the metadata, as
`texvent convert` does.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NoReturn, Self

if TYPE_CHECKING:
    from texvent.sensor import SizeLike
    from texvent.transform.edits import Axes
    from texvent.transform.filters.apply import EventFilter


def with_edit(metadata: Mapping[str, Any], edit: Mapping[str, Any]) -> dict[str, Any]:
    """Metadata with one more entry under `edits`: what was done to the events after their run.

    An entry has the names and values of the options of `texvent convert`.
    """
    before = metadata.get("edits")
    return {**metadata, "edits": [*(before if isinstance(before, list) else ()), dict(edit)]}


def time_edit(start_us: int, stop_us: int) -> dict[str, str]:
    """The entry of a part in time, `START,STOP` in seconds."""
    return {"time": f"{start_us / 1_000_000},{stop_us / 1_000_000}"}


class EventEdits:
    """Base of `EventStream` and `EventPackets`.

    What the methods call lies above and is imported when it is called: a convenience for users.
    """

    def __add__(self, other: object) -> NoReturn:
        """Refused, as it could mean two things; the message names both."""
        raise TypeError(
            "events are not added: EventStream.concat([first, second]) joins streams that follow "
            "each other, texvent.transform.edits.merge EventPackets of the same time"
        )

    __radd__ = __add__  # sum([first, second])

    def _edited(self, edit: Callable[..., Any], *values: Any, **options: Any) -> Self:
        edited: Self = edit(self, *values, **options)
        return edited

    def crop(self, x: int, y: int, width: int, height: int) -> Self:
        """The events of a region, whose top left pixel (x, y) becomes (0, 0).

        Raises:
            ConfigError: a number is not whole.
            InputError: the region is empty or reaches over the sensor's edge.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.crop(4, 0, 2, 2), events.crop(4, 0, 2, 2).x
            (EventStream(1 events, 2x2, t 20..20 µs), array([0], dtype=uint16))
        """
        from texvent.transform.edits import Region, crop

        return self._edited(crop, Region(x, y, width, height))

    def resize(self, size: SizeLike) -> Self:
        """All events on a sensor of another size; see `transform.edits.resize`.

        Raises:
            ConfigError: the size is impossible.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.resize("4x3").x
            array([1, 2], dtype=uint16)
        """
        from texvent.transform.edits import resize

        return self._edited(resize, size)

    def flip(self, axes: Axes) -> Self:
        """Mirrored: "x" exchanges left and right, "y" top and bottom, "xy" both.

        Raises:
            ConfigError: other axes.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.flip("x").x, events.flip("xy").y
            (array([4, 3], dtype=uint16), array([5, 5], dtype=uint16))
        """
        from texvent.transform.edits import flip

        return self._edited(flip, axes)

    def rotate(self, degrees: int) -> Self:
        """Turned clockwise by 0, 90, 180 or 270 degrees; quarter turns exchange width and height.

        Raises:
            ConfigError: another angle.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.rotate(90), events.rotate(90).y
            (EventStream(2 events, 6x8, t 10..20 µs), array([3, 4], dtype=uint16))
        """
        from texvent.transform.edits import rotate

        return self._edited(rotate, degrees)

    def filter(self, which: str | EventFilter, **options: Any) -> Self:
        """The events that a filter keeps.

        Args:
            which: its name, such as "background-activity", "refractory", "hot-pixels" or "mask".
            **options: of that filter, such as `window_us=5000`.

        Raises:
            ConfigError: unknown name or option, or a value out of range.
            InputError: the filter does not fit the sensor.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 3], [0, 0], [10, 20], [1, 1], size="8x6")
            >>> events.filter("refractory", period_us=50).t
            array([10])
        """
        from texvent.transform.filters.apply import filter_events

        return self._edited(filter_events, which, **options)
