"""Classification of recordings: labelled events → class."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.errors import FileFormatError, InputError, shown
from texvent.extending import require
from texvent.networks import Tensor, read_mapping, state_tensors, trained_with
from texvent.options.values import plain
from texvent.represent.named import represent_window
from texvent.settings.provenance import fingerprint
from texvent.transform.edits import resize
from texvent_lab.networks.layers import Network, make_seeded
from texvent_lab.networks.resnet34 import ResNet
from texvent_lab.networks.torchvision_models import TorchvisionModel
from texvent_lab.train.classification.config import PREFIX, Augmentation, ClassificationConfig
from texvent_lab.train.classification.samples import (
    ChosenSamples,
    augment,
    open_training,
    open_validation,
    take_run,
)
from texvent_lab.train.loop import STANDARD_ERROR, VALIDATION_SAMPLES
from texvent_lab.train.schedule import EXTRA
from texvent_lab.train.task import Batches

SMALL_WIDTH, STAGES = 16, 3
LAST_LAYERS = tuple(
    f"{layer}.{kind}"
    for layer in ("linear", "fc", "heads.head", "classifier.1")
    for kind in ("weight", "bias")
)
"""Tensors whose shapes depend on the number of classes."""


class SmallCnn(Network):
    """Three convolutions of 3×3 with normalisation, two of them halved, a mean, a linear layer."""

    def __init__(self, channels: int, classes: int, *, width: int = SMALL_WIDTH) -> None:
        """Random weights.

        Args:
            channels: of the input, [n, channels, H, W].
            classes: scores that come out, [n, classes].
            width: channels after the first convolution; 16 makes 24,000 parameters.
        """
        super().__init__()
        nn = require("torch.nn", extra=EXTRA)
        before = channels
        for number in range(STAGES):
            after = width << number
            setattr(self, f"conv{number}", nn.Conv2d(before, after, 3, padding=1, bias=False))
            setattr(self, f"norm{number}", nn.BatchNorm2d(after))
            before = after
        self.linear = nn.Linear(before, classes)

    def forward(self, x: Tensor) -> Tensor:
        """One score per class."""
        for number in range(STAGES):
            x = getattr(self, f"norm{number}")(getattr(self, f"conv{number}")(x)).relu()
            if number < STAGES - 1:
                x = require("torch", extra=EXTRA).nn.functional.max_pool2d(x, 2)
        return self.linear(x.mean(dim=(2, 3)))


NETWORKS: Mapping[str, Callable[..., Network]] = {"small-cnn": SmallCnn, "resnet34": ResNet}


IMAGE, CLASS, CLASSES = "image", "class_number", "classes"
NO_AUGMENTATION = Augmentation(shift=0)
TOP = 5
WHERE_FROM = "texvent train classification writes it as weights.pt"
"""Origin of a weights file, for messages."""


class ClassificationTask:
    """Cross entropy, scored by the share of validation samples that are recognised."""

    score: ClassVar[str] = "accuracy"

    def __init__(self, config: ClassificationConfig) -> None:
        """Open the validation samples.

        Raises:
            InputError, ConfigError, FileFormatError: the data does not fit; the message says why.
        """
        self._config = config
        self._validation = open_validation(config)
        self._classes = list(self._validation.labels)
        examples = self._examples(self._validation)
        self._shape = examples(0, np.random.default_rng(0))[IMAGE].shape

    @property
    def identity(self) -> str:
        """See `TrainingTask`."""
        begin = self._config.start_from
        weights = [] if begin is None else [f"from {str(fingerprint(str(begin)))[:12]}"]
        return ", ".join([self._examples(self._validation).identity, *weights])

    def make_network(self) -> Any:
        """See `TrainingTask`."""
        wanted = self._config.network
        channels, *shape = self._shape
        kind, given = NETWORKS.get(wanted.name), {}
        if kind is None:
            kind, given = (
                TorchvisionModel,
                {"name": wanted.name.removeprefix(PREFIX), "shape": shape},
            )
        elif wanted.width is not None:
            given = {"width": wanted.width}
        make = functools.partial(kind, channels, len(self._classes), **given)
        network = make_seeded(make, self._config.seed)
        if self._config.start_from is not None:
            self._begin_with(network, self._config.start_from)
        return network

    def batches(self, *, workers: int) -> Batches:
        """See `TrainingTask`."""
        samples = open_training(self._config, self._validation)
        return self._batches(samples, self._config.augmentation, workers, shuffle=True)

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """See `TrainingTask`."""
        return _cross_entropy(network(batch[IMAGE].to(device)), batch[CLASS].to(device))

    def validate(
        self, network: Any, device: Any, *, workers: int
    ) -> tuple[dict[str, float], dict[str, list[Any]]]:
        """Accuracies with standard errors, number of samples, mean cross entropy; predictions.

        Returns:
            Columns of the predictions: `sample`; `class` and `predicted`, places in the list of
            classes; `rank`: how many classes are likelier than the right one; `loss`: cross
            entropy.
        """
        samples = self._validation
        found: dict[str, list[Any]] = {"predicted": [], "rank": [], "loss": []}
        for batch in self._batches(samples, NO_AUGMENTATION, workers, shuffle=False).epoch(0):
            scores, classes = network(batch[IMAGE].to(device)), batch[CLASS].to(device)
            found["predicted"] += scores.argmax(dim=1).tolist()
            found["rank"] += _ranks(scores, classes).tolist()
            found["loss"] += _cross_entropy(scores, classes, reduction="none").tolist()
        titles = [samples.title(place) for place in range(len(samples))]
        columns = {"sample": titles, "class": samples.class_number.tolist(), **found}
        return self._scores(columns), columns

    def _scores(self, predictions: Mapping[str, Sequence[Any]]) -> dict[str, float]:
        ranks = np.array(predictions["rank"])
        shares = {"accuracy": float((ranks < 1).mean())}
        if len(self._classes) > TOP:
            shares[f"top-{TOP} accuracy"] = float((ranks < TOP).mean())
        scores = {}
        for name, share in shares.items():
            scores[name] = share
            scores[f"{name}{STANDARD_ERROR}"] = math.sqrt(share * (1 - share) / len(ranks))
        scores[VALIDATION_SAMPLES] = len(ranks)
        return {**scores, "validation loss": float(np.mean(predictions["loss"]))}

    def published(self, network: Any) -> Mapping[str, Any]:
        """See `TrainingTask`."""
        tensors = {name: one.detach().cpu() for name, one in network.tensors.items()}
        return {"state_dict": tensors, CLASSES: self._classes}

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """See `TrainingTask`."""
        known = content.get(CLASSES, self._classes)
        if known != self._classes:
            raise FileFormatError(
                f"{path} tells apart the classes {shown(known)}, and the samples have "
                f"{shown(self._classes)}; they must be equal, in the same order"
            )
        told, own = trained_with(content, "network"), plain(self._config.network)
        for name in ("representation", "representation_options"):
            if told.get(name, own[name]) != own[name]:
                raise FileFormatError(
                    f"{path} was trained with {name} {shown(told[name])}, and [network] has "
                    f"{shown(own[name])}; they must be equal"
                )
        network.read(content, path, WHERE_FROM)

    def _begin_with(self, network: Any, path: Path) -> None:
        """Take over weights, but for the last layer of other classes.

        Raises:
            InputError: there is no such file.
            FileFormatError: they are of another network.
        """
        if not path.is_file():
            raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
        content = read_mapping(path, WHERE_FROM, extra=EXTRA)
        found = state_tensors(content, path, WHERE_FROM, extra=EXTRA)
        if content.get(CLASSES, self._classes) != self._classes:
            own = network.tensors
            found |= {name: own[name] for name in LAST_LAYERS if name in own}
        network.read(found, path, WHERE_FROM)

    def _batches(
        self, samples: ChosenSamples, augmentation: Augmentation, workers: int, *, shuffle: bool
    ) -> Batches:
        return Batches(
            make=self._examples(samples, augmentation),
            count=len(samples),
            batch_size=self._config.schedule.batch_size,
            seed=self._config.seed,
            shuffle=shuffle,
            workers=workers,
        )

    def _examples(
        self, samples: ChosenSamples, augmentation: Augmentation = NO_AUGMENTATION
    ) -> ClassExamples:
        return ClassExamples(samples, self._config, augmentation)


@dataclass(frozen=True)
class ClassExamples:
    """Images and classes of samples, by number."""

    samples: ChosenSamples
    config: ClassificationConfig
    augmentation: Augmentation

    @property
    def identity(self) -> str:
        """See `MakeSample`."""
        return ", ".join(source.identity for source in self.samples.sources)

    def __call__(self, number: int, chance: np.random.Generator) -> Mapping[str, Any]:
        """The image and the class of a sample; without events, an image of zeros."""
        network, data = self.config.network, self.config.data
        events = take_run(self.samples.events(number), data.slice_events, chance)
        if data.image_size is not None:
            events = resize(events, data.image_size)
        events = augment(events, self.augmentation, chance)
        window = (int(events.t[0]), int(events.t[-1]) + 1) if len(events) else (0, 1)
        image = represent_window(
            network.representation, events, window, **network.representation_options
        )
        image = np.asarray(image, np.float32)
        image = image.reshape(-1, *image.shape[-2:])
        return {IMAGE: image, CLASS: int(self.samples.class_number[number])}


def _cross_entropy(scores: Tensor, classes: Tensor, *, reduction: str = "mean") -> Tensor:
    functional = require("torch", extra=EXTRA).nn.functional
    return functional.cross_entropy(scores, classes, reduction=reduction)


def _ranks(scores: Tensor, classes: Tensor) -> Tensor:
    """Number of classes before the right one, [n]; of equal scores, the first class comes first."""
    torch = require("torch", extra=EXTRA)
    right = scores.gather(1, classes[:, None])
    is_first = torch.arange(scores.shape[1], device=scores.device) < classes[:, None]
    # A network that gives no numbers recognises nothing.
    is_before = (scores > right) | ((scores == right) & is_first) | right.isnan()
    return is_before.sum(dim=1)
