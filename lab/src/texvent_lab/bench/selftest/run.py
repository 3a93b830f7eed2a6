"""The self-test of the metrics: twenty perturbations of a recording, and which each metric sees."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

import numpy as np

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.metrics.compare import default_metrics, load_metric
from texvent.metrics.controls import (
    Generator,
    add_noise,
    columns_of,
    draw_columns,
    flip,
    shuffle_space,
    shuffle_time,
    stream_of,
)
from texvent.metrics.protocol import Metric
from texvent_lab.bench.jobs import Progress, no_progress
from texvent_lab.bench.oracle.pixel import NOISY
from texvent_lab.bench.oracle.recording import oracle_scene, record
from texvent_lab.bench.summary import badness

Perturbation: TypeAlias = Callable[[EventStream, Generator], EventStream]

FRAME_RATE_HZ = 24


def jitter_time(events: EventStream, rng: Generator, *, sd_ms: float) -> EventStream:
    """Times moved by normal noise."""
    columns = columns_of(events)
    columns["t"] += np.rint(rng.normal(0, sd_ms * 1000, len(events))).astype(np.int64)
    return stream_of(columns, events)


def shift_time(events: EventStream, rng: Generator, *, shift_ms: float) -> EventStream:
    """All times moved by the same amount."""
    del rng
    columns = columns_of(events)
    columns["t"] += round(shift_ms * 1000)
    return stream_of(columns, events)


def batch(events: EventStream, rng: Generator, *, rate_hz: int) -> EventStream:
    """Times moved to the end of their frame: what a simulator without time stamps gives."""
    del rng
    columns = columns_of(events)
    frame = -(-columns["t"] * rate_hz // 1_000_000)
    columns["t"] = frame * 1_000_000 // rate_hz
    return stream_of(columns, events)


def shuffle_in_frames(events: EventStream, rng: Generator) -> EventStream:
    """Times exchanged between the events of each 1/24 s."""
    columns = columns_of(events)
    frame = columns["t"] * FRAME_RATE_HZ // 1_000_000
    # Times ascend, so the sorted frame numbers are those of the unshuffled times.
    columns["t"] = columns["t"][np.argsort(np.lexsort((rng.random(len(events)), frame)))]
    return stream_of(columns, events)


def drop(events: EventStream, rng: Generator, *, share: float) -> EventStream:
    """A random share of the events lost."""
    return events[rng.random(len(events)) >= share]


def scatter(events: EventStream, rng: Generator, *, share: float) -> EventStream:
    """A random share of the events moved to random pixels, times and polarities."""
    is_moved = rng.random(len(events)) < share
    columns = columns_of(events)
    moved = draw_columns(rng, int(is_moved.sum()), events.size, events.time_range or (0, 1))
    for name, values in moved.items():
        columns[name][is_moved] = values
    return stream_of(columns, events)


def move_right(events: EventStream, rng: Generator) -> EventStream:
    """Everything one pixel to the right; the last column stays."""
    del rng
    columns = columns_of(events)
    columns["x"] = np.minimum(columns["x"] + 1, events.size.width - 1)
    return stream_of(columns, events)


def jitter_space(events: EventStream, rng: Generator) -> EventStream:
    """Each event up to one pixel away, in x and y."""
    columns = columns_of(events)
    for name, side in (("x", events.size.width), ("y", events.size.height)):
        moved = columns[name] + rng.integers(-1, 2, len(events))
        columns[name] = np.clip(moved, 0, side - 1)
    return stream_of(columns, events)


PERTURBATIONS: Mapping[str, Perturbation] = {
    "jitter 0.5 ms": partial(jitter_time, sd_ms=0.5),
    "jitter 2 ms": partial(jitter_time, sd_ms=2.0),
    "jitter 8 ms": partial(jitter_time, sd_ms=8.0),
    "shift 2 ms": partial(shift_time, shift_ms=2.0),
    "batch 240 Hz": partial(batch, rate_hz=240),
    "batch 24 Hz": partial(batch, rate_hz=24),
    "shuffle in frames": shuffle_in_frames,
    "shuffle all times": shuffle_time,
    "drop 10 %": partial(drop, share=0.1),
    "drop 30 %": partial(drop, share=0.3),
    "drop 50 %": partial(drop, share=0.5),
    "noise 10 %": partial(add_noise, share=0.1),
    "noise 30 %": partial(add_noise, share=0.3),
    "noise 100 %": partial(add_noise, share=1.0),
    "flip 5 %": partial(flip, share=0.05),
    "flip 20 %": partial(flip, share=0.2),
    "flip 100 %": partial(flip, share=1.0),
    "right 1 px": move_right,
    "jitter 1 px": jitter_space,
    "shuffle all pixels": shuffle_space,
}
"""Name → what it does to a stream."""

SERIES: Mapping[str, tuple[str, ...]] = {
    "jitter": ("jitter 0.5 ms", "jitter 2 ms", "jitter 8 ms"),
    "drop": ("drop 10 %", "drop 30 %", "drop 50 %"),
    "noise": ("noise 10 %", "noise 30 %", "noise 100 %"),
    "flip": ("flip 5 %", "flip 20 %", "flip 100 %"),
    "batch": ("batch 240 Hz", "batch 24 Hz"),
    "shuffle": ("shuffle in frames", "shuffle all times"),
    "space": ("right 1 px", "shuffle all pixels"),
}
"""Perturbations in order of severity: a metric should worsen along each."""


def perturb(events: EventStream, name: str) -> EventStream:
    """The stream after the perturbation `name`; the same each time."""
    index = list(PERTURBATIONS).index(name)
    return PERTURBATIONS[name](events, np.random.default_rng([2026, index]))


SCENE, TEXTURE_SEED = "mixed", 7
RECORDING_SEEDS = (1, 2, 3, 4)
FLOOR_PAIRS = ((0, 1), (1, 0), (2, 3), (3, 2), (0, 2), (2, 0), (1, 3), (3, 1))
"""Pairs of recordings whose differences make the floor."""
DETECTED = 3.0
"""Standard deviations above the floor from which a perturbation counts as found."""


@dataclass(frozen=True, kw_only=True)
class SelftestRow:
    """Result of one metric."""

    metric: str
    better: str
    floor: float
    """Mean over pairs of recordings of the same scene."""
    floor_sd: float
    values: Mapping[str, float]
    """Perturbation → value of the perturbed second recording against the first."""
    z: Mapping[str, float]
    """Perturbation → standard deviations worse than the floor."""
    monotone: Mapping[str, bool]
    """Series → whether the metric worsens at each step, from the floor on."""
    seconds: float
    """Time of one comparison."""

    @property
    def found(self) -> tuple[str, ...]:
        """Perturbations that were told from the floor."""
        return tuple(name for name, z in self.z.items() if z > DETECTED)

    @property
    def missed(self) -> tuple[str, ...]:
        """Perturbations that were not."""
        return tuple(name for name in self.z if name not in self.found)


def run_selftest(
    metrics: Iterable[str] | None = None, *, progress: Progress = no_progress
) -> list[SelftestRow]:
    """Run the self-test on the oracle's `mixed` scene with noisy pixels.

    Args:
        metrics: names; default: all whose weights are here.
        progress: told of every step.

    Raises:
        ConfigError: no metric has one of the names, or its weights are missing.
    """
    chosen = default_metrics() if metrics is None else [load_metric(name) for name in metrics]
    for metric in chosen:
        missing = metric.missing()
        if missing is not None:
            raise ConfigError(f"metric {metric.name} cannot be computed: {missing}")
    progress(f"recording {SCENE} with {len(RECORDING_SEEDS)} seeds")
    recordings = record_scene()
    perturbed = {name: perturb(recordings[1], name) for name in PERTURBATIONS}
    rows: list[SelftestRow] = []
    for metric in chosen:
        progress(metric.name)
        rows.append(evaluate_metric(metric, recordings, perturbed))
    return rows


def record_scene() -> list[EventStream]:
    """Four recordings of the self-test's scene, alike but for their noise."""
    models = {str(seed): (NOISY, seed) for seed in RECORDING_SEEDS}
    return list(record(oracle_scene(SCENE, TEXTURE_SEED), models).values())


def evaluate_metric(
    metric: Metric, recordings: Sequence[EventStream], perturbed: Mapping[str, EventStream]
) -> SelftestRow:
    """One row: floor, values of every perturbation, what was found, what is monotone.

    Args:
        metric: what to judge.
        recordings: four recordings of one scene.
        perturbed: perturbation → the second recording after it.
    """
    start = time.perf_counter()
    floors = [metric(recordings[second], recordings[first]) for first, second in FLOOR_PAIRS]
    seconds = (time.perf_counter() - start) / len(floors)
    values = {name: metric(events, recordings[0]) for name, events in perturbed.items()}
    floor_badness = [badness(value, metric.better) for value in floors]
    mean, sd = float(np.mean(floor_badness)), float(np.std(floor_badness, ddof=1))
    scale = max(sd, 1e-3 * abs(mean) + 1e-6)
    z = {name: (badness(value, metric.better) - mean) / scale for name, value in values.items()}
    return SelftestRow(
        metric=metric.name,
        better=metric.better,
        floor=float(np.mean(floors)),
        floor_sd=float(np.std(floors, ddof=1)),
        values=values,
        z=z,
        monotone={name: _is_monotone([0.0, *(z[one] for one in SERIES[name])]) for name in SERIES},
        seconds=seconds,
    )


def ranked_rows(rows: Iterable[SelftestRow]) -> list[SelftestRow]:
    """Rows with those first that found most, and among equals those with most monotone series."""
    return sorted(rows, key=lambda row: (-len(row.found), -sum(row.monotone.values())))


def _is_monotone(z: Sequence[float]) -> bool:
    return all(later > earlier for earlier, later in itertools.pairwise(z))
