"""What a run found, and its document."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent_lab.bench.digits.arms import Cell
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
from texvent_lab.bench.digits.report.statistics import compare_classifiers, vote
from texvent_lab.bench.document_types import check_record
from texvent_lab.bench.machine import describe_environment
from texvent_lab.bench.markdown import MarkdownReport

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
        from texvent_lab.bench.digits.report.page import accuracy_sections  # which reads reports

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
