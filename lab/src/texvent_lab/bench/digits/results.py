"""Results of a run with their significance, and the document."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from statistics import NormalDist
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent_lab.bench.digits.arms import Cell
from texvent_lab.bench.digits.inputs import CLASSES
from texvent_lab.bench.digits.networks import first_of_each
from texvent_lab.bench.digits.plan import (
    SHOT_REPRESENTATION,
    DigitsPlan,
    Run,
    Training,
    few_shot_trainings,
    settings_tables,
    shot_cells,
)
from texvent_lab.bench.document import MarkdownReport, check_record, describe_environment

SIGNIFICANCE = 0.05
"""Classifiers differ where p is not above it."""


class McNemar(NamedTuple):
    """Two classifiers on the same recordings."""

    only_first: int
    """Recordings that the first alone recognises."""
    only_second: int
    """Recordings that the second alone recognises."""
    p: float
    """Two-sided: how often as unequal a pair would come up if both were equally good."""


def compare_classifiers(first: NDArray[np.bool_], second: NDArray[np.bool_]) -> McNemar:
    """McNemar's exact test.

    Args:
        first: [n] whether each recording is recognised.
        second: [n], as `first`.

    Source: Q. McNemar, Psychometrika 1947; exact, from the binomial distribution.

    Example:
        >>> compare_classifiers(np.array([True] * 6), np.array([True] + [False] * 5))
        McNemar(only_first=5, only_second=0, p=0.0625)
    """
    only_first, only_second = int((first & ~second).sum()), int((second & ~first).sum())
    count, fewer = only_first + only_second, min(only_first, only_second)
    tail = sum(math.comb(count, number) for number in range(fewer + 1))
    return McNemar(only_first, only_second, min(1.0, 2 * tail / 2**count))


def difference_interval(only_first: int, only_second: int, count: int) -> tuple[float, float]:
    """95 % interval of the difference of two accuracies on the same recordings.

    Args:
        only_first: recordings that the first classifier alone recognises.
        only_second: recordings that the second alone recognises.
        count: all recordings.

    Returns:
        Lower and upper end, first minus second.

    Source: A. Agresti and Y. Min, "Simple improved confidence intervals for comparing matched
        proportions", 2005: Wald's interval with half a recording added to each of the four cells.
    """
    first, second, total = only_first + 0.5, only_second + 0.5, count + 2
    difference = (first - second) / total
    error = math.sqrt(first + second - (first - second) ** 2 / total) / total
    reach = NormalDist().inv_cdf(0.975) * error
    return difference - reach, difference + reach


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


def vote(predictions: Sequence[NDArray[np.int64]]) -> NDArray[np.int64]:
    """The class that most networks name, of equals the smallest; [n]."""
    names = np.stack(predictions)
    votes = (names[:, :, None] == np.arange(CLASSES)).sum(axis=0)
    return np.asarray(votes.argmax(axis=1), np.int64)


SCHEMA = "texvent-digits-1"
RECORDINGS = "recordings"
"""Stands for no simulator in the few-shot curve."""


@dataclass(frozen=True)
class SetScore:
    """Networks that were trained on one set and see one representation."""

    arm: str
    way: str
    choice: str
    representation: str
    events: float
    """Of the simulated recording in the middle."""
    on_share: float
    threshold: float | None
    """Fitted contrast threshold, log units; None: the preset's own, or drawn."""
    is_matched: bool
    """Whether a threshold gives the wanted count; else the preset's own is kept."""
    accuracy: list[float]
    """On recordings, per seed."""
    held_out: list[float]
    """On simulated recordings of other digits, per seed."""
    judged: list[float]
    """Share of the simulated recordings that networks trained on recordings recognise, per seed."""


@dataclass(frozen=True)
class Comparison:
    """Two arms, each by the vote of its networks, on the same recordings."""

    way: str
    choice: str
    representation: str
    first: str
    second: str
    only_first: int
    only_second: int
    p: float


@dataclass(frozen=True)
class ShotScore:
    """Networks that see so many recordings per class, on recordings that none of them sees."""

    arm: str
    """Whose simulated recordings they see too; `RECORDINGS`: none."""
    shots: int
    accuracy: list[float]
    """Per seed, which also draws the recordings."""


@dataclass(frozen=True)
class DigitsReport(MarkdownReport):
    """All results."""

    environment: Mapping[str, Any]
    protocol: Mapping[str, Any]
    recorded_events: float
    """Of the recording in the middle of those tested on."""
    recorded_on_share: float
    options: Mapping[str, Any]
    """Arm and way → all options of the simulation."""
    scores: list[SetScore]
    ceiling: Mapping[str, list[float]]
    """Representation → accuracy of networks trained on recordings, per seed."""
    comparisons: list[Comparison]
    few_shot: list[ShotScore]
    few_shot_tested: int
    """Recordings that the few-shot networks are tested on."""
    seconds: float

    def markdown(self) -> str:
        """For each representation a heading and a table: the accuracy of every arm."""
        from texvent_lab.bench.digits.page import accuracy_sections  # which reads reports

        return "\n\n".join(accuracy_sections(self))

    def document(self) -> dict[str, Any]:
        """The values, ready for JSON."""
        return {"schema": SCHEMA, **asdict(self)}


def read_report(document: Mapping[str, Any]) -> DigitsReport:
    """The results in a document.

    Raises:
        FileFormatError: it is no result of this benchmark.
    """
    if document.get("schema") != SCHEMA:
        raise FileFormatError(f"this is no result of texvent bench digits ({SCHEMA})")
    values = {name: value for name, value in document.items() if name != "schema"}
    check_record(DigitsReport, values, "the result")
    return DigitsReport(
        **{
            **values,
            "scores": [SetScore(**one) for one in values["scores"]],
            "comparisons": [Comparison(**one) for one in values["comparisons"]],
            "few_shot": [ShotScore(**one) for one in values["few_shot"]],
        }
    )


class Collector:
    """Reads the results of all steps of a run, which are there."""

    def __init__(self, run: Run) -> None:
        self._run, self._plan = run, run.plan
        self._recorded = run.recordings()
        self._labels = self._recorded.labels

    def report(self, seconds: float) -> DigitsReport:
        """All results of the run."""
        plan = self._plan
        settings = {
            f"{cell.arm}, {cell.way}": settings_tables(self._run.settings(cell))
            for cell in plan.cells
        }
        return DigitsReport(
            environment=describe_environment(),
            protocol={**_protocol(self._run), "simulated by": self._versions()},
            recorded_events=self._recorded.median_count,
            recorded_on_share=self._recorded.on_share,
            options=settings,
            scores=[
                self._score(cell, kind) for kind in plan.representations for cell in plan.cells
            ],
            ceiling={kind: self._ceiling(kind) for kind in plan.representations},
            comparisons=[one for kind in plan.representations for one in self._compare(kind)],
            few_shot=self._few_shot() if plan.shots else [],
            few_shot_tested=int(self._unseen(0).sum()) if plan.shots else 0,
            seconds=seconds,
        )

    def _versions(self) -> list[str]:
        """Versions of texvent that made the sets, which may be kept from earlier runs."""
        return sorted({self._run.set_step(cell).read()["version"] for cell in self._plan.cells})

    def _predicted(self, training: Training) -> NDArray[np.int64]:
        return np.array(self._run.training_step(training).read()["predicted"], np.int64)

    def _seeds(self, cell: Cell, kind: str) -> list[Training]:
        return [Training(cell, kind, seed) for seed in range(self._plan.seeds_of(cell))]

    def _score(self, cell: Cell, kind: str) -> SetScore:
        run, networks = self._run, self._seeds(cell, kind)
        facts = run.set_step(cell).read()
        fit = run.fit_step(cell).read() if cell.choice == "matched" else {}
        judges = [Training(None, kind, seed) for seed in range(self._plan.other_seeds)]
        return SetScore(
            arm=cell.arm,
            way=cell.way,
            choice=cell.choice,
            representation=kind,
            events=facts["events"],
            on_share=facts["on_share"],
            threshold=fit.get("threshold"),
            is_matched=bool(fit.get("is_matched")),
            accuracy=[float((self._predicted(one) == self._labels).mean()) for one in networks],
            held_out=[run.training_step(one).read()["held_out"] for one in networks],
            judged=[run.training_step(one).read()["judged"][cell.name] for one in judges],
        )

    def _ceiling(self, kind: str) -> list[float]:
        """Every recording by the network that did not see its fold."""
        found = []
        for seed in range(self._plan.other_seeds):
            folds = [
                self._predicted(Training(None, kind, seed, fold=fold))
                for fold in range(self._plan.folds)
            ]
            # A recording that a network saw has −1, less than any class.
            found.append(float((np.max(folds, axis=0) == self._labels).mean()))
        return found

    def _compare(self, kind: str) -> list[Comparison]:
        """Every arm with those after it that have the same frames and choice of a threshold."""
        right = {
            cell: vote([self._predicted(one) for one in self._seeds(cell, kind)]) == self._labels
            for cell in self._plan.cells
        }
        return [
            Comparison(
                first.way,
                first.choice,
                kind,
                first.arm,
                second.arm,
                *compare_classifiers(right[first], right[second]),
            )
            for first, second in comparable_pairs(self._plan.cells)
        ]

    def _few_shot(self) -> list[ShotScore]:
        plan = self._plan

        def accuracy(training: Training) -> float:
            unseen = self._unseen(training.seed)
            return float((self._predicted(training) == self._labels)[unseen].mean())

        found: dict[tuple[str, int], list[float]] = {}
        none = [
            Training(cell, SHOT_REPRESENTATION, seed)
            for cell in shot_cells(plan)
            for seed in range(plan.seeds_of(cell))
        ]
        for one in (*none, *few_shot_trainings(plan)):
            name = one.cell.arm if one.cell else RECORDINGS
            found.setdefault((name, one.shots), []).append(accuracy(one))
        return [ShotScore(name, shots, values) for (name, shots), values in found.items()]

    def _unseen(self, seed: int) -> NDArray[np.bool_]:
        """Recordings that no network of this seed sees, with however many shots."""
        return ~first_of_each(self._labels, max(self._plan.shots), seed)


def comparable_pairs(cells: Sequence[Cell]) -> list[tuple[Cell, Cell]]:
    """Pairs of sets with the same choice of a threshold, and the same frames or display's alone."""
    return [
        (first, second)
        for number, first in enumerate(cells)
        for second in cells[number + 1 :]
        if first.choice == second.choice and second.way in (first.way, "frames")
    ]


def _protocol(run: Run) -> dict[str, Any]:
    plan: DigitsPlan = run.plan
    return {
        "training images": f"{plan.numbers[0]} to {plan.numbers[-1]}",
        "held out images": f"{plan.held_out_numbers[0]} to {plan.held_out_numbers[-1]}",
        "recordings": plan.recorded,
        "pairs for fitting": plan.pairs,
        "events of the pair in the middle": run.target,
        "share of events with the right sign": run.polarity,
        "steps of training": plan.steps,
        "batch size": plan.schedule.batch_size,
        "learning rate": f"{plan.schedule.learning_rate}, falling to 0",
        "precision": plan.precision,
        "networks with matched thresholds": plan.seeds,
        "networks otherwise": plan.other_seeds,
        "folds": plan.folds,
        "digest of the recordings": run.recorded,
        "digest of the images": run.mnist,
    }
