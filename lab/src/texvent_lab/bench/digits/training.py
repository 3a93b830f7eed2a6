"""A small network that tells digits apart, trained on images that were made before.

A training takes seconds, keeps its last network, and counts steps, not epochs: few samples are
trained on for as long as many.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.loading.order import epoch_order
from texvent.extending import require
from texvent.networks.weight_files import Tensor
from texvent_lab.bench.digits.arms import Cell
from texvent_lab.bench.digits.inputs import CLASSES, InputSet
from texvent_lab.bench.digits.plan import DigitsPlan, Run, Training
from texvent_lab.train.schedule import EXTRA, Schedule

Precision: TypeAlias = Literal["float32", "bfloat16"]
SHIFT = 2
"""Largest shift of training images along each axis, px."""
TEST_BATCH = 250


def train_network(
    images: NDArray[Any],
    labels: NDArray[np.int64],
    *,
    steps: int,
    schedule: Schedule,
    seed: int,
    precision: Precision = "float32",
) -> Any:
    """A trained network.

    Args:
        images: [n, C, H, W].
        labels: [n] 0..9.
        steps: batches in all; epochs are repeated until then, so that few samples are trained for
            as long as many.
        schedule: the optimiser, its learning rate, which falls to 0 in a straight line, and the
            size of batches.
        seed: of initial weights, order and shifts.
        precision: number type of the network's computation.
    """
    from texvent_lab.train.classification.task import small_cnn
    from texvent_lab.train.loop import descend  # these import torch

    torch = require("torch", extra=EXTRA)
    # One thread: equal runs give equal weights, and processes do not share cores.
    torch.set_num_threads(1)
    network = small_cnn(images.shape[1], CLASSES, seed).to(memory_format=torch.channels_last)
    network.train()
    optimizer = schedule.make_optimizer(network)

    def losses() -> Iterator[Tensor]:
        batches = _batches(images, labels, schedule.batch_size, seed)
        for step, (batch, classes) in zip(range(steps), batches, strict=False):
            for group in optimizer.param_groups:
                group["lr"] = schedule.learning_rate * (1 - step / steps)
            with torch.autocast("cpu", torch.bfloat16, enabled=precision == "bfloat16"):
                scores = network(_tensor(batch))
            yield torch.nn.functional.cross_entropy(scores.float(), torch.from_numpy(classes))

    descend(losses(), optimizer, network, where="a network of digits", schedule=schedule)
    return network.eval()


def predict(network: Any, images: NDArray[Any]) -> NDArray[np.int64]:
    """The likeliest class of each image, [n]."""
    torch = require("torch", extra=EXTRA)
    found = [np.zeros(0, np.int64)]
    with torch.inference_mode():
        for first in range(0, len(images), TEST_BATCH):
            scores = network(_tensor(images[first : first + TEST_BATCH]))
            found.append(scores.argmax(dim=1).numpy())
    return np.concatenate(found)


def shift_images(images: NDArray[Any], moves: NDArray[np.int64]) -> NDArray[Any]:
    """Images moved by whole pixels, with zeros where nothing came from.

    Moving the events of a small sensor gives the same images: counts and the last event of each
    pixel move with them.

    Args:
        images: [n, C, H, W].
        moves: [n, 2] along x and y, px, at most `SHIFT` either way.
    """
    height, width = images.shape[-2:]
    padded = np.pad(images, ((0, 0), (0, 0), (SHIFT, SHIFT), (SHIFT, SHIFT)))
    moved = np.empty_like(images)
    for number, (dx, dy) in enumerate(moves):
        rows = slice(SHIFT - dy, SHIFT - dy + height)
        columns = slice(SHIFT - dx, SHIFT - dx + width)
        moved[number] = padded[number, :, rows, columns]
    return moved


def _batches(
    images: NDArray[Any], labels: NDArray[np.int64], size: int, seed: int
) -> Iterator[tuple[NDArray[Any], NDArray[np.int64]]]:
    """Shuffled and shifted batches, without end."""
    epoch = 0
    while True:
        order = epoch_order(np.zeros(len(labels), np.int64), seed=seed, epoch=epoch)
        chance = np.random.default_rng((seed, epoch))
        for first in range(0, len(order), size):
            chosen = order[first : first + size]
            moves = chance.integers(-SHIFT, SHIFT + 1, (len(chosen), 2))
            yield shift_images(images[chosen], moves), labels[chosen]
        epoch += 1


def _tensor(images: NDArray[Any]) -> Any:
    torch = require("torch", extra=EXTRA)
    tensor = torch.from_numpy(images.astype(np.float32))
    return tensor.contiguous(memory_format=torch.channels_last)


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
