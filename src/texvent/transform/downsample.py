"""Recordings of fewer, larger pixels.

`how="all"` moves every event to its block, so that a block has the events of all of its pixels,
factor² times as many as one. Two pixels of a block may then fire in the same µs, or closer than a
refractory period; the filter `refractory` thins them.

`how="mean"` takes a block as one pixel that sees the mean log intensity of its pixels. Each event
says that one of n pixels changed by one contrast threshold, which changes the mean by 1/n of it.
So a block fires when its events, ON less OFF since it fired last, reach n. Counting events of a
block up to a threshold is one of the methods of Gruel et al., "Event data downscaling for embedded
computer vision", VISAPP 2022; n makes blocks as sensitive as pixels, if ON and OFF thresholds are
equal.

Other sizes: `region.resize` takes any, block edges as even as they can be.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import ConfigError, shown
from texvent.events import EventStream
from texvent.sensor import MAX_SIDE, SensorSize
from texvent.transform.packets import Recording, map_in_order, map_packets, move_events, note_edit

NOTHING = -1
"""In the place of a polarity, where a block does not fire."""


def downsample(events: Recording, factor: int, *, how: Literal["all", "mean"] = "all") -> Recording:
    """The events on blocks of factor × factor pixels.

    Args:
        events: the recording.
        factor: pixels of a block along each axis; at the right and lower edge there may be fewer.
        how: "all" keeps every event; "mean" gives those of a pixel that sees the block's mean.

    Raises:
        ConfigError: factor is below 1, or another `how`.
    """
    check_range("factor", factor, 1, MAX_SIDE)
    if factor != int(factor):
        raise ConfigError(f"factor is {shown(factor)}; it must be a whole number")
    factor = int(factor)  # of 2.0, which is one
    if how not in ("all", "mean"):
        raise ConfigError(f"how is {shown(how)}; it must be 'all' or 'mean'")
    size = SensorSize(-(-events.size.width // factor), -(-events.size.height // factor))

    def place(packet: EventStream) -> EventStream:
        x, y = packet.x // np.uint16(factor), packet.y // np.uint16(factor)
        return move_events(packet, x, y, size)

    if how == "all":
        return note_edit(map_packets(events, place, size=size), events, downsample=int(factor))
    pixels = block_pixels(events.size, factor)

    def start() -> Callable[[EventStream], EventStream]:
        blocks = _Accumulator(pixels)
        return lambda packet: blocks.fire(place(packet))

    means = map_in_order(events, start, size=size)
    return note_edit(means, events, downsample=int(factor), how=how)


def block_pixels(size: SensorSize, factor: int) -> NDArray[np.int64]:
    """Pixels of each block, [rows, columns]; fewer at the right and lower edge."""
    columns = np.minimum(factor, size.width - np.arange(0, size.width, factor))
    rows = np.minimum(factor, size.height - np.arange(0, size.height, factor))
    return np.asarray(np.outer(rows, columns), np.int64)


class _Accumulator:
    """ON less OFF events of each block since it fired last."""

    def __init__(self, pixels: NDArray[np.int64]) -> None:
        self._pixels = pixels.reshape(-1)
        self._sums = np.zeros_like(self._pixels)

    def fire(self, placed: EventStream) -> EventStream:
        """The events of the blocks, each at the time of the pixel's event that completes it."""
        from texvent.transform.downsample_cpu import fire_blocks  # brings Numba

        block = placed.y.astype(np.int64) * placed.size.width + placed.x
        polarity = fire_blocks(block, placed.p, self._pixels, self._sums)
        fired = polarity != NOTHING
        columns = {name: column[fired] for name, column in placed.columns().items()}
        columns["p"] = polarity[fired]
        return EventStream(**columns, size=placed.size, metadata=placed.metadata)
