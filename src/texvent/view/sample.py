"""Fair samples, rates and frames of a recording, with flat memory."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.frames import Frame
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import jpeg_bytes, shrink
from texvent.view.drawing.event_image import frame_image


def rate_counts(events: EventStream, extent: tuple[int, int], bins: int) -> NDArray[np.int64]:
    """OFF and ON events in equal bins of a range of time, [2, bins].

    Event times are ordered, so that only the places of the edges are searched.

    Args:
        events: any number.
        extent: where the first bin begins and the last one ends, µs; events outside are left out.
        bins: how many, 1 or more.

    Example:
        >>> from texvent.sensor import SensorSize
        >>> events = EventStream([0, 1, 2], [0, 0, 0], [0, 5, 9], [1, 0, 1], SensorSize(3, 1))
        >>> rate_counts(events, (0, 10), 2).tolist()
        [[0, 1], [1, 1]]
    """
    start_us, stop_us = extent
    edges = start_us - np.arange(bins + 1) * (start_us - stop_us) // bins  # rounded up
    places = np.searchsorted(events.t, edges)
    is_on = events.p.view(np.bool_)
    on = [np.count_nonzero(is_on[first:last]) for first, last in pairwise(places.tolist())]
    on_counts = np.array(on, dtype=np.int64)
    return np.stack([np.diff(places) - on_counts, on_counts])


STRIP_FRAMES = 64
STRIP_WIDTH = 360
JPEG_QUALITY = 78


class FrameStrip:
    """At most `limit` frames of a video of any length: every one, else every second, fourth, ...

    Memory holds their JPEG files only.
    """

    def __init__(self, *, limit: int = STRIP_FRAMES) -> None:
        self._limit = limit
        self._stride = 1
        self.seen = 0
        """Source frames offered so far."""
        self.images: list[tuple[int, bytes]] = []
        """Time, µs, and JPEG file of the frames kept, in time order."""

    def append(self, frame: Frame) -> None:
        """Offer a frame; interpolated ones are left out."""
        if not frame.is_source:
            return
        index = self.seen
        self.seen += 1
        if index % self._stride:
            return
        if len(self.images) == self._limit:
            self.images = self.images[::2]
            self._stride *= 2
            if index % self._stride:
                return
        small = shrink(frame_image(frame), STRIP_WIDTH)
        self.images.append((frame.t_us, jpeg_bytes(small, quality=JPEG_QUALITY)))


SAMPLE_EVENTS = 200_000
RATE_BINS = 160
FIRST_BIN_US = 16


class UniformSample:
    """At most `limit` events, each equally likely, drawn in one pass.

    Every event has a priority: a hash of its position in the recording. The events
    with the lowest priorities are kept, so packet sizes do not change the sample.
    """

    def __init__(self, size: SensorSize, *, limit: int = SAMPLE_EVENTS) -> None:
        self._limit = limit
        self._kept = [EventStream.empty(size)]
        self._priorities: list[NDArray[np.uint64]] = [np.empty(0, dtype=np.uint64)]
        self._kept_count = 0
        self._bound = np.uint64(2**64 - 1)
        self.seen = 0
        """Events offered so far."""

    def append(self, packet: EventStream) -> None:
        """Offer the events of a packet."""
        count = len(packet)
        position = np.arange(self.seen, self.seen + count, dtype=np.uint64)
        self.seen += count
        priority = _mix(position + _mix(np.zeros(1, np.uint64)))
        keep = priority <= self._bound
        if not keep.any():
            return
        self._kept.append(packet[keep])
        self._priorities.append(priority[keep])
        self._kept_count += int(keep.sum())
        if self._kept_count > 2 * self._limit:
            self._shrink()

    def events(self) -> EventStream:
        """The sample, in time order."""
        self._shrink()
        return self._kept[0]

    def _shrink(self) -> None:
        events = EventStream.concat(self._kept)
        priorities = np.concatenate(self._priorities)
        if len(events) > self._limit:
            bound = np.partition(priorities, self._limit - 1)[self._limit - 1]
            keep = priorities <= bound
            events, priorities, self._bound = events[keep], priorities[keep], bound
        self._kept, self._priorities, self._kept_count = [events], [priorities], len(events)


class RateCurve:
    """ON and OFF events per time bin; bins double in width when the recording outgrows them."""

    def __init__(self) -> None:
        self._start_us: int | None = None
        self._bin_us = FIRST_BIN_US
        self._counts = np.zeros((2, RATE_BINS), dtype=np.int64)
        self._last_us = 0

    def append(self, packet: EventStream) -> None:
        """Count the events of a packet."""
        if len(packet) == 0:
            return
        if self._start_us is None:
            self._start_us = int(packet.t[0])
        self._last_us = int(packet.t[-1])
        while self._last_us - self._start_us >= self._bin_us * RATE_BINS:
            pairs = self._counts.reshape(2, RATE_BINS // 2, 2).sum(axis=2)
            self._counts = np.concatenate([pairs, np.zeros_like(pairs)], axis=1)
            self._bin_us *= 2
        bins = (packet.t - self._start_us) // self._bin_us
        flat = np.bincount(packet.p.astype(np.int64) * RATE_BINS + bins, minlength=2 * RATE_BINS)
        self._counts += flat.reshape(2, RATE_BINS)

    @property
    def bin_us(self) -> int:
        """Width of a bin, µs."""
        return self._bin_us

    @property
    def start_us(self) -> int:
        """Time of the first event, µs; 0 without events."""
        return self._start_us or 0

    @property
    def counts(self) -> NDArray[np.int64]:
        """OFF and ON events per bin, [2, bins], up to the last event."""
        if self._start_us is None:
            return np.zeros((2, 0), dtype=np.int64)
        return self._counts[:, : (self._last_us - self._start_us) // self._bin_us + 1]


def _mix(values: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """splitmix64's finaliser (Steele et al. 2014), modulo 2^64 by definition."""
    mixed = values + np.uint64(0x9E3779B97F4A7C15)
    mixed = (mixed ^ (mixed >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    mixed = (mixed ^ (mixed >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return np.asarray(mixed ^ (mixed >> np.uint64(31)))
