"""`--dry-run`: a few pairs of frames into a scratch folder; what the whole run would take."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from texvent.cli.trial_pairs import (
    MOST_PAIRS,
    MOST_SECONDS,
    Clock,
    Pair,
    Scratch,
    Trial,
    read_pairs,
)
from texvent.pipeline import Simulation
from texvent.run.files import RunFiles
from texvent.runtime.memory import peak_bytes
from texvent.runtime.threads import count_threads
from texvent.simulate.build import build_simulator
from texvent.video import MovingStream
from texvent.view.page.sample import SAMPLE_EVENTS

BLOCKS_BYTES = 48 * 2**20
"""What a long run holds beyond a pair: full blocks and queues of the writers."""


class Range(NamedTuple):
    """Lower bound, mean and upper bound of an estimate."""

    least: float
    mean: float
    most: float

    @classmethod
    def of(cls, values: Sequence[float], *, times: float) -> Range:
        """The range of some values, scaled."""
        found = min(values), sum(values) / len(values), max(values)
        return cls(*(times * one for one in found))


@dataclass(frozen=True)
class Estimate:
    """What a run would take, as pairs of it say."""

    trials: Sequence[Trial]
    """Of single pairs, at least one unless the video has none."""
    pairs_total: int | None
    """None where the source does not say how long it is."""
    seconds_fixed: float
    """What a run takes in any case; what compiled now need not compile again."""
    sizes_fixed: Mapping[str, int]
    """Extension → bytes of a file with hardly an event."""
    peak_bytes: int | None
    """Highest resident memory, which does not grow with the clip; None where the system does not
    tell it."""
    net_events: float = 0.0
    """Events per pair that the change between the pairs tried makes at least; a single pair of slow
    motion may fire none."""

    def events(self, pairs: int) -> Range:
        """Events of a clip of that many pairs of frames, were all like those tried."""
        found = Range.of([one.events for one in self.trials], times=pairs)
        return Range(*(max(one, pairs * self.net_events) for one in found))

    @property
    def is_slow(self) -> bool:
        """Whether most events need several pairs to add up."""
        return self.net_events > 2 * Range.of([one.events for one in self.trials], times=1).mean

    def seconds(self, pairs: int) -> Range:
        """Time, s: between stages that share all cores and stages one after the other."""
        serial = Range.of([one.seconds for one in self._timed], times=pairs)
        shared = [min(one.cpu_seconds / count_threads(), one.seconds) for one in self._timed]
        least, mean, most = serial._replace(least=pairs * min(shared))
        fixed = self.seconds_fixed
        return Range(fixed + least, fixed + mean, fixed + most)

    @property
    def _timed(self) -> Sequence[Trial]:
        """The trials whose times count: the first one meets caches that are cold."""
        return self.trials[1:] or self.trials

    def sizes(self, pairs: int) -> dict[str, float]:
        """Bytes by extension, none where no pair was done or its files would hold hardly an event.

        An image does not grow, and a page holds a sample of the events.
        """
        if self.is_slow or not any(one.sizes for one in self.trials):
            return {}
        mean = max(self.events(1).mean, 1e-9)
        grown = {".png": 1.0, ".html": min(pairs, SAMPLE_EVENTS / mean)}
        sizes: dict[str, float] = {}
        for kind, fixed in self.sizes_fixed.items():
            tried = [one.sizes[kind] - fixed for one in self.trials if kind in one.sizes]
            growth = max(sum(tried), 0) / max(len(tried), 1)
            sizes[kind] = fixed + growth * grown.get(kind, pairs)
        return sizes


def estimate_run(simulation: Simulation, files: RunFiles) -> Estimate:
    """Run a few pairs of frames with all their files and measure.

    It takes `MOST_SECONDS` at most, and longer only where kernels compile or one frame is drawn.

    Raises:
        InputError: the frames cannot be used.
    """
    from texvent.runtime.jit import timed_compilation  # brings Numba

    video = simulation.video
    if simulation.settings.interpolate.interpolate == "motion" and isinstance(video, MovingStream):
        video = video.with_motion()
        simulation = replace(simulation, video=video)
    total = None if video.frame_count is None else max(video.frame_count - 1, 0)
    trials: list[Trial] = []
    fixed_s = 0.0
    with (
        tempfile.TemporaryDirectory(prefix="texvent-estimate-") as folder,
        timed_compilation() as compiled,
    ):
        clock = Clock(compiled)
        scratch = Scratch(simulation, files, Path(folder), compiled, clock)
        net = NetChange(simulation)
        for pair in read_pairs(video, total, compiled, clock):
            net.see(pair)
            trials.append(scratch.later(pair) if trials else scratch.first(pair))
            if len(trials) == 1:
                fixed_s = max(_process_seconds() - compiled() - trials[0].seconds, 0.0)
    peak = peak_bytes()
    return Estimate(
        trials=trials,
        pairs_total=total,
        seconds_fixed=fixed_s,
        sizes_fixed=scratch.sizes_fixed,
        peak_bytes=None if peak is None else peak + BLOCKS_BYTES,
        net_events=net.events_per_pair,
    )


class NetChange:
    """Events that the change of brightness between the pairs tried makes at least.

    Every crossing of a threshold counts, however slowly it came about; change that goes back counts
    nothing, and nor does any of a model that forgets between pairs.
    """

    def __init__(self, simulation: Simulation) -> None:
        """Take threshold and balance of the run's model."""
        model = build_simulator(simulation.settings.run, simulation.settings.simulate)
        self._forgets = getattr(model, "slow_change", None) is not None
        self._threshold, self._balance = model.contrast_threshold, model.balance
        self._last: tuple[int, Any] | None = None
        self._events, self._span_us, self._interval_us = 0.0, 0, 0

    def see(self, pair: Pair) -> None:
        """Compare with the pair before."""
        now = np.log(np.maximum(pair.first.luma + self._balance, 1e-3))
        if self._last is not None:
            t_us, before = self._last
            self._events += float(np.floor(np.abs(now - before) / self._threshold).sum())
            self._span_us += pair.first.t_us - t_us
        self._last = pair.first.t_us, now
        self._interval_us = pair.second.t_us - pair.first.t_us

    @property
    def events_per_pair(self) -> float:
        """At the rate between the pairs seen."""
        if self._forgets or self._span_us <= 0:
            return 0.0
        return self._events * self._interval_us / self._span_us


def _process_seconds() -> float:
    """Time since this process began, s: with imports and compilation, as every run has them."""
    try:
        fields = Path("/proc/self/stat").read_text(encoding="ascii").rpartition(")")[2].split()
        started_s = int(fields[19]) / os.sysconf("SC_CLK_TCK")
        return time.clock_gettime(time.CLOCK_BOOTTIME) - started_s
    except (OSError, ValueError, AttributeError):
        return time.process_time()


def describe_estimate(estimate: Estimate) -> str:
    """The estimate in a few lines."""
    tried, pairs = len(estimate.trials), estimate.pairs_total
    peak = estimate.peak_bytes
    size = "not told by this system" if peak is None else f"{peak / 2**20:,.0f} MB"
    memory = f"memory {size}, however long the clip is"
    if not estimate.trials:
        return f"no events: there is one frame only, so nothing could change\n{memory}"
    each = f"{_shown(estimate.events(1))} events"
    if pairs is None:
        return f"about {each} per pair of frames ({tried} tried); length unknown\n{memory}"
    sizes = estimate.sizes(pairs)
    files = ", ".join(f"{size_text(size)} {kind}" for kind, size in sizes.items())
    files = f"{size_text(sum(sizes.values()))}: {files}" if sizes else "sizes not tried"
    seconds = estimate.seconds(pairs)
    return (
        f"about {_shown(estimate.events(pairs))} events, "
        f"in {seconds.least:,.1f} to {seconds.most:,.1f} s ({pairs} pairs)\n"
        f"tried  {tried} of {pairs} pairs: {each} each{_sureness(estimate)}\n"
        f"files  {files}\n{memory}"
    )


def _shown(found: Range) -> str:
    """The mean, and the range if there is one."""
    span = f" ({found.least:,.0f} to {found.most:,.0f})" if found.least < found.most else ""
    return f"{found.mean:,.0f}{span}"


def _sureness(estimate: Estimate) -> str:
    """What makes the numbers rough, besides what the pairs differ by."""
    if estimate.is_slow:
        return "; slow change adds up between them"
    if len(estimate.trials) >= min(MOST_PAIRS, estimate.pairs_total or MOST_PAIRS):
        return ""
    part = "" if estimate.trials[0].sizes else "less than "
    return f"; a rough guess, as {part}{len(estimate.trials)} took {MOST_SECONDS:g} s"


def size_text(size: float) -> str:
    """Bytes for people, such as "1.2 GB"."""
    for unit, name in ((2**40, "TB"), (2**30, "GB"), (2**20, "MB")):
        if size >= unit:
            return f"{size / unit:,.1f} {name}"
    return f"{size / 2**10:,.0f} KB"
