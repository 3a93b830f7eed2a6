"""The first steps of a run: the recordings, thresholds fitted to pairs, simulated sets."""

from __future__ import annotations

import dataclasses
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.run.prepare import prepare_video
from texvent.run.rate_search import UNREACHED, find_threshold
from texvent.runtime.cache_folder import make_folder
from texvent.settings.resolution import Settings
from texvent.simulate.model_options import contrast_threshold_of
from texvent_lab.bench.digits.arms import Cell, digest_of, find_arm
from texvent_lab.bench.digits.inputs import (
    InputSet,
    Mnist,
    join_inputs,
    polarity_agreement,
    read_mnist,
    represent_all,
)
from texvent_lab.bench.digits.pair_fit import fit_to_pairs
from texvent_lab.bench.digits.plan import DigitsPlan, Run, recorded_step
from texvent_lab.bench.digits.recordings import FIRST_TEST, Recording, read_recordings
from texvent_lab.bench.digits.sheet import Digits, DigitSheet

SHEET, RANDOM_SHEET = 100, 25
"""Digits per sheet; and where each sheet has a threshold of its own."""
LEAST_AGREEMENT = 0.6
"""Share of events with the right sign below which recordings are refused; see
`polarity_agreement`."""
DRAWING_SEED = 0
"""Of motion and contrast."""


def open_run(plan: DigitsPlan) -> Run:
    """Read the data, check it, and keep the images of the recordings.

    Raises:
        InputError, FileFormatError: a file is missing or damaged; the message says which.
    """
    mnist = read_mnist(plan.mnist)
    if len(mnist.images) < plan.pairs + plan.digits + plan.held_out:
        raise FileFormatError(
            f"{plan.mnist} holds {len(mnist.images)} images; MNIST's test set has 10000"
        )
    pairs = read_recordings(plan.nmnist, range(FIRST_TEST + 1, FIRST_TEST + 1 + plan.pairs))
    labels = [one.label for one in pairs]
    sheet = DigitSheet(Digits.as_measured(mnist.images[: plan.pairs]))
    if labels != mnist.labels[: plan.pairs].tolist():
        raise FileFormatError(
            f"recordings {FIRST_TEST + 1} and up in {plan.nmnist} have other labels than the "
            f"images in {plan.mnist}; they must show MNIST's test images in their order"
        )
    polarity = polarity_agreement(sheet, [one.events for one in pairs])
    if polarity < LEAST_AGREEMENT:
        raise FileFormatError(
            f"{polarity:.0%} of the events in {plan.nmnist} have the sign of their digit's change "
            "of brightness; N-MNIST's files as published have 1 where it falls, so do not flip it"
        )
    recorded = read_recordings(plan.nmnist, range(1, plan.recorded + 1))
    digest = digest_of(*(_bytes(one) for one in recorded))
    step = recorded_step(plan, digest)
    if not step.is_done:
        make_folder(step.path("").parent)
        represent_recordings(recorded).write(step.path(".npz"))
        step.write({})
    return Run(
        plan=plan,
        mnist=digest_of(mnist.images.tobytes(), mnist.labels.tobytes()),
        recorded=digest,
        pairs=digest_of(*(_bytes(one) for one in pairs)),
        target=represent_recordings(pairs).median_count,
        polarity=polarity,
    )


def represent_recordings(recordings: list[Recording]) -> InputSet:
    """The images of recordings."""
    images, counts = zip(*(represent_all(one.events) for one in recordings), strict=True)
    return InputSet(
        {name: np.stack([one[name] for one in images]) for name in images[0]},
        np.stack(counts).sum(axis=(2, 3)),
        np.array([one.label for one in recordings], np.int64),
    )


def simulate_digits(
    mnist: Mnist, numbers: NDArray[np.int64], settings: Settings, *, is_random: bool = False
) -> InputSet:
    """Simulated recordings of digits.

    Args:
        mnist: all images.
        numbers: of those to record, from 1.
        settings: of the simulation.
        is_random: draw thresholds and noise for every sheet.
    """
    length = RANDOM_SHEET if is_random else SHEET
    parts = []
    for first in range(0, len(numbers), length):
        chosen = numbers[first : first + length]
        run = dataclasses.replace(
            settings.run, seed=int(chosen[0]), randomize="stoffregen" if is_random else "none"
        )
        digits = Digits.draw(mnist.images[chosen - 1], chosen, DRAWING_SEED)
        parts.append(
            simulate_sheet(
                DigitSheet(digits), mnist.labels[chosen - 1], dataclasses.replace(settings, run=run)
            )
        )
    return join_inputs(parts)


def simulate_sheet(sheet: DigitSheet, labels: NDArray[Any], settings: Settings) -> InputSet:
    """Simulated recordings of the digits of a sheet."""
    images, counts = represent_all(prepare_video(sheet, settings).packets.collect())
    return InputSet(
        {name: sheet.cut(image) for name, image in images.items()},
        sheet.cut(counts).sum(axis=(2, 3)),
        labels.astype(np.int64),
    )


def fit_physical(run: Run, arm: str) -> str:
    """Fit the options of an arm to the pairs; returns a line for progress."""
    plan = run.plan
    images = read_mnist(plan.mnist).images[: plan.pairs]
    pairs = read_recordings(plan.nmnist, range(FIRST_TEST + 1, FIRST_TEST + 1 + plan.pairs))
    options, start, found = fit_to_pairs(
        DigitSheet(Digits.as_measured(images)),
        [one.events for one in pairs],
        find_arm(arm).settings("exact"),
    )
    run.pair_fit_step().write({"options": options, "start": str(start), "fitted": str(found)})
    return f"{arm}: distance to the pairs {start.total:.3f} to {found.total:.3f}"


def fit_cell(run: Run, cell: Cell) -> str:
    """Fit the threshold of an arm to the pairs; returns a line for progress.

    Where no threshold gives the count, the preset's own is kept.
    """
    step = run.fit_step(cell)
    mnist, numbers = read_mnist(run.plan.mnist), 1 + np.arange(run.plan.pairs)

    def count(threshold: float | None) -> float:
        settings = run.settings(cell, threshold=threshold)
        return simulate_digits(mnist, numbers, settings).median_count

    start = contrast_threshold_of(run.settings(cell).simulate)
    match = find_threshold(count, run.target, start=start)
    is_matched = abs(match.ratio - 1) <= UNREACHED
    threshold = match.threshold if is_matched else start
    step.write({"threshold": threshold, "is_matched": is_matched})
    return f"{cell.arm}, {cell.way}: threshold {threshold:.3f} (from {start:.3f})"


def simulate_cell(run: Run, cell: Cell) -> str:
    """Simulate the recordings of a set; returns a line for progress."""
    step, plan, start = run.set_step(cell), run.plan, time.perf_counter()
    mnist = read_mnist(plan.mnist)
    settings = run.settings(cell, threshold=run.threshold(cell))
    is_random = cell.choice == "random"
    found = join_inputs(
        [
            simulate_digits(mnist, numbers, settings, is_random=is_random)
            for numbers in (plan.numbers, plan.held_out_numbers)
        ]
    )
    make_folder(step.path("").parent)
    found.write(step.path(".npz"))
    seconds = time.perf_counter() - start
    facts = {"events": found.median_count, "on_share": found.on_share, "seconds": seconds}
    step.write(facts)
    return f"{cell.name}: {found.median_count:.0f} events ({seconds:.0f} s)"


def _bytes(recording: Recording) -> bytes:
    events = recording.events
    columns = (events.x, events.y, events.t, events.p)
    return b"".join(one.tobytes() for one in columns) + bytes([recording.label])
