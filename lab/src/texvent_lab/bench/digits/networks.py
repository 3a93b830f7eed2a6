"""The last steps of a run: networks, and what they take recordings for."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent_lab.bench.digits.arms import Cell
from texvent_lab.bench.digits.inputs import CLASSES, InputSet
from texvent_lab.bench.digits.plan import DigitsPlan, Run, Training
from texvent_lab.bench.digits.training import predict, train_network

REAL_SHARE = 4
"""Every so many-th training sample is a recording, where both are mixed."""


def train_one(run: Run, training: Training) -> str:
    """Train a network and note what it takes recordings for; returns a line for progress."""
    step, plan, start = run.training_step(training), run.plan, time.perf_counter()
    recorded = run.recordings()
    is_seen = choose_recordings(recorded.labels, training, plan)
    images = recorded.images[training.representation]
    seen = [(images[is_seen], recorded.labels[is_seen])]
    simulated = held_out = None
    if training.cell is not None:
        found = InputSet.read(run.set_step(training.cell).path(".npz"))
        simulated, held_out = found[: plan.digits], found[plan.digits :]
        repeats = len(simulated) // (REAL_SHARE - 1) // max(int(is_seen.sum()), 1)
        seen = seen * max(repeats, 1)
        seen.append((simulated.images[training.representation], simulated.labels))
    network = train_network(
        np.concatenate([one for one, _ in seen]),
        np.concatenate([labels for _, labels in seen]),
        steps=plan.steps,
        schedule=plan.schedule,
        seed=training.seed,
        precision=plan.precision,
    )
    predicted = np.where(is_seen, -1, predict(network, images))
    values: dict[str, Any] = {"predicted": predicted.tolist()}
    if held_out is not None:
        values["held_out"] = _accuracy(network, held_out, training.representation)
    if "judged" in step.config:
        values["judged"] = {
            cell.name: _accuracy(network, _held_out(run, cell), training.representation)
            for cell in plan.cells
        }
    is_unseen = ~is_seen
    right = (predicted == recorded.labels)[is_unseen]
    step.write({**values, "seconds": time.perf_counter() - start})
    share = f"{right.mean():.3f}" if len(right) else "trained on all recordings"
    return f"{training.name}: {share} ({time.perf_counter() - start:.0f} s)"


def choose_recordings(
    labels: NDArray[np.int64], training: Training, plan: DigitsPlan
) -> NDArray[np.bool_]:
    """Which recordings a network is trained on.

    Args:
        labels: [n] of all recordings.
        training: with shots, the first so many of each class in an order drawn by its seed: more
            shots hold those of fewer. With a fold, all but every so many-th recording.
        plan: the number of folds.

    Returns:
        [n].
    """
    number = np.arange(len(labels))
    if training.shots:
        return first_of_each(labels, training.shots, training.seed)
    if training.cell is not None:
        return np.zeros(len(labels), bool)
    if training.fold is not None:
        return np.asarray(number % plan.folds != training.fold)
    return np.ones(len(labels), bool)


def first_of_each(labels: NDArray[np.int64], count: int, seed: int) -> NDArray[np.bool_]:
    """Whether each recording is among the first of its class in an order drawn by the seed."""
    is_first = np.zeros(len(labels), bool)
    order = np.random.default_rng((seed, 1)).permutation(len(labels))
    for label in range(CLASSES):
        is_first[order[labels[order] == label][:count]] = True
    return is_first


def _held_out(run: Run, cell: Cell) -> InputSet:
    return InputSet.read(run.set_step(cell).path(".npz"))[run.plan.digits :]


def _accuracy(network: Any, inputs: InputSet, representation: str) -> float:
    predicted = predict(network, inputs.images[representation])
    return float((predicted == inputs.labels).mean())
