"""Is a recording sound? Duplicates, hot pixels, clumped times, one-sided polarity, in one pass.

Order, coordinates and polarity are checked by the readers already: a file that breaks them is
refused while it is read.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.transform.filters.noise_filters import mask_hot_pixels

FEW_DUPLICATES, MAX_DUPLICATES = 1e-3, 0.25
"""Shares of events that repeat another one exactly: above the first it is said (old cameras repeat
some), above the second a recording is suspicious, such as one that was merged with itself."""
MAX_HOT_SHARE = 0.1
"""Share of the events from hot pixels above which a recording is suspicious: most cameras have a
few such pixels."""
HOT_EVENTS, HOT_FACTOR = 100, 20.0
"""Stricter than the filter `hot-pixels` (`noise_filters.py: LEAST_EVENTS`, `FACTOR`): what is said
here casts doubt on a recording, while the filter only loses a pixel."""
CLUMP_EVENTS = 10
"""Events of one µs, beyond one per 1000 pixels, above which they are clumped."""
MAX_CLUMPED = 0.5
"""Share of clumped events above which a recording is suspicious."""
LEAST_EVENTS = 1000
"""Shares of fewer events say nothing."""
ONE_SIDED = 0.02
"""Share of ON or OFF events below which a recording is suspicious."""


@dataclass(frozen=True)
class Soundness:
    """Findings of the check."""

    events: int
    duplicates: int
    """Events that repeat another one exactly (x, y, t, p)."""
    contradictions: int
    """Events of a pixel that fired ON and OFF in the same µs."""
    hot_pixels: tuple[tuple[int, int, int], ...]
    """(x, y, events), the busiest first."""
    clumped_share: float
    """Share of events in crowded µs; NaN without events."""
    on_share: float
    """Share of ON events; NaN without events."""

    def complaints(self) -> list[str]:
        """Suspicious findings, one sentence each; empty if there are none."""
        found = []
        if self.duplicates > MAX_DUPLICATES * self.events:
            found.append(self._repeats())
        if self._hot_events() > MAX_HOT_SHARE * self.events:
            found.append(self._hot())
        if self.events < LEAST_EVENTS:
            return found
        if self.clumped_share > MAX_CLUMPED:
            found.append(
                f"{self.clumped_share:.0%} of the events share few, crowded timestamps: "
                "times look like those of frames"
            )
        if not ONE_SIDED <= self.on_share <= 1 - ONE_SIDED:
            found.append(f"{self.on_share:.1%} of the events are ON: one polarity is missing")
        return found

    def notes(self) -> list[str]:
        """Findings that many sound recordings have, one sentence each."""
        found = []
        if FEW_DUPLICATES * self.events < self.duplicates <= MAX_DUPLICATES * self.events:
            found.append(self._repeats())
        if 0 < self._hot_events() <= MAX_HOT_SHARE * self.events:
            found.append(self._hot())
        return found

    def _repeats(self) -> str:
        return f"{self.duplicates:,} events repeat another one exactly"

    def _hot_events(self) -> int:
        return sum(count for _, _, count in self.hot_pixels)

    def _hot(self) -> str:
        x, y, count = self.hot_pixels[0]
        return (
            f"{len(self.hot_pixels):,} hot pixels with {self._hot_events() / self.events:.1%} of "
            f"the events; the busiest, ({x}, {y}), fired {count:,} times"
        )


@dataclass
class SoundnessCheck:
    """Takes packets one after the other, and reports at the end; memory does not grow.

    Example:
        >>> check = SoundnessCheck(SensorSize(4, 4))
        >>> check.update(EventStream.from_columns([1, 1], [2, 2], [5, 5], [1, 1],
        ...                                       size=SensorSize(4, 4)))
        >>> check.report().duplicates
        1
    """

    size: SensorSize
    _counts: NDArray[np.int64] = field(init=False)
    _held: EventStream | None = field(init=False, default=None)
    _events: int = field(init=False, default=0)
    _on: int = field(init=False, default=0)
    _duplicates: int = field(init=False, default=0)
    _contradictions: int = field(init=False, default=0)
    _clumped: int = field(init=False, default=0)

    def __post_init__(self) -> None:
        self._counts = np.zeros(self.size.shape, dtype=np.int64)

    def update(self, packet: EventStream) -> None:
        """Count the events of the next packet."""
        if len(packet) == 0:
            return
        self._events += len(packet)
        self._on += int(packet.p.sum())
        places = packet.y.astype(np.int64) * self.size.width + packet.x
        flat = self._counts.reshape(-1)
        flat += np.bincount(places, minlength=flat.size)
        # The last µs may go on in the next packet.
        whole = packet if self._held is None else EventStream.concat([self._held, packet])
        cut = int(np.searchsorted(whole.t, whole.t[-1], side="left"))
        self._count_groups(whole[:cut])
        self._held = whole[cut:]

    def report(self) -> Soundness:
        """Findings in the packets so far."""
        held, self._held = self._held, None
        if held is not None:
            self._count_groups(held)
        share = 1 / self._events if self._events else float("nan")
        return Soundness(
            self._events,
            self._duplicates,
            self._contradictions,
            list_hot_pixels(self._counts),
            self._clumped * share,
            self._on * share,
        )

    def _count_groups(self, events: EventStream) -> None:
        """Look into each µs, all events of which are here."""
        if len(events) == 0:
            return
        is_new = np.concatenate([[False], events.t[1:] != events.t[:-1]])
        group = np.cumsum(is_new)
        sizes = np.bincount(group)
        crowd = CLUMP_EVENTS + self.size.width * self.size.height / 1000
        self._clumped += int(sizes[sizes > crowd].sum())
        pixel = events.y.astype(np.int64) * self.size.width + events.x
        area = self.size.width * self.size.height
        keys = np.sort((group * area + pixel) * 2 + events.p)
        is_same = keys[1:] == keys[:-1]
        self._duplicates += int(is_same.sum())
        is_same_pixel = keys[1:] >> 1 == keys[:-1] >> 1
        self._contradictions += int((is_same_pixel & ~is_same).sum())


def list_hot_pixels(counts: NDArray[np.int64]) -> tuple[tuple[int, int, int], ...]:
    """Pixels that fire far more than their neighbours, as (x, y, events), the busiest first.

    Args:
        counts: events per pixel, [height, width].
    """
    y, x = np.nonzero(mask_hot_pixels(counts, factor=HOT_FACTOR, least_events=HOT_EVENTS))
    own = counts[y, x]
    order = np.argsort(-own, kind="stable")
    found = zip(x[order], y[order], own[order], strict=True)
    return tuple((int(column), int(row), int(count)) for column, row, count in found)
