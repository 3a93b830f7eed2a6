"""What a run of the benchmark found, and its JSON document."""

from __future__ import annotations

import math
import os
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from texvent._version import __version__
from texvent.metrics.compare import load_metric
from texvent.metrics.summary import Summary, normalise, summarise

SCHEMA = "texvent-fidelity-1"
"""Name of the document's layout; docs/benchmark.md describes it."""


@dataclass(frozen=True, kw_only=True)
class Reference:
    """What two true recordings of a scene score, and what the null scores, per scoring seed."""

    scene: str
    target: str
    """Pixels of the reference: "noisy" or "ideal"."""
    events: list[int]
    floor: Mapping[str, list[float]]
    """Metric → values of a second recording."""
    null: Mapping[str, list[float]]
    """Metric → values of the reference with its times shuffled."""


@dataclass(frozen=True, kw_only=True)
class Score:
    """What one entry scored on one scene."""

    scene: str
    target: str
    entry: str
    track: str
    threshold: float | None
    """δ fitted on the fitting seeds; None for a simulator without one."""
    is_matched: bool
    """False where no δ brings the count within 2 %."""
    default_ratio: float
    """Events per true event at the preset's own δ, on the fitting seeds."""
    values: Mapping[str, list[float]]
    """Metric → value per scoring seed."""
    seconds: float
    """Time of one simulation."""

    def summary(self, metric: str) -> Summary:
        """Mean ± standard error over the scoring seeds."""
        return summarise(self.values[metric])

    def normalised(self, metric: str, reference: Reference) -> float:
        """`S*`: 0 at the null, 1 at the floor; NaN where the null is no worse than the floor."""
        return normalise(
            self.summary(metric).mean,
            floor=summarise(reference.floor[metric]).mean,
            null=summarise(reference.null[metric]).mean,
            better=load_metric(metric).better,
        )

    def difference(self, metric: str, other: Score) -> Summary:
        """This entry minus another on the same seeds: the paired difference."""
        pairs = zip(self.values[metric], other.values[metric], strict=True)
        return summarise([mine - theirs for mine, theirs in pairs])


@dataclass(frozen=True, kw_only=True)
class FidelityReport:
    """Everything a run found."""

    fit_seeds: Sequence[int]
    score_seeds: Sequence[int]
    references: Sequence[Reference]
    scores: Sequence[Score]
    skipped: Mapping[str, str] = field(default_factory=dict)
    """Entry → why it did not run."""
    seconds: float = 0.0

    def reference(self, scene: str, target: str) -> Reference:
        """Floor and null of a scene."""
        return next(one for one in self.references if one.scene == scene and one.target == target)

    def document(self) -> dict[str, Any]:
        """Plain values, ready for JSON; undefined ones are None."""
        scores = []
        for score in self.scores:
            reference = self.reference(score.scene, score.target)
            normalised = {metric: score.normalised(metric, reference) for metric in score.values}
            scores.append({**asdict(score), "normalised": normalised})
        document = {
            "schema": SCHEMA,
            "texvent_version": __version__,
            "python": platform.python_version(),
            "numpy": np.__version__,
            "machine": f"{platform.machine()}, {os.cpu_count()} cores",
            "fit_seeds": list(self.fit_seeds),
            "score_seeds": list(self.score_seeds),
            "seconds": round(self.seconds, 1),
            "references": [asdict(one) for one in self.references],
            "scores": scores,
            "skipped": dict(self.skipped),
        }
        plain: dict[str, Any] = _without_nan(document)
        return plain


def _without_nan(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _without_nan(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_without_nan(item) for item in value]
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    return value
