"""The self-test of the metrics: twenty perturbations of a recording, and which each metric sees."""

from __future__ import annotations

import itertools
import math
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.metrics.compare import default_metrics, load_metric, plain_values
from texvent.metrics.protocol import Metric
from texvent_lab.bench.document import describe_environment, markdown_table
from texvent_lab.bench.jobs import Progress, no_progress
from texvent_lab.bench.oracle.pixel import NOISY
from texvent_lab.bench.oracle.recording import oracle_scene, record
from texvent_lab.bench.perturbations import PERTURBATIONS, perturb
from texvent_lab.bench.summary import badness
from texvent_lab.charts import matrix_chart

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


SCHEMA = "texvent-selftest-1"
"""Name of the document's layout: one entry of `rows` per `SelftestRow`."""
MOST_NAMES = 8
"""Missed perturbations that a row of the table names; of more, one less and dots."""
FOUND, REWARDED = (0.298, 0.471, 0.659), (0.894, 0.341, 0.337)
"""Colours of what was found, and of damage that scores better than a second recording."""
FULL = 1000.0
"""Standard deviations that are drawn in full colour."""
LEGEND = (
    "Standard deviations worse than the floor. Blue: found (above 3). White: missed. "
    "Red: damage that the metric rewards."
)


def selftest_table(rows: Sequence[SelftestRow]) -> str:
    """The result as a Markdown table, best metrics first."""
    lines = []
    for row in ranked_rows(rows):
        missed = row.missed
        if len(missed) > MOST_NAMES:
            missed = (*missed[: MOST_NAMES - 1], "...")
        floor = f"{row.floor:.4g} ± {row.floor_sd:.1g}"
        counts = (str(len(row.found)), str(sum(row.monotone.values())))
        lines.append((row.metric, floor, *counts, ", ".join(missed) or "–"))
    totals = (f"found /{len(PERTURBATIONS)}", f"monotone /{len(SERIES)}")
    return markdown_table(("metric", "floor", *totals, "missed"), lines)


def selftest_document(rows: Sequence[SelftestRow]) -> dict[str, Any]:
    """The result as plain values, ready for JSON; NaN becomes None."""
    return {
        "schema": SCHEMA,
        "environment": describe_environment(),
        "scene": SCENE,
        "texture_seed": TEXTURE_SEED,
        "recording_seeds": list(RECORDING_SEEDS),
        "series": {name: list(steps) for name, steps in SERIES.items()},
        "rows": [plain_values(asdict(row)) for row in rows],
    }


def selftest_chart(rows: Sequence[SelftestRow]) -> bytes:
    """An SVG image of z-scores, the metrics that found most on top.

    Args:
        rows: result of `run_selftest`.
    """
    ranked = ranked_rows(rows)
    return matrix_chart(
        rows=[row.metric for row in ranked],
        columns=[*PERTURBATIONS],
        colours=[[_colour(row.z[name]) for name in PERTURBATIONS] for row in ranked],
        texts=[[_short(row.z[name]) for name in PERTURBATIONS] for row in ranked],
        note=LEGEND,
    )


def _colour(z: float) -> tuple[float, float, float, float]:
    """As strong as the damage was seen; white where it was not."""
    if not abs(z) > DETECTED:
        return (1.0, 1.0, 1.0, 1.0)
    share = min(math.log(abs(z) / DETECTED) / math.log(FULL / DETECTED), 1.0)
    return (*(FOUND if z > 0 else REWARDED), 0.15 + 0.85 * share)


def _short(z: float) -> str:
    """A number in at most five characters."""
    if math.isnan(z):
        return "–"
    if abs(z) == math.inf:
        return "∞" if z > 0 else "−∞"
    text = f"{z:.0f}" if abs(z) < 10_000 else f"{z / 1000:.0f}k"
    return text.replace("-0", "0").replace("-", "−")
