"""`--dry-run`: try a few frames, then say what the whole run would take."""

from __future__ import annotations

import resource
import sys
import time
from dataclasses import dataclass

from texvent.pipeline import Simulation

TRIAL_SECONDS = 3.0
"""Stop trying after this long; the first pair (which compiles kernels) is not timed."""
BYTES_PER_EVENT = 3.1
"""Of the universal HDF5 layout with its default compression, measured on simulated clips."""


@dataclass(frozen=True)
class Estimate:
    """What a run would take, extrapolated from its first pairs of frames."""

    pairs_tried: int
    pairs_total: int | None
    """None where the source does not say how long it is."""
    events_per_pair: float
    seconds_per_pair: float
    peak_bytes: int
    """Highest resident memory of this process while trying; it does not grow with the clip."""


def estimate_run(simulation: Simulation) -> Estimate:
    """Run the first pairs for a few seconds and measure.

    Raises:
        InputError: the frames cannot be used.
    """
    events = pairs = 0
    started = time.perf_counter()
    for frame, packet in simulation.steps():
        if frame.is_source:
            pairs += 1
            if pairs == 2:  # the first pair is done: everything is compiled now
                started, events = time.perf_counter(), 0
        events += len(packet) if pairs != 2 or not frame.is_source else 0
        if frame.is_source and pairs > 2 and time.perf_counter() - started > TRIAL_SECONDS:
            break
    timed = max(pairs - 2, 1)
    count = simulation.video.frame_count
    # Linux reports ru_maxrss in KiB, macOS in bytes.
    unit = 1 if sys.platform == "darwin" else 1024
    return Estimate(
        pairs_tried=max(pairs - 1, 0),
        pairs_total=count - 1 if count is not None else None,
        events_per_pair=events / timed,
        seconds_per_pair=(time.perf_counter() - started) / timed,
        peak_bytes=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit,
    )


def describe_estimate(estimate: Estimate) -> str:
    """The estimate in a few lines."""
    per_pair = (
        f"{estimate.events_per_pair:,.0f} events and {estimate.seconds_per_pair:.3f} s per pair "
        f"of frames ({estimate.pairs_tried} tried)"
    )
    memory = f"memory {estimate.peak_bytes / 2**20:,.0f} MB, however long the clip is"
    if estimate.pairs_total is None:
        return f"about {per_pair}; length unknown\n{memory}"
    events = estimate.events_per_pair * estimate.pairs_total
    elapsed = estimate.seconds_per_pair * estimate.pairs_total
    return (
        f"about {events:,.0f} events, computed in {elapsed:,.0f} s (elapsed), "
        f"{events * BYTES_PER_EVENT / 2**20:,.1f} MB of events ({estimate.pairs_total} pairs)\n"
        f"{per_pair}\n{memory}"
    )
