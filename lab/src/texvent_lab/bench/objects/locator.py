"""A one-stage detector that finds objects as points: a heat map per class, sizes and offsets.

Source: X. Zhou, D. Wang, P. Krähenbühl, "Objects as Points", 2019 (CenterNet): its loss, and
peaks that are the highest of 3×3 cells. Not its own: the backbone, 121,000 weights here, and the
width of the targets, a sixth of the box.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.extending import require
from texvent.networks import Tensor
from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.digits.training import Precision
from texvent_lab.bench.objects.recorded import SIDE, Frames, in_cells
from texvent_lab.networks.layers import Network, make_seeded
from texvent_lab.train.loop import descend
from texvent_lab.train.schedule import EXTRA, Schedule, epoch_order

_torch: Any = require("torch", extra=EXTRA)
_nn: Any = require("torch.nn", extra=EXTRA)
CELL = 8
"""Pixels along each side of a cell of the heat map."""
PEAKS = 10
"""Detections of a frame."""
SHIFT = 16
"""Largest shift of training frames along each axis, px."""
WEIGHT_OF_SIZE = 0.1
"""Weight of the sizes in the loss, CenterNet's."""
BATCH = 64


def _block(before: int, after: int, stride: int = 1) -> Any:
    convolution = _nn.Conv2d(before, after, 3, stride, 1, bias=False)
    return _nn.Sequential(convolution, _nn.BatchNorm2d(after), _nn.ReLU())


class Locator(Network):
    """Cells [n, 2, H, W] → heat maps' logits, then width, height, x and y of each cell."""

    def __init__(self, classes: int) -> None:
        """Random weights; `classes` heat maps."""
        super().__init__()
        self.fine = _nn.Sequential(_block(2, 24, 2), _block(24, 48, 2), _block(48, 48))
        self.coarse = _nn.Sequential(_block(48, 64, 2), _block(64, 64), _nn.Conv2d(64, 48, 1))
        self.join = _block(48, 48)
        self.head = _nn.Conv2d(48, classes + 4, 1)
        with _torch.no_grad():
            self.head.bias[:classes].fill_(-2.19)  # a peak in a tenth of the cells, as CenterNet

    def forward(self, x: Tensor) -> Tensor:
        """Logits and boxes of each cell, [n, classes + 4, H / 4, W / 4]."""
        fine = self.fine(x)
        raised = _nn.functional.interpolate(self.coarse(fine), size=fine.shape[-2:])
        return self.head(self.join(fine + raised))


def train_locator(
    frames: Frames,
    classes: int,
    *,
    steps: int,
    schedule: Schedule,
    seed: int,
    precision: Precision = "float32",
) -> Any:
    """A detector trained on frames for a number of batches.

    Frames are shifted, mirrored from left to right, and of opposite polarity, by chance.
    """
    _torch.set_num_threads(1)
    network = make_seeded(lambda: Locator(classes), seed).train()
    network.to(memory_format=_torch.channels_last)
    optimizer = schedule.make_optimizer(network)

    def losses() -> Iterator[Tensor]:
        batches = _batches(frames, schedule.batch_size, seed)
        for step, (images, kinds, boxes) in zip(range(steps), batches, strict=False):
            for group in optimizer.param_groups:
                group["lr"] = schedule.learning_rate * (1 - step / steps)
            with _torch.autocast("cpu", _torch.bfloat16, enabled=precision == "bfloat16"):
                found = network(_tensor(images)).float()
            yield _loss(found, kinds, boxes, classes)

    descend(losses(), optimizer, network, where="a detector of objects", schedule=schedule)
    return network.eval()


def _batches(
    frames: Frames, size: int, seed: int
) -> Iterator[tuple[NDArray[Any], NDArray[np.int64], NDArray[np.float32]]]:
    epoch = 0
    while True:
        order = epoch_order(len(frames.images), seed=seed, epoch=epoch)
        chance = np.random.default_rng((seed, epoch))
        for first in range(0, len(order), size):
            chosen = order[first : first + size]
            images, boxes = frames.images[chosen].copy(), frames.boxes[chosen].copy()
            for number, (image, box) in enumerate(zip(images, boxes, strict=True)):
                if chance.random() < 0.5:
                    image = image[:, ::-1]
                    box[0] = SIDE - box[0] - box[2]
                dx, dy = chance.integers(-SHIFT, SHIFT + 1, 2)
                images[number] = shift_image(image, dx, dy) * chance.choice((-1, 1))
                box[:2] += dx, dy
            yield images, frames.classes[chosen], boxes
        epoch += 1


def shift_image(image: NDArray[Any], dx: int, dy: int) -> NDArray[Any]:
    """An image moved by whole pixels, with zeros where nothing came from."""
    padded = np.pad(image, SHIFT)
    height, width = image.shape
    return padded[SHIFT - dy : SHIFT - dy + height, SHIFT - dx : SHIFT - dx + width]


def _loss(
    found: Tensor, kinds: NDArray[np.int64], boxes: NDArray[np.float32], classes: int
) -> Tensor:
    """CenterNet's: a focal loss of peaks, and the absolute error of boxes at their middles."""
    cells = found.shape[-1]
    middle = (boxes[:, :2] + boxes[:, 2:] / 2) / CELL
    place = np.floor(middle).astype(np.int64)
    is_inside = (place >= 0).all(axis=1) & (place < cells).all(axis=1) & np.isfinite(boxes[:, 0])
    y, x = np.mgrid[:cells, :cells]
    heat = np.zeros((len(boxes), classes, cells, cells), np.float32)
    n = np.flatnonzero(is_inside)
    for number in n:
        px, py = place[number]
        deviation = boxes[number, 2:] / CELL / 6
        square = ((x - px) / deviation[0]) ** 2 + ((y - py) / deviation[1]) ** 2
        heat[number, kinds[number]] = np.exp(-square / 2)
    target = _torch.from_numpy(heat)
    chance = _torch.sigmoid(found[:, :classes]).clamp(1e-4, 1 - 1e-4)
    hit = (1 - chance) ** 2 * chance.log() * (target == 1)
    miss = (1 - target) ** 4 * chance**2 * (1 - chance).log() * (target < 1)
    count = max(len(n), 1)
    values = found[n, classes:, place[n, 1], place[n, 0]]
    wanted = np.concatenate([boxes[n, 2:] / CELL, middle[n] - place[n]], axis=1)
    errors = (values - _torch.from_numpy(wanted.astype(np.float32))).abs()
    boxes_loss = WEIGHT_OF_SIZE * errors[:, :2].sum() + errors[:, 2:].sum()
    return (boxes_loss - hit.sum() - miss.sum()) / count


def locate(network: Any, images: NDArray[np.int8], classes: int) -> NDArray[np.void]:
    """Boxes of the highest peaks of each frame, `BOX_RECORD`; `t` is the frame's number."""
    parts = [np.zeros(0, BOX_RECORD)]
    with _torch.inference_mode():
        for first in range(0, len(images), BATCH):
            found = network(_tensor(images[first : first + BATCH]))
            heat = found[:, :classes].sigmoid()
            heat = heat * (_nn.functional.max_pool2d(heat, 3, 1, 1) == heat)
            scores, places = heat.flatten(1).topk(PEAKS)
            parts += [
                _boxes(first + number, found[number, classes:].numpy(), *one)
                for number, one in enumerate(zip(scores.numpy(), places.numpy(), strict=True))
            ]
    return np.concatenate(parts)


def _tensor(images: NDArray[np.int8]) -> Tensor:
    cells = _torch.from_numpy(in_cells(images).astype(np.float32))
    return cells.contiguous(memory_format=_torch.channels_last)


def _boxes(
    number: int, values: NDArray[np.float32], scores: NDArray[np.float32], places: NDArray[np.int64]
) -> NDArray[np.void]:
    kinds, y, x = np.unravel_index(places, (places.max() + 1, *values.shape[1:]))
    width, height, dx, dy = values[:, y, x]
    boxes = np.zeros(len(scores), BOX_RECORD)
    boxes["t"], boxes["class_id"], boxes["class_confidence"] = number, kinds, scores
    boxes["w"], boxes["h"] = np.maximum(width * CELL, 1), np.maximum(height * CELL, 1)
    boxes["x"], boxes["y"] = (x + dx) * CELL - boxes["w"] / 2, (y + dy) * CELL - boxes["h"] / 2
    return boxes
