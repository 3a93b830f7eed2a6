"""The perturbation self-test: which perturbed recordings each metric tells from a clean one."""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.metrics.compare import default_metrics, load_metric
from texvent.metrics.protocol import Metric, find_missing
from texvent.metrics.summary import badness
from texvent_lab.bench.markdown import MarkdownReport
from texvent_lab.bench.oracle.pixel import NOISY
from texvent_lab.bench.oracle.recording import oracle_scene, record
from texvent_lab.bench.progress import Progress, no_progress
from texvent_lab.bench.selftest.perturbations import PERTURBATIONS, SERIES, perturb

SCENE, TEXTURE_SEED = "mixed", 7
RECORDING_SEEDS = (1, 2, 3, 4)
FLOOR_PAIRS = ((0, 1), (1, 0), (2, 3), (3, 2), (0, 2), (2, 0), (1, 3), (3, 1))
"""Which recordings are compared to learn how much two recordings of one scene differ."""
DETECTED = 3.0
"""Standard deviations above the floor from which a perturbation counts as found."""


@dataclass(frozen=True, kw_only=True)
class SelftestRow:
    """What one metric saw."""

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


class SelftestRows(list[SelftestRow], MarkdownReport):
    """A row for each metric; a list in every other way."""

    def markdown(self) -> str:
        """The rows as a table, best metrics first."""
        from texvent_lab.bench.selftest.table import selftest_table  # which reads rows

        return selftest_table(self)


def run_selftest(
    metrics: Iterable[str] | None = None, *, progress: Progress = no_progress
) -> SelftestRows:
    """Run the self-test on the oracle's `mixed` scene with noisy pixels.

    Args:
        metrics: names; default: all whose weights are here.
        progress: told of every step.

    Raises:
        ConfigError: no metric has one of the names, or its weights are missing.
    """
    chosen = default_metrics() if metrics is None else [load_metric(name) for name in metrics]
    for metric in chosen:
        missing = find_missing(metric)
        if missing is not None:
            raise ConfigError(f"metric {metric.name} cannot be computed: {missing}")
    progress(f"recording {SCENE} with {len(RECORDING_SEEDS)} seeds")
    recordings = record_scene()
    perturbed = {name: perturb(recordings[1], name) for name in PERTURBATIONS}
    rows = []
    for metric in chosen:
        progress(metric.name)
        rows.append(evaluate_metric(metric, recordings, perturbed))
    return SelftestRows(rows)


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
