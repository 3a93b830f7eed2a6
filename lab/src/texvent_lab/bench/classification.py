"""N-ImageNet's published classifier, ResNet-34, and the share of streams that it recognises."""

from __future__ import annotations

import importlib
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.events import EventStream
from texvent.extending import require
from texvent.io.arrays.n_imagenet import load_stream
from texvent.io.files import event_extensions
from texvent.networks.weight_files import read_mapping, shapes_of, state_tensors, trained_with
from texvent.represent.event_frame import binary_event_image
from texvent_lab.bench.jobs import Progress, no_progress
from texvent_lab.networks import EXTRA

REPRESENTATION, CHANNELS, STAGES = "binary-event-image", 2, 4
WHERE_FROM = (
    "the published classifiers are linked from the project 82magnolia/n_imagenet on GitHub; this "
    "one is ResNet34 on binary event images (reshape_then_flat_pol)"
)


def read_resnet(path: Path) -> ResNetClassifier:
    """The classifier with the weights of a published checkpoint, or from its tensors alone.

    Args:
        path: `{"state_dict": ...}` as N-ImageNet's program saves it, `{name: tensor}`, or
            `.safetensors`.

    Raises:
        InputError: there is no such file.
        FileFormatError: the file is damaged, or a tensor is missing, unknown or of another shape.
        MissingDependencyError: torch is not installed.
    """
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
    # Loaded here: they need torch, and the rest of this module does not.
    layers: Any = importlib.import_module("texvent_lab.networks.layers")
    resnet34: Any = importlib.import_module("texvent_lab.networks.resnet34")
    content = read_mapping(path, WHERE_FROM, extra=EXTRA)
    shown_to_it = trained_with(content, "network").get("representation", REPRESENTATION)
    if shown_to_it != REPRESENTATION:
        raise FileFormatError(
            f"{path} was trained on {shown_to_it}, and this benchmark shows {REPRESENTATION}; use "
            "texvent evaluate classification"
        )
    tensors = state_tensors(content, path, WHERE_FROM, extra=EXTRA)
    shapes = shapes_of(tensors)
    for name, dimensions in (("conv1.weight", 4), ("fc.weight", 2)):
        if len(shapes.get(name, ())) != dimensions:
            raise FileFormatError(f"{path} has no usable {name}: it is no ResNet; {WHERE_FROM}")
    blocks: list[int] = []
    while count := layers.count_blocks(shapes, f"layer{len(blocks) + 1}"):
        blocks.append(count)
    if len(blocks) < STAGES:
        raise FileFormatError(
            f"{path} has no layer{len(blocks) + 1}: it is no ResNet; {WHERE_FROM}"
        )
    width, classes = shapes["conv1.weight"][0], shapes["fc.weight"][0]
    network = resnet34.ResNet(CHANNELS, classes, width=width, blocks=tuple(blocks))
    network.read(tensors, path, WHERE_FROM)
    return ResNetClassifier(network.eval())


class ResNetClassifier:
    """Scores of images by a network with fixed weights, on the CPU.

    An accuracy must not depend on the machine.
    """

    def __init__(self, network: Any) -> None:
        """A classifier from a `ResNet` in evaluation mode."""
        self.network = network

    @property
    def class_count(self) -> int:
        """Number of classes."""
        return int(self.network.fc.out_features)

    def __call__(self, images: NDArray[np.float32]) -> NDArray[np.float32]:
        """Scores, higher is likelier.

        Args:
            images: [n, 2, H, W] float32 binary event images, ON first.

        Returns:
            [n, classes] float32.
        """
        torch = require("torch", extra=EXTRA)
        with torch.inference_mode():
            return np.asarray(self.network(torch.from_numpy(images)).numpy())


Classifier: TypeAlias = Callable[[NDArray[np.float32]], NDArray[np.float32]]
"""[n, 2, 224, 224] binary event images → [n, classes] scores."""

SLICE_EVENTS = 30_000
IMAGE_SIZE = (224, 224)
BATCH = 16
TOP = 5


@dataclass(frozen=True)
class Sample:
    """One event file and what it shows."""

    path: Path
    label: int


@dataclass(frozen=True)
class Accuracy:
    """How many streams were recognised."""

    count: int
    top1: float
    """Share whose likeliest class is the right one."""
    top5: float
    """Share whose five likeliest classes hold the right one."""

    @property
    def standard_errors(self) -> tuple[float, float]:
        """Of both shares, from the number of streams."""
        return binomial_error(self.top1, self.count), binomial_error(self.top5, self.count)


def list_samples(folder: Path, class_count: int, *, classes: Path | None = None) -> list[Sample]:
    """Event files by class: one sub-folder per class, named as in N-ImageNet (n01440764 ...).

    Args:
        folder: holds the sub-folders.
        class_count: classes that the network tells apart.
        classes: text file with one class per line in the network's order; without it, the
            sub-folders in order of their names must be all classes.

    Raises:
        InputError: there is no such folder, no event file, or the classes do not fit.
    """
    if not folder.is_dir():
        raise InputError(f"there is no folder {folder}")
    found = sorted(one.name for one in folder.iterdir() if one.is_dir())
    names = found if classes is None else _read_classes(classes)
    if len(names) != class_count:
        where = f"{classes} names" if classes else f"{folder} has"
        raise InputError(
            f"{where} {len(names)} classes, the network tells {class_count} apart; give --classes "
            "FILE with one name per line in the network's order"
        )
    unknown = set(found) - set(names)
    if unknown:
        raise InputError(f"{folder} has a class {min(unknown)!r} that {classes} does not name")
    number = {name: index for index, name in enumerate(names)}
    extensions = event_extensions()
    samples = [
        Sample(path, number[name])
        for name in found
        for path in sorted((folder / name).iterdir())
        if path.suffix.lower() in extensions
    ]
    if not samples:
        raise InputError(f"{folder} holds no event file in its sub-folders")
    return samples


def classify(
    samples: Sequence[Sample],
    classifier: Classifier,
    *,
    seed: int = 0,
    progress: Progress = no_progress,
) -> Accuracy:
    """Accuracy over the samples.

    Args:
        samples: see `list_samples`.
        classifier: see `ResNetClassifier`.
        seed: decides which events of each file are taken.
        progress: told of progress.

    Raises:
        InputError, FileFormatError: a file cannot be read.
        ConfigError: there is no sample.
    """
    if not samples:
        raise ConfigError("there is nothing to classify; give at least one event file")
    ranks: list[int] = []
    for labels, images in _batches(samples, seed):
        scores = classifier(images)
        right = scores[np.arange(len(labels)), labels]
        ranks.extend((scores > right[:, None]).sum(axis=1).tolist())
        progress(f"{len(ranks)} of {len(samples)}")
    place = np.asarray(ranks)
    return Accuracy(len(place), float((place < 1).mean()), float((place < TOP).mean()))


def take_slice(events: EventStream, seed: int, index: int) -> EventStream:
    """A random run of 30,000 events, or all if there are no more."""
    spare = len(events) - SLICE_EVENTS
    if spare <= 0:
        return events
    first = int(np.random.default_rng((seed, index)).integers(spare + 1))
    return events[first : first + SLICE_EVENTS]


def _batches(
    samples: Sequence[Sample], seed: int
) -> Iterator[tuple[NDArray[np.int64], NDArray[np.float32]]]:
    for first in range(0, len(samples), BATCH):
        chosen = samples[first : first + BATCH]
        images = [_image(sample.path, seed, first + number) for number, sample in enumerate(chosen)]
        yield np.array([sample.label for sample in chosen]), np.stack(images)


def _image(path: Path, seed: int, index: int) -> NDArray[np.float32]:
    image = binary_event_image(take_slice(load_stream(path), seed, index), size=IMAGE_SIZE)
    return np.asarray(image, np.float32)


def _read_classes(path: Path) -> list[str]:
    try:
        words = [line.split() for line in StringIO(path.read_text(encoding="utf-8"))]
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror or error}") from error
    return [line[0] for line in words if line]


def binomial_error(share: float, count: int) -> float:
    """Standard error of a share of so many samples."""
    return math.sqrt(share * (1 - share) / count)
