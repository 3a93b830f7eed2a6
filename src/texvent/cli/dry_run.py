"""Dry run: the first pairs of frames simulated, and what the whole run would take."""

from __future__ import annotations

import time

from texvent.capture.frame_source import known_times_us
from texvent.capture.given_times import check_increasing
from texvent.pairs.time_jump import check_times
from texvent.pipeline import Simulation
from texvent.run.prepare import estimate_bytes

MOST_PAIRS = 4
"""Pairs of frames that are tried; the first one compiles kernels and is not timed."""
MOST_SECONDS = 10.0
"""No further pair is begun after this time."""


def estimate_run(simulation: Simulation) -> str:
    """Events, time and memory of a run in two lines, from its first pairs; nothing is written.

    Raises:
        InputError: the frames cannot be used.

    Warns:
        TexventWarning: of jumps in time, wherever they are.
    """
    times_us = known_times_us(simulation.video) or ()
    check_increasing(times_us, "the video", "; give a frame rate that replaces them (`fps`)")
    check_times(times_us)
    total = simulation.video.frame_count
    size = size_text(estimate_bytes(simulation.settings, simulation.video.size))
    memory = f"memory about {size}, however long the clip is"
    ends_s = [time.perf_counter()]
    events = 0
    for number, (frame, packet) in enumerate(simulation.steps()):
        events += len(packet)
        if number and frame.is_source:
            ends_s.append(time.perf_counter())
            if len(ends_s) > MOST_PAIRS or ends_s[-1] - ends_s[0] > MOST_SECONDS:
                break
    pairs = len(ends_s) - 1
    if not pairs:
        return f"no events: there is one frame only, so nothing could change\n{memory}"
    tried = f"{pairs} of {'unknown' if total is None else total - 1} pairs of frames tried"
    if total is None:
        return f"about {events / pairs:,.0f} events per pair ({tried})\n{memory}"
    timed_s = ends_s if pairs == 1 else ends_s[1:]
    seconds = (timed_s[-1] - timed_s[0]) / (len(timed_s) - 1) * (total - 1)
    whole = f"about {events / pairs * (total - 1):,.0f} events in {seconds:,.1f} s"
    return f"{whole} ({tried})\n{memory}"


def size_text(size: float) -> str:
    """Bytes for people, such as "1.2 GB"."""
    for unit, name in ((2**40, "TB"), (2**30, "GB"), (2**20, "MB")):
        if size >= unit:
            return f"{size / unit:,.1f} {name}"
    return f"{size / 2**10:,.0f} KB"
