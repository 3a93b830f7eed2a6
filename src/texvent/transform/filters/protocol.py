"""What a filter of events offers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.event_packets import EventPackets
from texvent.events import EventStream

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
