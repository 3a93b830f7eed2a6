"""Interface of event filters, and filtering of recordings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._registry import FILTERS
from texvent.errors import ConfigError, InputError, shown
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.options.values import make_part
from texvent.transform.packets import Recording, map_in_order, note_edit

NEVER = -(2**62)
"""Stands for the time of a pixel that has not fired, µs; no event is that early."""
UInt16Array = NDArray[np.uint16]
Int64Array = NDArray[np.int64]


Keep: TypeAlias = Callable[[EventStream], NDArray[np.bool_]]
"""Says which events of the next packet stay, [n] bool; it remembers the packets before."""


class EventFilter(Protocol):
    """A frozen dataclass; its fields are its options."""

    def start(self, events: EventStream | EventPackets) -> Keep:
        """Begin a pass over a recording, from its first packet.

        Raises:
            InputError: the filter does not fit the recording.
        """
        ...


def filter_events(events: Recording, which: str | EventFilter, **options: Any) -> Recording:
    """The events that a filter keeps.

    Args:
        events: the recording.
        which: a name such as "background-activity", one with options as in
            "background-activity:window_us=5000", or a filter.
        **options: of the filter called by name.

    Raises:
        ConfigError: unknown name or option, or a value out of range.
        InputError: the filter does not fit the recording.

    Example:
        >>> events = EventStream.from_columns([3, 4, 9], [1, 1, 5], [0, 20, 30], [1, 1, 1],
        ...                                   size=(16, 8))
        >>> filter_events(events, "background-activity", window_us=100).x.tolist()
        [4]
    """
    if isinstance(which, str):
        chosen: EventFilter = make_part(FILTERS, which, options)
    elif options:
        raise ConfigError("options belong to a filter called by its name; give them to the filter")
    elif isinstance(which, type) or not callable(getattr(which, "start", None)):
        raise ConfigError(
            f"{shown(which)} is no filter; give a name ({', '.join(FILTERS.names())}) or an object "
            "with start(events)"
        )
    else:
        chosen = which
    chosen_from = events

    def start() -> Callable[[EventStream], EventStream]:
        keep = chosen.start(chosen_from)
        return lambda packet: packet[_checked(keep(packet), packet, which)]

    return note_edit(map_in_order(events, start), events, filter=[_words(which, options)])


def _checked(mask: Any, packet: EventStream, which: str | EventFilter) -> NDArray[np.bool_]:
    """Result of a filter, if it is a mask.

    Raises:
        InputError: see above, with the filter's name.
    """
    kept = np.asarray(mask)
    if kept.dtype != np.bool_ or kept.shape != (len(packet),):
        name = which if isinstance(which, str) else type(which).__name__
        raise InputError(
            f"the filter {name} gave {kept.dtype} of shape {kept.shape}; it must give a mask, "
            f"bool of shape ({len(packet)},), true where an event stays"
        )
    return kept


def _words(which: str | EventFilter, options: Mapping[str, Any]) -> str:
    """A filter as `texvent convert --filter` has it; of arrays only the name."""
    if not isinstance(which, str):
        which, options = type(which).__name__, {**getattr(which, "__dict__", {})}
    words = [
        f"{name}={value}" if isinstance(value, str | int | float) else name
        for name, value in options.items()
    ]
    if not words:
        return which
    return f"{which}{',' if ':' in which else ':'}{','.join(words)}"
