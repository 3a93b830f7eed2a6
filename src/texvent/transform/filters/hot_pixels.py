"""Hot pixels: those that fire far more often than the pixels around them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.transform.filters.protocol import Keep
from texvent.transform.packets import packets_of

LEAST_EVENTS = 40
"""Pixels with fewer events are never hot."""
FACTOR = 5.0
"""Hot pixels fire this many times as often as the second busiest of their eight neighbours: where
an edge passes, two neighbours at least are as busy."""
AROUND = tuple((dy, dx) for dy in (0, 1, 2) for dx in (0, 1, 2) if (dy, dx) != (1, 1))


@dataclass(frozen=True, kw_only=True)
class HotPixelFilter:
    """Drops the events of hot pixels, which it finds by reading the recording once before.

    Raises:
        ConfigError: a value out of range.
    """

    factor: float = FACTOR
    """A hot pixel fires so many times as often as the second busiest of its eight neighbours."""
    least_events: int = LEAST_EVENTS
    """Pixels with fewer events are never hot."""

    def __post_init__(self) -> None:
        check_range("factor", self.factor, 1.0)
        check_range("least_events", self.least_events, 1)

    def start(self, events: EventStream | EventPackets) -> Keep:
        """See `EventFilter`."""
        hot = find_hot_pixels(events, factor=self.factor, least_events=self.least_events)
        return lambda packet: ~hot[packet.y, packet.x]


def find_hot_pixels(
    events: EventStream | EventPackets,
    *,
    factor: float = FACTOR,
    least_events: int = LEAST_EVENTS,
) -> NDArray[np.bool_]:
    """Which pixels of a recording are hot, [H, W] bool; packets are read once, with flat memory."""
    counts = np.zeros(events.size.width * events.size.height, np.int64)
    for packet in packets_of(events):
        pixel = packet.y.astype(np.int64) * events.size.width + packet.x
        counts += np.bincount(pixel, minlength=counts.size)
    return mask_hot_pixels(
        counts.reshape(events.size.shape), factor=factor, least_events=least_events
    )


def mask_hot_pixels(
    counts: NDArray[np.int64], *, factor: float = FACTOR, least_events: int = LEAST_EVENTS
) -> NDArray[np.bool_]:
    """Which pixels are hot, [H, W] bool.

    A pixel is compared with its neighbours, not with the sensor: a busy scene is busy in
    neighbouring pixels too, and the statistics of a sensor depend on the scene.

    Args:
        counts: events per pixel, [H, W].
        factor: see `FACTOR`.
        least_events: see `LEAST_EVENTS`.
    """
    hot = np.zeros(counts.shape, np.bool_)
    y, x = np.nonzero(counts >= least_events)
    if not len(y) or counts.size == 1:
        return hot
    # A mirrored hot pixel would count twice and hide the one at the edge, so the second time those
    # that were found are left out beyond the edge.
    for _ in range(2):
        padded = _mirrored(np.where(hot, 0, counts))
        padded[1:-1, 1:-1] = counts
        neighbours = np.stack([padded[y + dy, x + dx] for dy, dx in AROUND])
        second_busiest = np.sort(neighbours, axis=0)[-2]
        hot[y, x] = counts[y, x] > factor * np.maximum(second_busiest, 1)
    return hot


def _mirrored(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Counts with one more pixel on each side, [H + 2, W + 2].

    They are mirrored, so that a line which ends at the sensor's edge has two busy neighbours there
    too. Across a single row or column there is nothing to mirror, and they are 0.
    """
    for axis, length in enumerate(counts.shape):
        width = [(1, 1) if one == axis else (0, 0) for one in range(2)]
        counts = np.pad(counts, width, mode="reflect" if length > 1 else "constant")
    return counts
