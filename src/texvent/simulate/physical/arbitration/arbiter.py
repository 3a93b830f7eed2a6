"""Between the pixels and the readout: events wait until their pixel is read.

A pixel holds one event; what it fires while that waits is lost. So nothing piles up.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.physical.arbitration.row_arbiter import LOST, SERVE_ROWS, WAITS, RowRules
from texvent.simulate.physical.arbitration.scan import scan_times_us

ArbiterKind: TypeAlias = Literal["none", "rows", "scan"]


class ArbiterRules(NamedTuple):
    """What reads the pixels, and how fast."""

    kind: ArbiterKind
    """None, a row arbiter or a scan."""
    rows: RowRules
    """How long a row takes."""
    scan_period_ns: int
    """From one scan to the next, ns."""


class Arbiter:
    """The arbiter of one sensor, from its first frame on."""

    def __init__(
        self, rules: ArbiterRules, *, first_us: int, shape: tuple[int, int], backend: str
    ) -> None:
        """Start with nothing waiting.

        Args:
            rules: who reads the pixels.
            first_us: time of the first frame, µs: when the first scan starts.
            shape: (height, width) of the sensor.
            backend: of the row arbiter.
        """
        self._rules = rules
        self._first_us = first_us
        self._shape = shape
        self._backend = backend
        self._waiting = UnsortedEvents.none()
        self._free_ns = first_us * 1000

    def read(self, fired: UnsortedEvents, stop_us: int) -> UnsortedEvents:
        """Events that are read before `stop_us`, with the time of that; the others wait.

        Args:
            fired: events of the interval that ends there, in any order.
            stop_us: when the interval ends, µs.
        """
        if self._rules.kind == "none":
            return fired
        fired = UnsortedEvents.concat((self._waiting, fired))
        fired = fired.take(np.lexsort((fired.label, fired.p, fired.pixel, fired.t)))
        if self._rules.kind == "rows":
            read_us, self._free_ns = SERVE_ROWS.load(self._backend)(
                fired.pixel, fired.t, self._shape, self._rules.rows, self._free_ns, stop_us
            )
        else:
            read_us = scan_times_us(
                fired.pixel, fired.t, self._shape[1], self._rules.scan_period_ns, self._first_us
            )
            read_us[read_us >= stop_us] = WAITS
        self._waiting = fired.take(read_us == WAITS)
        is_read = (read_us != WAITS) & (read_us != LOST)
        return fired._replace(t=read_us).take(is_read)
