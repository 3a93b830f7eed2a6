"""Entries scored against true or recorded events: δ fitted on one part, scored on another."""

from __future__ import annotations

import itertools
import time
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Protocol

from texvent.errors import ConfigError, TexventError, shown
from texvent.events import EventStream
from texvent.metrics.compare import compare
from texvent.metrics.protocol import Metric
from texvent_lab.bench.fidelity.entries import Entry
from texvent_lab.bench.fidelity.results import Reference, Score
from texvent_lab.bench.jobs import Progress, run_jobs

NULL = "shuffle all times"
"""Perturbation of the null; see `perturbations`."""


class Truth(Protocol):
    """A scene or recording whose events are known; picklable."""

    @property
    def scene(self) -> str:
        """Its name."""
        ...

    @property
    def target(self) -> str:
        """Kind of pixels, or "recorded"."""
        ...

    @property
    def references(self) -> Sequence[EventStream]:
        """The true events that are scored, window by window."""
        ...

    @property
    def fit_count(self) -> int:
        """Number of true events to which δ is fitted."""
        ...

    def count(self, entry: Entry, threshold: float | None) -> int:
        """Number of simulated events where δ is fitted; None leaves the preset's δ."""
        ...

    def simulate(self, entry: Entry, threshold: float | None) -> list[EventStream]:
        """Simulated events of each scored window.

        Raises:
            TexventError: the simulator cannot run as it is, such as without its weights.
        """
        ...


Metrics = Sequence[str | Metric]


def check_names(entries: Iterable[Entry]) -> None:
    """Refuse rows that tables could not tell apart.

    Raises:
        ConfigError: two rows have one name.
    """
    counts = Counter(entry.name for entry in entries)
    for name, count in counts.items():
        if count > 1:
            raise ConfigError(f"{count} rows are called {shown(name)}; name each row once")


def score_entries(
    truths: Sequence[Truth],
    entries: Sequence[Entry],
    metrics: Metrics,
    *,
    jobs: int,
    progress: Progress,
) -> tuple[list[Score], dict[str, str]]:
    """Scores of every entry on every truth, and why others did not run: name → reason."""
    scores: list[Score] = []
    skipped: dict[str, str] = {}
    work = [(truth, entry, metrics) for truth, entry in itertools.product(truths, entries)]
    for found in run_jobs(score_entry, work, jobs):
        if isinstance(found, Score):
            progress(f"{found.scene}, {found.target}: {found.entry} ({found.seconds:.1f} s)")
            scores.append(found)
        else:
            skipped[found[0]] = found[1]
    return scores, skipped


def score_entry(truth: Truth, entry: Entry, metrics: Metrics) -> Score | tuple[str, str]:
    """One entry on one truth.

    Returns:
        The score, or (name of the entry, why it cannot run).
    """
    try:
        match, default_ratio = entry.fit(
            lambda threshold: truth.count(entry, threshold), truth.fit_count
        )
        start = time.perf_counter()
        simulated = truth.simulate(entry, match.threshold if match else None)
        seconds = time.perf_counter() - start
    except TexventError as error:
        return entry.name, str(error)
    return Score(
        scene=truth.scene,
        target=truth.target,
        entry=entry.name,
        track=entry.track,
        threshold=match.threshold if match else None,
        is_matched=bool(match and match.is_matched),
        default_ratio=default_ratio,
        values=compare_all(simulated, truth.references, metrics),
        seconds=seconds,
    )


def score_recorded(
    truth: Truth,
    entry: str,
    events: Sequence[EventStream],
    metrics: Metrics,
    *,
    references: Sequence[EventStream] | None = None,
) -> Score:
    """Events of a sensor, window by window, as a row of the table.

    Args:
        truth: scene or recording of the row.
        entry: name of the row.
        events: of each window.
        metrics: names, or metrics.
        references: true events of each window; None: those of the truth.
    """
    return Score(
        scene=truth.scene,
        target=truth.target,
        entry=entry,
        track="recorded",
        values=compare_all(events, references or truth.references, metrics),
    )


def measure_bounds(
    truth: Truth, floors: Sequence[EventStream], nulls: Sequence[EventStream], metrics: Metrics
) -> Reference:
    """Scores of a second recording and of the null, both window by window."""
    return Reference(
        scene=truth.scene,
        target=truth.target,
        events=[len(events) for events in truth.references],
        floor=compare_all(floors, truth.references, metrics),
        null=compare_all(nulls, truth.references, metrics),
    )


def compare_all(
    predicted: Iterable[EventStream], references: Iterable[EventStream], metrics: Metrics
) -> dict[str, list[float]]:
    """Name of the metric → value per pair of a simulated and a true stream."""
    rows = [compare(one, other, metrics) for one, other in zip(predicted, references, strict=True)]
    return {name: [row[name] for row in rows] for name in (rows[0] if rows else ())}
