"""What a kernel takes that turns fired pixels and noise into a packet: times, order, columns."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

from texvent.simulate.backend.select import Kernel
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.texvent.kernels.noise_blocks import NoisePlaces
from texvent.simulate.texvent.kernels.scan import Fired
from texvent.simulate.texvent.timestamps import TimestampRule


class Timing(NamedTuple):
    """How events get their times (Eq. 7), and how many a pixel fires."""

    timestamp_rule: TimestampRule
    scale: float
    """γ of Eq. 7."""
    threshold: float
    """δ, log units."""
    multi_event: bool
    """Whether a pixel fires floor(Δ / δ) times."""
    noise_at_rest: bool
    """Whether noise is dropped where the pixel fired (Eq. 6)."""


TimestampEvents: TypeAlias = Callable[
    [Sequence[Fired], NoisePlaces, Timing, FrameInterval, tuple[int, int]], SortedEvents
]
"""`timestamp_events(bands, noise, timing, span, (height, width))`, see `timestamping_numpy`."""
TIMESTAMP_EVENTS = Kernel[TimestampEvents](__name__, "timestamp_events")
