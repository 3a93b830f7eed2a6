"""The results as Markdown tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from texvent.metrics.summary import summarise
from texvent_lab.bench.classification import binomial_error
from texvent_lab.bench.digits.results import (
    SIGNIFICANCE,
    DigitsReport,
    SetScore,
    difference_interval,
    holm,
)
from texvent_lab.bench.document import markdown_table

REPRESENTATION_TITLES = {
    "histogram": "Counts (histogram of three movements)",
    "surface": "Times (time surface)",
}
WAY_TITLES = {
    "exact": "true frames",
    "flow": "60 frames per second, interpolated",
    "frames": "60 frames per second alone",
}
BEST, ALIKE = "(best)", "(≈)"
"""Marks of the best arm, and of those that cannot be told apart from it."""
REFERENCES = ("texvent accurate", "texvent paper", "physical")
"""Arms that the others are compared with."""


def accuracy_table(report: DigitsReport, representation: str) -> str:
    """Accuracy on recordings of each arm, by the choice of its threshold; the best on top.

    Marks say which arm is best of those with the same frames and choice of a threshold, and which
    cannot be told apart from it (`best_marks`).
    """
    scores = [one for one in report.scores if one.representation == representation]
    marks = best_marks(report, representation)
    choices = list(dict.fromkeys(one.choice for one in scores))
    rows: dict[tuple[str, str], dict[str, SetScore]] = {}
    for one in scores:
        rows.setdefault((one.arm, one.way), {})[one.choice] = one
    ranked = sorted(rows.items(), key=lambda item: -_mean(next(iter(item[1].values()))))
    table = []
    for (arm, way), found in ranked:
        cells = [
            f"{_accuracy(found[choice])} {marks.get((arm, way, choice), '')}".rstrip()
            if choice in found
            else ""
            for choice in choices
        ]
        first = next(iter(found.values()))
        table.append(
            [arm, WAY_TITLES[way], *cells, mean_text(first.held_out), mean_text(first.judged)]
        )
    ceiling = report.ceiling.get(representation, [])
    none = [""] * (len(choices) - 1)
    table.append(["recordings (folds)", "", mean_text(ceiling), *none, "", ""])
    titles = ["trained on", "frames", *(f"δ {choice}" for choice in choices)]
    return markdown_table([*titles, "on simulated", "judged by real-trained"], table)


def best_marks(report: DigitsReport, representation: str) -> dict[tuple[str, str, str], str]:
    """(arm, way, choice) → mark of the best of each way and choice, and of those like it.

    Arms are alike where McNemar's test on the votes of their networks has p > .05 by Holm's
    correction for all arms of that way and choice.
    """
    marks: dict[tuple[str, str, str], str] = {}
    scores = [one for one in report.scores if one.representation == representation]
    for way, choice in dict.fromkeys((one.way, one.choice) for one in scores):
        group = [one for one in scores if (one.way, one.choice) == (way, choice)]
        best = max(group, key=_mean).arm
        against = {
            ({one.first, one.second} - {best}).pop(): one.p
            for one in report.comparisons
            if (one.representation, one.way, one.choice) == (representation, way, choice)
            and best in (one.first, one.second)
        }
        arms = [one.arm for one in group if one.arm in against]
        if not arms:
            continue
        marks[best, way, choice] = BEST
        p_values = holm([against[arm] for arm in arms])
        for arm, p_value in zip(arms, p_values, strict=True):
            if p_value > SIGNIFICANCE:
                marks[arm, way, choice] = ALIKE
    return marks


def mark_note() -> str:
    """What the marks of accuracy tables say."""
    return (
        f"{BEST}: the highest mean of those with the same frames and choice of δ. {ALIKE}: cannot "
        "be told apart from it (McNemar's exact test on the votes of all networks of an arm, "
        f"p > {SIGNIFICANCE:g} by Holm's correction)."
    )


def count_table(report: DigitsReport) -> str:
    """Thresholds, counts and polarity of every set."""
    rows = [
        [
            one.arm,
            WAY_TITLES[one.way],
            one.choice,
            "" if one.threshold is None else f"{one.threshold:.3f}",
            f"{one.events:.0f}{_unmatched(one)}",
            f"{one.on_share:.3f}",
        ]
        for one in _one_each(report.scores)
    ]
    events, on_share = f"{report.recorded_events:.0f}", f"{report.recorded_on_share:.3f}"
    rows.append(["recordings", "", "", "", events, on_share])
    return markdown_table(["arm", "frames", "δ", "fitted δ", "events (median)", "ON share"], rows)


def comparison_table(report: DigitsReport, representation: str, way: str, choice: str) -> str:
    """McNemar's test of the reference arms against all others of the same kind."""
    wanted = [
        one
        for one in report.comparisons
        if (one.representation, one.way, one.choice) == (representation, way, choice)
        and one.first in REFERENCES
    ]
    count = int(report.protocol["recordings"])
    rows = []
    for one, adjusted in zip(wanted, holm([one.p for one in wanted]), strict=True):
        low, high = difference_interval(one.only_first, one.only_second, count)
        difference = (one.only_first - one.only_second) / count
        rows.append(
            [
                one.first,
                one.second,
                str(one.only_first),
                str(one.only_second),
                f"{difference:+.3f} [{low:+.3f}, {high:+.3f}]",
                f"{one.p:.2g}",
                f"{adjusted:.2g}",
            ]
        )
    right = ["only first right", "only second right"]
    return markdown_table(["first", "second", *right, "difference", "p", "p (Holm)"], rows)


def few_shot_table(report: DigitsReport) -> str:
    """Accuracy by recordings per class, with each arm's simulated recordings and without."""
    shots = sorted({one.shots for one in report.few_shot})
    arms = list(dict.fromkeys(one.arm for one in report.few_shot))
    found = {(one.arm, one.shots): mean_text(one.accuracy) for one in report.few_shot}
    rows = [[arm, *(found.get((arm, one), "") for one in shots)] for arm in arms]
    return markdown_table(["simulated by", *(f"k = {one}" for one in shots)], rows)


def summary_text(report: DigitsReport) -> str:
    """The accuracy tables for a terminal."""
    parts = []
    for representation in report.ceiling:
        parts.append(f"{REPRESENTATION_TITLES[representation]}: accuracy on recordings\n")
        parts.append(accuracy_table(report, representation))
    parts.append(f"{mark_note()}\n")
    return "\n".join(parts)


def mean_text(values: Sequence[float]) -> str:
    """Mean ± standard error over seeds."""
    if not values:
        return ""
    found = summarise(values)
    error = f" ± {found.standard_error:.3f}" if found.defined > 1 else ""
    return f"{found.mean:.3f}{error}"


def binomial_text(report: DigitsReport, count: int) -> str:
    """The standard error that the number of recordings leaves, at two accuracies."""
    errors = (f"{binomial_error(one, count):.3f} at {one:g}" for one in (0.9, 0.95))
    return f"The choice of {count} recordings adds a standard error of {', '.join(errors)}."


def _accuracy(score: SetScore) -> str:
    return f"{mean_text(score.accuracy)}{_unmatched(score)}"


def _unmatched(score: SetScore) -> str:
    return "" if score.threshold is None or score.is_matched else " (count not reached)"


def _mean(score: SetScore) -> float:
    return summarise(score.accuracy).mean


def _one_each(scores: Iterable[SetScore]) -> list[SetScore]:
    """One score of each set, whatever the representation."""
    return list({(one.arm, one.way, one.choice): one for one in scores}.values())
