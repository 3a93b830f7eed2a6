"""Filters of recordings that a sensor has in its readout."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from texvent._registry import FILTERS, suggest
from texvent.errors import ConfigError, shown
from texvent.events import EventStream
from texvent.options.parts import make_part, read_part
from texvent.sensor import SensorSize
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.transform.filters.apply import EventFilter

READOUT_FILTERS = ("event-trail", "anti-flicker", "background-activity", "refractory", "rate-limit")
"""Names in `FILTERS` of those that need no look ahead and whose options are numbers and words."""


def check_readout_filters(texts: Sequence[str]) -> None:
    """Refuse filters that no readout has, and wrong options.

    Raises:
        ConfigError: what is wrong and what is allowed.
    """
    for text in texts:
        _make_filter(text)


class ReadoutFilters:
    """Filters in a row; each remembers the events before."""

    def __init__(self, texts: Sequence[str], size: SensorSize, *, first_us: int) -> None:
        """Begin with a sensor that has given no event.

        Args:
            texts: a filter's name, or `name:option=value,...`.
            size: of the sensor.
            first_us: time of the first frame, µs: where windows of time start.

        Raises:
            ConfigError: see `check_readout_filters`.
        """
        nothing = EventStream.empty(size)
        self._size, self._first_us = size, first_us
        self._keeps: list[Callable[[EventStream], NDArray[np.bool_]]] = [
            _make_filter(text).start(nothing) for text in texts
        ]

    def read(self, fired: UnsortedEvents) -> UnsortedEvents:
        """The events that pass, of events in the order of their times."""
        for keep in self._keeps:
            y, x = np.divmod(fired.pixel, self._size.width)
            columns = x.astype(np.uint16), y.astype(np.uint16), fired.t - self._first_us, fired.p
            packet = EventStream.unchecked(*columns, size=self._size, label=fired.label)
            fired = fired.take(keep(packet))
        return fired


def _make_filter(text: str) -> EventFilter:
    name, _ = read_part(text)
    if name not in READOUT_FILTERS:
        raise ConfigError(
            f"readout_filters: {shown(name)} is no filter of a readout; "
            f"{suggest(name, READOUT_FILTERS)}"
        )
    chosen: EventFilter = make_part(FILTERS, text)
    return chosen
