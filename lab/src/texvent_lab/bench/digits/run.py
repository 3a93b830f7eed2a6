"""Networks trained on simulated digits, tested on recorded ones: all steps, then the report.

Every set and every prediction is a file in the plan's folder, named after all that it depends on,
so that a run that was stopped goes on.
"""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent import __version__
from texvent.config import check_range
from texvent.errors import FileFormatError
from texvent.events import EventStream
from texvent.extending import require
from texvent.frames import frame_time_us
from texvent.io.atomic import atomic_file
from texvent.run.prepare import prepare_video
from texvent.run.rate_search import UNREACHED, find_threshold
from texvent.runtime.files.cache_folder import make_folder
from texvent.simulation.model_options import contrast_threshold_of
from texvent.training.draws import RANGES
from texvent_lab.bench.digits.data import (
    FIRST_TEST,
    DigitRecording,
    Mnist,
    read_mnist,
    read_recordings,
)
from texvent_lab.bench.digits.inputs import (
    REPRESENTATIONS,
    InputSet,
    join_inputs,
    polarity_agreement,
    represent_all,
    represent_recordings,
)
from texvent_lab.bench.digits.plan import (
    BETWEEN,
    Cell,
    DigitsArm,
    DigitsPlan,
    DigitsTraining,
    Way,
    find_arm,
)
from texvent_lab.bench.digits.results import DigitsReport, SetScore, compare_with_best
from texvent_lab.bench.digits.sheet import WHITE, Digits, DigitSheet
from texvent_lab.bench.digits.training import predict, train_network
from texvent_lab.bench.document import describe_environment
from texvent_lab.bench.jobs import Progress, no_progress
from texvent_lab.bench.kept_results import digest_of, is_whole, make_missing
from texvent_lab.train.schedule import EXTRA

PROTOCOL = 4
"""Part of every file's name: raise it when a step computes something else from the same plan."""
LEAST_AGREEMENT = 0.6
"""Share of events with the right sign below which recordings are refused; see
`polarity_agreement`."""
DRAWING_SEED = 0
"""Seed of motion and contrast."""


def run_digits(
    plan: DigitsPlan, *, jobs: int = 1, progress: Progress = no_progress
) -> DigitsReport:
    """Simulate, train and test what was not before.

    Args:
        plan: see `DigitsPlan`.
        jobs: processes to use; 1 stays in this one.
        progress: told of every step.

    Raises:
        MissingDependencyError: torch is not installed.
        InputError, FileFormatError: the data is missing or damaged.
        ConfigError: jobs is below 1.
    """
    start = time.perf_counter()
    check_range("jobs", jobs, 1)
    require("torch", extra=EXTRA)
    run = open_run(plan)
    for function, todo, path in (
        (make_set, plan.cells, run.set_path),
        (train_one, plan.every_training, run.prediction_path),
    ):
        steps: list[tuple[Any, ...]] = [(one,) for one in todo]
        make_missing(function, run, steps, path, jobs=jobs, progress=progress)
    return collect(run, time.perf_counter() - start)


@dataclass(frozen=True)
class DigitsRun:
    """A plan and facts of its data; small, so that processes can be given it."""

    plan: DigitsPlan
    mnist: str
    """Digest of the images and labels."""
    recorded: str
    """Digest of the recordings that are tested on."""
    target: float
    """Events that the pair in the middle has."""
    polarity: float
    """See `polarity_agreement`, of the pairs."""

    def path(self, kind: str, extension: str, *config: Any) -> Path:
        """File of a result that depends on the config, plain values."""
        name = digest_of(__version__, PROTOCOL, kind, *config)
        return self.plan.work / f"{kind}-{name}{extension}"

    @property
    def recordings_path(self) -> Path:
        """Recordings that are tested on."""
        return self.path("recordings", ".npz", self.recorded)

    def set_path(self, cell: Cell) -> Path:
        """The simulated recordings of a set."""
        plan, arm = self.plan, find_arm(cell.arm)
        settings = arm.settings(cell.way).as_tables()
        chance = (dataclasses.asdict(arm.stimulus), arm.threshold_range)
        facts: list[Any] = [settings, *chance, plan.pairs, self.target, plan.digits, self.mnist]
        if arm.stream:
            facts.append(arm.stream)
        if arm.stream_threshold:
            facts.append(arm.stream_threshold)
        return self.path("set", ".npz", *facts)

    def prediction_path(self, training: DigitsTraining) -> Path:
        """The predictions of a network."""
        plan, schedule = self.plan, self.plan.schedule
        seen = self.set_path(training.cell).stem if training.cell else (training.fold, plan.folds)
        how = (plan.steps, schedule.batch_size, schedule.learning_rate, plan.precision)
        facts = (self.recorded, seen, training.representation, training.seed, *how)
        return self.path("predicted", ".npz", *facts)


def open_run(plan: DigitsPlan) -> DigitsRun:
    """Read the data, check it, and keep the images of the recordings.

    Raises:
        InputError, FileFormatError: a file is missing or damaged; the message says which.
    """
    mnist = read_mnist(plan.mnist)
    if len(mnist.images) < plan.pairs + plan.digits:
        raise FileFormatError(
            f"{plan.mnist} holds {len(mnist.images)} images; MNIST's test set has 10000"
        )
    pairs = read_recordings(plan.nmnist, range(FIRST_TEST + 1, FIRST_TEST + 1 + plan.pairs))
    if [one.label for one in pairs] != mnist.labels[: plan.pairs].tolist():
        raise FileFormatError(
            f"recordings {FIRST_TEST + 1} and up in {plan.nmnist} have other labels than the "
            f"images in {plan.mnist}; they must show MNIST's test images in their order"
        )
    sheet = DigitSheet(Digits.as_measured(mnist.images[: plan.pairs]))
    polarity = polarity_agreement(sheet, [one.events for one in pairs])
    if polarity < LEAST_AGREEMENT:
        raise FileFormatError(
            f"{polarity:.0%} of the events in {plan.nmnist} have the sign of their digit's change "
            "of brightness; N-MNIST's files as published have 1 where it falls, so do not flip it"
        )
    recorded = read_recordings(plan.nmnist, range(1, plan.recorded + 1))
    run = DigitsRun(
        plan=plan,
        mnist=digest_of(mnist.images.tobytes(), mnist.labels.tobytes()),
        recorded=digest_of(*map(_bytes, recorded)),
        target=represent_recordings(pairs).median_count,
        polarity=polarity,
    )
    make_folder(plan.work)
    if not is_whole(run.recordings_path):
        represent_recordings(recorded).write(run.recordings_path)
    return run


def _bytes(recording: DigitRecording) -> bytes:
    events = recording.events
    columns = (events.x, events.y, events.t, events.p)
    return b"".join(one.tobytes() for one in columns) + bytes([recording.label])


def make_set(run: DigitsRun, cell: Cell) -> str:
    """Fit the threshold of a set to the pairs and simulate it; returns a line for progress.

    Where no threshold gives the count, the preset's own is kept.
    """
    start_s, plan, arm = time.perf_counter(), run.plan, find_arm(cell.arm)
    mnist = read_mnist(plan.mnist)
    if arm.stream:
        found = simulate_digits(mnist, plan.numbers, arm, cell.way, math.nan)
        dataclasses.replace(found, is_matched=False).write(run.set_path(cell))
        seconds = time.perf_counter() - start_s
        return f"{cell.arm}: {found.median_count:.0f} events ({seconds:.0f} s)"

    def simulate(numbers: NDArray[np.int64], threshold: float, arm: DigitsArm) -> InputSet:
        return simulate_digits(mnist, numbers, arm, cell.way, threshold)

    middle = dataclasses.replace(arm, threshold_range=1.0)
    start = contrast_threshold_of(arm.settings(cell.way).simulate)
    match = find_threshold(
        lambda threshold: simulate(1 + np.arange(plan.pairs), threshold, middle).median_count,
        run.target,
        start=start,
    )
    is_matched = abs(match.ratio - 1) <= UNREACHED
    threshold = match.threshold if is_matched else start
    found = dataclasses.replace(
        simulate(plan.numbers, threshold, arm), threshold=threshold, is_matched=is_matched
    )
    found.write(run.set_path(cell))
    seconds = time.perf_counter() - start_s
    return (
        f"{cell.arm}, {cell.way}: threshold {threshold:.3f} (from {start:.3f}), "
        f"{found.median_count:.0f} events ({seconds:.0f} s)"
    )


def simulate_digits(
    mnist: Mnist, numbers: NDArray[np.int64], arm: DigitsArm, way: Way, threshold: float
) -> InputSet:
    """Simulated recordings of digits.

    Args:
        mnist: all images.
        numbers: of those to record, from 1.
        arm: the pixel model, and how digits are shown.
        way: frames of the model.
        threshold: contrast threshold, log units.
    """
    parts = []
    for first in range(0, len(numbers), arm.part):
        chosen = numbers[first : first + arm.part]
        digits = Digits.draw(mnist.images[chosen - 1], chosen, DRAWING_SEED, arm.stimulus)
        sheet, number = DigitSheet(digits), int(chosen[0])
        events = _events_of(sheet, arm, way, arm.threshold_of(number, threshold), number)
        images, counts = represent_all(events)
        parts.append(
            InputSet(
                {name: sheet.cut(image) for name, image in images.items()},
                sheet.cut(counts).sum(axis=(2, 3)),
                mnist.labels[chosen - 1].astype(np.int64),
            )
        )
    return join_inputs(parts)


def _events_of(
    sheet: DigitSheet, arm: DigitsArm, way: Way, threshold: float, seed: int
) -> EventStream:
    """Events of a sheet by the pixel model of an arm, or by the draws of its stream."""
    if arm.stream:
        from texvent_lab.train.one_clip import streamed_events  # imports torch

        fps = sheet.fps * (BETWEEN + 1)
        instants = (frame_time_us(n, fps) for n in range((sheet.frame_count - 1) * (BETWEEN + 1)))
        frames = [sheet.at(one) for one in instants]
        light = np.stack([one.pixels for one in frames]) / WHITE
        coded = np.rint(WHITE * light ** (1 / RANGES[arm.stream].gamma)).astype(np.uint8)
        ranges = {"threshold": arm.stream_threshold} if arm.stream_threshold else {}
        times_us = np.array([one.t_us for one in frames])
        return streamed_events(coded, times_us, arm.stream, seed, **ranges)
    settings = arm.settings(way, threshold=threshold)
    run = dataclasses.replace(settings.run, seed=seed)
    return prepare_video(sheet, dataclasses.replace(settings, run=run)).packets.collect()


def train_one(run: DigitsRun, training: DigitsTraining) -> str:
    """Train a network and store its predictions; returns a line for progress."""
    plan, start = run.plan, time.perf_counter()
    recorded = InputSet.read(run.recordings_path)
    number = np.arange(len(recorded.labels))
    if training.cell is None:
        is_seen = number % plan.folds != training.fold
        seen, which = recorded, is_seen
    else:
        is_seen = np.zeros(len(number), np.bool_)
        seen = InputSet.read(run.set_path(training.cell))
        which = np.ones(len(seen.labels), np.bool_)
    network = train_network(
        seen.images[training.representation][which],
        seen.labels[which],
        steps=plan.steps,
        schedule=plan.schedule,
        seed=training.seed,
        precision=plan.precision,
    )
    images = recorded.images[training.representation]
    predicted = np.where(is_seen, -1, predict(network, images))
    with atomic_file(run.prediction_path(training), overwrite=True) as part, part.open("wb") as out:
        np.savez(out, predicted=predicted)
    right = (predicted == recorded.labels)[~is_seen].mean()
    return f"{training.name}: {right:.3f} ({time.perf_counter() - start:.0f} s)"


def collect(run: DigitsRun, seconds: float) -> DigitsReport:
    """The report of a run whose files are all there."""
    plan = run.plan
    recorded = InputSet.read(run.recordings_path)

    def predicted(trainings: Sequence[DigitsTraining]) -> NDArray[np.int64]:
        """[trainings, recordings]; −1 for a recording that a network saw."""
        return np.stack([np.load(run.prediction_path(one))["predicted"] for one in trainings])

    scores: list[SetScore] = []
    for kind in REPRESENTATIONS:
        votes = {cell: predicted(plan.trainings(cell, kind)) for cell in plan.cells}
        p_values = {
            cell: p
            for way in dict.fromkeys(cell.way for cell in plan.cells)
            for cell, p in compare_with_best(
                {cell: one for cell, one in votes.items() if cell.way == way}, recorded.labels
            ).items()
        }
        for cell in plan.cells:
            simulated = InputSet.read(run.set_path(cell))
            scores.append(
                SetScore(
                    arm=cell.arm,
                    way=cell.way,
                    representation=kind,
                    events=simulated.median_count,
                    on_share=simulated.on_share,
                    threshold=None if math.isnan(simulated.threshold) else simulated.threshold,
                    is_matched=simulated.is_matched,
                    accuracy=(votes[cell] == recorded.labels).mean(axis=1).tolist(),
                    p=p_values[cell],
                )
            )
    ceiling = {
        kind: [
            float((predicted(plan.folds_of(kind, seed)).max(axis=0) == recorded.labels).mean())
            for seed in range(plan.seeds)
        ]
        for kind in REPRESENTATIONS
    }
    return DigitsReport(
        environment=describe_environment(),
        protocol=_protocol(run),
        recorded_events=recorded.median_count,
        recorded_on_share=recorded.on_share,
        scores=scores,
        ceiling=ceiling,
        seconds=seconds,
    )


def _protocol(run: DigitsRun) -> dict[str, Any]:
    plan = run.plan
    return {
        "training images": f"{plan.numbers[0]} to {plan.numbers[-1]}",
        "recordings": plan.recorded,
        "pairs for fitting": plan.pairs,
        "events of the pair in the middle": run.target,
        "share of events with the right sign": run.polarity,
        "steps of training": plan.steps,
        "batch size": plan.schedule.batch_size,
        "learning rate": f"{plan.schedule.learning_rate}, falling to 0",
        "precision": plan.precision,
        "networks per set": plan.seeds,
        "folds": plan.folds,
        "digest of the recordings": run.recorded,
        "digest of the images": run.mnist,
    }
