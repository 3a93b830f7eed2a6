"""Training of a small classifier of digits on images in memory.

A training takes seconds, keeps its last network, and counts steps, not epochs: few samples are
trained on for as long as many.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.extending import require
from texvent.networks import Tensor
from texvent_lab.bench.digits.data import CLASSES
from texvent_lab.train.schedule import EXTRA, Schedule, epoch_order

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
    from texvent_lab.networks.layers import make_seeded
    from texvent_lab.train.classification.task import SmallCnn
    from texvent_lab.train.loop import descend  # these import torch

    torch = require("torch", extra=EXTRA)
    # One thread: equal runs give equal weights, and processes do not share cores.
    torch.set_num_threads(1)
    network = make_seeded(lambda: SmallCnn(images.shape[1], CLASSES), seed)
    network.to(memory_format=torch.channels_last)
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
        order = epoch_order(len(labels), seed=seed, epoch=epoch)
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
