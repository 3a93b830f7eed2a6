"""Dry run: the first pairs of frames simulated, and what the whole run would take."""

from __future__ import annotations

import time
from dataclasses import dataclass

from texvent.pipeline import Simulation
from texvent.run.prepare import estimate_bytes

MOST_PAIRS = 4
"""Pairs of frames that are tried; the first one compiles kernels and is not timed."""
MOST_SECONDS = 10.0
"""No further pair is begun after this time."""


@dataclass(frozen=True)
class DryRun:
    """Measurements of the first pairs of a run."""

    pairs: int
    """Pairs that were simulated."""
    events: int
    """Events that they fired."""
    seconds: float
    """Time per pair, s, without compilation where more than one pair was simulated."""
    pairs_in_all: int | None
    """Pairs of the whole video; None where its length is not known."""
    memory_bytes: int
    """Estimated memory of the run; it does not grow with the clip."""

    def describe(self) -> str:
        """The estimate in two lines."""
        memory = f"memory about {size_text(self.memory_bytes)}, however long the clip is"
        if not self.pairs:
            return f"no events: there is one frame only, so nothing could change\n{memory}"
        each = self.events / self.pairs
        tried = f"{self.pairs} of {self.pairs_in_all or 'unknown'} pairs of frames tried"
        if self.pairs_in_all is None:
            return f"about {each:,.0f} events per pair ({tried})\n{memory}"
        count = self.pairs_in_all
        return (
            f"about {each * count:,.0f} events in {self.seconds * count:,.1f} s ({tried})\n{memory}"
        )


def measure_start(simulation: Simulation) -> DryRun:
    """Simulate the first pairs of a run; nothing is written.

    Raises:
        InputError: the frames cannot be used.
    """
    total = simulation.video.frame_count
    began = timed = time.perf_counter()
    pairs = events = 0
    is_first = True
    for frame, packet in simulation.steps():
        events += len(packet)
        if is_first:
            is_first = False
            continue
        if not frame.is_source:
            continue
        pairs += 1
        if pairs == 1:
            first_s, timed = time.perf_counter() - began, time.perf_counter()
        if pairs >= MOST_PAIRS or time.perf_counter() - began > MOST_SECONDS:
            break
    later_s = (time.perf_counter() - timed) / max(pairs - 1, 1)
    return DryRun(
        pairs=pairs,
        events=events,
        seconds=0.0 if not pairs else first_s if pairs == 1 else later_s,
        pairs_in_all=None if total is None else max(total - 1, 0),
        memory_bytes=estimate_bytes(simulation.settings, simulation.video.size),
    )


def size_text(size: float) -> str:
    """Bytes for people, such as "1.2 GB"."""
    for unit, name in ((2**40, "TB"), (2**30, "GB"), (2**20, "MB")):
        if size >= unit:
            return f"{size / unit:,.1f} {name}"
    return f"{size / 2**10:,.0f} KB"
