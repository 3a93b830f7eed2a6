"""Accuracies of a run with their significance, the document, and the table."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent_lab.bench.digits.data import CLASSES
from texvent_lab.bench.document import markdown_table, read_records
from texvent_lab.bench.summary import mean_text, summarise

SCHEMA = "texvent-digits-2"
SIGNIFICANCE = 0.05
"""Classifiers differ where p is not above it."""
BEST, ALIKE = "(best)", "(≈)"
"""Marks of the best arm, and of those that cannot be told apart from it."""
REPRESENTATION_TITLES = {"histogram": "counts", "surface": "times"}
WAY_TITLES = {
    "exact": "true frames",
    "flow": "60 frames per second, interpolated",
    "frames": "60 frames per second alone",
}
MARK_NOTE = (
    f"{BEST}: the highest mean of those with the same frames. {ALIKE}: cannot be told apart from "
    "it (McNemar's exact test on the votes of all networks of an arm, "
    f"p > {SIGNIFICANCE:g} by Holm's correction).\n"
)
Key = TypeVar("Key")


def mcnemar_p(first: NDArray[np.bool_], second: NDArray[np.bool_]) -> float:
    """p-value of McNemar's exact two-sided test.

    Args:
        first: [n] whether a classifier recognises each recording.
        second: [n], of another classifier.

    Source: Q. McNemar, Psychometrika 1947; exact, from the binomial distribution.

    Example:
        >>> mcnemar_p(np.array([True] * 6), np.array([True] + [False] * 5))
        0.0625
    """
    only_first, only_second = int((first & ~second).sum()), int((second & ~first).sum())
    count, fewer = only_first + only_second, min(only_first, only_second)
    tail = sum(math.comb(count, number) for number in range(fewer + 1))
    return min(1.0, float(2 * tail / 2**count))


def holm(p_values: Sequence[float]) -> list[float]:
    """p-values of several tests, adjusted so that all together err in at most their share of cases.

    Args:
        p_values: of tests that need not be independent.

    Source: S. Holm, "A simple sequentially rejective multiple test procedure", 1979.

    Example:
        >>> holm([0.01, 0.04, 0.03])
        [0.03, 0.06, 0.06]
    """
    order = sorted(range(len(p_values)), key=p_values.__getitem__)
    adjusted = [0.0] * len(p_values)
    largest = 0.0
    for rank, index in enumerate(order):
        largest = max(largest, min(1.0, p_values[index] * (len(p_values) - rank)))
        adjusted[index] = largest
    return adjusted


def vote(predictions: NDArray[np.int64]) -> NDArray[np.int64]:
    """The class that most networks name, of equals the smallest: [networks, n] → [n]."""
    votes = (predictions[:, :, None] == np.arange(CLASSES)).sum(axis=0)
    return np.asarray(votes.argmax(axis=1), np.int64)


def compare_with_best(
    predictions: Mapping[Key, NDArray[np.int64]], labels: NDArray[np.int64]
) -> dict[Key, float | None]:
    """p-value of each arm against the best one, by Holm's correction; None for the best.

    Args:
        predictions: arm → [networks, n] classes.
        labels: [n] right classes.
    """
    best = max(predictions, key=lambda arm: float((predictions[arm] == labels).mean()))
    right = {arm: vote(one) == labels for arm, one in predictions.items()}
    others = [arm for arm in predictions if arm != best]
    p_values = holm([mcnemar_p(right[best], right[arm]) for arm in others])
    return {best: None, **dict(zip(others, p_values, strict=True))}


@dataclass(frozen=True)
class SetScore:
    """Networks that were trained on one set and see one representation."""

    arm: str
    way: str
    representation: str
    events: float
    """Events of the median simulated recording."""
    on_share: float
    threshold: float | None
    """Contrast threshold, log units; None where a stream draws it."""
    is_matched: bool
    """Whether the threshold gives the recorded count; else it is the preset's own."""
    accuracy: list[float]
    """On recordings, per seed."""
    p: float | None
    """See `compare_with_best`, of those with the same frames."""


@dataclass(frozen=True)
class DigitsReport:
    """All results."""

    environment: Mapping[str, Any]
    protocol: Mapping[str, Any]
    recorded_events: float
    """Events of the median recording of those tested on."""
    recorded_on_share: float
    scores: list[SetScore]
    ceiling: Mapping[str, list[float]]
    """Representation → accuracy of networks trained on recordings, per seed."""
    seconds: float

    def document(self) -> dict[str, Any]:
        """The values, ready for JSON."""
        return {"schema": SCHEMA, **asdict(self)}


def read_report(document: Mapping[str, Any]) -> DigitsReport:
    """The results in a document.

    Raises:
        FileFormatError: it has another schema.
        KeyError, TypeError: it has another layout.
    """
    if document.get("schema") != SCHEMA:
        raise FileFormatError(f"this is no result of texvent bench digits ({SCHEMA})")
    values = {name: value for name, value in document.items() if name != "schema"}
    return DigitsReport(**{**values, "scores": read_records(SetScore, values["scores"])})


def digits_table(report: DigitsReport) -> str:
    """Accuracy on recordings of each arm, the best on top; thresholds and counts of its set."""
    rows: dict[tuple[str, str], dict[str, SetScore]] = {}
    for score in report.scores:
        rows.setdefault((score.arm, score.way), {})[score.representation] = score
    ranked = sorted(rows.values(), key=lambda row: -summarise(next(iter(row.values())).accuracy)[0])
    table = []
    for row in ranked:
        one = next(iter(row.values()))
        drawn = "drawn" if one.threshold is None else f"{one.threshold:.3f}"
        lost = "" if one.is_matched or one.threshold is None else " (count not reached)"
        cells = [_cell(row[kind]) if kind in row else "–" for kind in report.ceiling]
        counts = (drawn, f"{one.events:.0f}{lost}", f"{one.on_share:.3f}")
        table.append([one.arm, WAY_TITLES[one.way], *counts, *cells])
    ceiling = [mean_text(values) for values in report.ceiling.values()]
    counts = ("", f"{report.recorded_events:.0f}", f"{report.recorded_on_share:.3f}")
    table.append(["recordings (folds)", "", *counts, *ceiling])
    titles = ["trained on", "frames", "δ", "events (median)", "ON share"]
    titles += [REPRESENTATION_TITLES[kind] for kind in report.ceiling]
    return f"{markdown_table(titles, table)}\n{MARK_NOTE}"


def _cell(score: SetScore) -> str:
    is_alike = score.p is not None and score.p > SIGNIFICANCE
    mark = BEST if score.p is None else ALIKE if is_alike else ""
    return f"{mean_text(score.accuracy)} {mark}".rstrip()
