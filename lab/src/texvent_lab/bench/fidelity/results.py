"""Scores of a run against true or recorded events, and their JSON document."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from typing import Any

from texvent.errors import FileFormatError, shown
from texvent.metrics.compare import load_metric, plain_values
from texvent_lab.bench.document import read_records
from texvent_lab.bench.fidelity.comparison import Comparison
from texvent_lab.bench.oracle.pixel import TARGETS
from texvent_lab.bench.summary import Summary, normalise, summarise

SCHEMA = "texvent-fidelity-2"
"""Name of the document's layout."""


@dataclass(frozen=True, kw_only=True)
class Reference:
    """Scores of a second recording of a scene, and of the null, per scored window."""

    scene: str
    target: str
    """Pixels of the reference, "noisy" or "ideal", or "recorded"."""
    events: list[int]
    floor: Mapping[str, list[float]]
    """Metric → values of a second recording."""
    null: Mapping[str, list[float]]
    """Metric → values of the reference with its times shuffled."""

    @property
    def title(self) -> str:
        """Name in tables and charts."""
        return f"{self.scene}, {self.target}{' pixels' if self.target in TARGETS else ''}"


@dataclass(frozen=True, kw_only=True)
class Score:
    """Scores of one entry on one scene."""

    scene: str
    target: str
    entry: str
    track: str
    threshold: float | None = None
    """Fitted δ; None for a simulator without one."""
    is_matched: bool = True
    """False where no δ brings the count within 2 %."""
    default_ratio: float = math.nan
    """Events per true event at the preset's own δ, where δ is fitted."""
    values: Mapping[str, list[float]]
    """Metric → value per scored window."""
    seconds: float = 0.0
    """Time of the scored simulations."""

    def summary(self, metric: str) -> Summary:
        """Mean ± standard error over the windows."""
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
        """This entry minus another on the same windows: the paired difference."""
        pairs = zip(self.values[metric], other.values[metric], strict=True)
        return summarise([mine - theirs for mine, theirs in pairs])


@dataclass(frozen=True, kw_only=True)
class FidelityReport:
    """All results of a run."""

    environment: Mapping[str, Any]
    """See `document.describe_environment`."""
    references: Sequence[Reference]
    scores: Sequence[Score]
    fit_seeds: Sequence[int] = ()
    """Textures on which δ was fitted; none for recordings."""
    score_seeds: Sequence[int] = ()
    skipped: Mapping[str, str] = field(default_factory=dict)
    """Entry → why it did not run."""
    seconds: float = 0.0
    floor_name: str = "second recording"
    """Events that the floor compares with the truth."""
    protocol: Mapping[str, Any] = field(default_factory=dict)
    """Recording → what was used of it, for real ones."""

    def reference(self, scene: str, target: str) -> Reference:
        """Floor and null of a scene."""
        return next(one for one in self.references if one.scene == scene and one.target == target)

    def ranked(self, scene: str, target: str) -> list[Score]:
        """Scores on a scene, best STPP first, undefined ones last."""
        scores = [one for one in self.scores if (one.scene, one.target) == (scene, target)]
        return sorted(scores, key=_undefined_last)

    def comparison(self, reference: Reference) -> Comparison:
        """The entries on one scene by STPP, over its textures or spans of time."""
        scores = self.ranked(reference.scene, reference.target)
        values = {score.entry: score.values["stpp"] for score in scores}
        return Comparison(values, self._tracks(), is_in_sequence=not self.score_seeds)

    def overall_comparison(self) -> Comparison:
        """The entries by S* of STPP over scenes, each the mean of its kinds of pixels.

        Kinds of pixels share a scene, so they are no windows of their own. An entry that did not
        run on a scene is undefined there.
        """
        found: dict[str, dict[str, list[float]]] = {score.entry: {} for score in self.scores}
        for score in self.scores:
            value = score.normalised("stpp", self.reference(score.scene, score.target))
            found[score.entry].setdefault(score.scene, []).append(value)
        scenes = dict.fromkeys(reference.scene for reference in self.references)
        values = {
            entry: [summarise(of.get(scene, [])).mean for scene in scenes]
            for entry, of in found.items()
        }
        return Comparison(values, self._tracks(), is_in_sequence=False)

    def _tracks(self) -> dict[str, str]:
        return {one.entry: one.track for one in self.scores if one.track != "recorded"}

    def document(self) -> dict[str, Any]:
        """Plain values, ready for JSON; undefined ones are None."""
        comparisons = {(one.scene, one.target): self.comparison(one) for one in self.references}
        scores = []
        for score in self.scores:
            reference = self.reference(score.scene, score.target)
            normalised = {metric: score.normalised(metric, reference) for metric in score.values}
            behind = comparisons[score.scene, score.target].document(score.entry)
            scores.append({**asdict(score), "normalised": normalised, "behind_best": behind})
        document: dict[str, Any] = plain_values(
            {"schema": SCHEMA, **asdict(self), "scores": scores}
        )
        return document


def _undefined_last(score: Score) -> float:
    mean = score.summary("stpp").mean
    return math.inf if math.isnan(mean) else -mean


def read_report(document: Mapping[str, Any]) -> FidelityReport:
    """The report that a document states.

    Args:
        document: as `FidelityReport.document` gives it, read back from JSON.

    Raises:
        FileFormatError: it has another schema.
        KeyError, TypeError: it has another layout.
    """
    if document.get("schema") != SCHEMA:
        raise FileFormatError(
            f"the document's schema is {shown(document.get('schema'))}, not {SCHEMA!r}; "
            "run texvent bench fidelity --out again"
        )
    known = {one.name: document[one.name] for one in fields(FidelityReport)}
    known["references"] = read_records(Reference, document["references"])
    known["scores"] = read_records(Score, document["scores"])
    return FidelityReport(**known)
