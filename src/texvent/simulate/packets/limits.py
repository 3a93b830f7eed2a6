"""How many events a packet may hold: all of it is in memory at once."""

from __future__ import annotations

from texvent.errors import InputError
from texvent.runtime.memory import usable_bytes

BYTES_PER_EVENT = 100
"""What an event takes while its packet is made: columns as drawn, keys, sorted columns."""


def check_event_number(number: float) -> None:
    """Refuse a packet that memory cannot hold, before there is any of it.

    Args:
        number: events between two frames, counted or expected.

    Raises:
        InputError: it is above what `usable_bytes` holds.
    """
    most = usable_bytes() // BYTES_PER_EVENT
    if not number <= most:
        raise InputError(
            f"about {number:.2g} events come between two frames, and memory holds {most:.2g}; give "
            "frames closer together in time, lower the rates of noise and leak, or raise the "
            "contrast threshold"
        )
