"""What a run of the benchmark found, and its JSON document."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields
from typing import Any

from texvent.errors import FileFormatError, shown
from texvent.metrics.compare import load_metric, plain_values
from texvent.metrics.summary import Summary, normalise, summarise
from texvent_lab.bench.document import MarkdownReport, check_record, restore_nan
from texvent_lab.bench.fidelity.comparison import Comparison, Details
from texvent_lab.bench.oracle.pixel import TARGETS

SCHEMA = "texvent-fidelity-2"
"""Name of the document's layout; docs/benchmark.md describes it."""


@dataclass(frozen=True, kw_only=True)
class Reference:
    """What two true recordings of a scene score, and what the null scores, per scoring seed."""

    scene: str
    target: str
    """Pixels of the reference, "noisy" or "ideal", or "recorded"."""
    events: list[int]
    floor: Mapping[str, list[float]]
    """Metric → values of a second recording."""
    null: Mapping[str, list[float]]
    """Metric → values of the reference with its times shuffled."""
    details: Details
    """Of the floor."""

    @property
    def title(self) -> str:
        """What tables and charts call it."""
        return f"{self.scene}, {self.target}{' pixels' if self.target in TARGETS else ''}"


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
    details: Details

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
class FidelityReport(MarkdownReport):
    """Everything a run found."""

    environment: Mapping[str, Any]
    """What it ran on: `environment.describe_environment`."""
    references: Sequence[Reference]
    scores: Sequence[Score]
    fit_seeds: Sequence[int] = ()
    """Textures on which δ was fitted; none for recordings."""
    score_seeds: Sequence[int] = ()
    skipped: Mapping[str, str] = field(default_factory=dict)
    """Entry → why it did not run."""
    seconds: float = 0.0
    floor_name: str = "second recording"
    """What the floor compares with the truth."""
    protocol: Mapping[str, Any] = field(default_factory=dict)
    """Recording → what was used of it, for real ones."""

    def markdown(self) -> str:
        """All tables of the run."""
        from texvent_lab.bench.fidelity.table import fidelity_tables  # which reads reports

        return fidelity_tables(self)

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
        document = {
            "schema": SCHEMA,
            "environment": dict(self.environment),
            "fit_seeds": list(self.fit_seeds),
            "score_seeds": list(self.score_seeds),
            "seconds": round(self.seconds, 1),
            "floor_name": self.floor_name,
            "protocol": dict(self.protocol),
            "references": [asdict(one) for one in self.references],
            "scores": scores,
            "skipped": dict(self.skipped),
        }
        plain: dict[str, Any] = plain_values(document)
        return plain


def _undefined_last(score: Score) -> float:
    mean = score.summary("stpp").mean
    return math.inf if math.isnan(mean) else -mean


def read_report(document: Mapping[str, Any]) -> FidelityReport:
    """The report that a document states.

    Args:
        document: as `FidelityReport.document` gives it, read back from JSON.

    Raises:
        FileFormatError: it is another kind of document, or lacks a part.
    """
    if document.get("schema") != SCHEMA:
        raise FileFormatError(
            f"the document's schema is {shown(document.get('schema'))}, not {SCHEMA!r}; "
            "run texvent bench fidelity --out again"
        )
    parts = {name: value for name, value in document.items() if name not in _RECORDS}
    restored = {name: _with_nan(name, document) for name in _RECORDS}
    check_record(FidelityReport, {**parts, **restored}, "the document")
    report = FidelityReport(
        **{name: parts[name] for name in _PARTS},
        references=[_reference(one) for one in restored["references"]],
        scores=[_score(one) for one in restored["scores"]],
    )
    _check_lengths(report)
    return report


_RECORDS = ("references", "scores")
_PARTS = [field.name for field in fields(FidelityReport) if field.name not in _RECORDS]


def _reference(values: Mapping[str, Any]) -> Reference:
    known = {field.name: values[field.name] for field in fields(Reference)}
    return Reference(**{**known, "details": _details(values)})


def _score(values: Mapping[str, Any]) -> Score:
    known = {field.name: values[field.name] for field in fields(Score)}
    return Score(**{**known, "details": _details(values)})


def _details(values: Mapping[str, Any]) -> Details:
    return Details(**{field.name: values["details"][field.name] for field in fields(Details)})


def _check_lengths(report: FidelityReport) -> None:
    """Refuse a report whose parts do not belong together.

    Raises:
        FileFormatError: a score has no reference, or a list is longer or shorter than the others.
    """
    known = {(one.scene, one.target): one for one in report.references}
    if not known or not report.scores:
        raise FileFormatError("the document has no reference or no score")
    for reference in report.references:
        if reference.floor.keys() != reference.null.keys():
            raise FileFormatError(f"{shown(reference.title)}: floor and null differ in metrics")
    for score in report.scores:
        where = f"the score of {shown(score.entry)} on {shown(score.scene)}"
        if (score.scene, score.target) not in known:
            raise FileFormatError(f"{where} has no reference")
        floor = known[score.scene, score.target].floor
        if "stpp" not in score.values or score.values.keys() - floor.keys():
            raise FileFormatError(f"{where} has other metrics than its reference, or no stpp")
        if len({len(one) for one in (*score.values.values(), *floor.values())}) != 1:
            raise FileFormatError(f"{where} and its reference have lists of unequal length")
    details = [one.details for one in report.references]
    details += [one.details for one in report.scores]
    if len({tuple(map(len, (one.time_error, *one.levels))) for one in details}) != 1:
        raise FileFormatError("the details of the scores have lists of unequal length")


def _with_nan(name: str, document: Mapping[str, Any]) -> list[Any]:
    """References or scores with NaN for undefined values; a threshold may be None."""
    parts = document.get(name)
    if not isinstance(parts, list) or not all(isinstance(one, Mapping) for one in parts):
        raise FileFormatError(f"the document's {name} are no list of objects")
    return [_restored(one) for one in parts]


def _restored(part: Mapping[str, Any]) -> dict[str, Any]:
    restored = {
        name: restore_nan(value)
        for name, value in part.items()
        if name in ("values", "floor", "null", "default_ratio", "details")
    }
    return {**part, **restored}
