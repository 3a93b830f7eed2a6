"""Classification of recordings: labelled events → class."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent._require import require
from texvent.dataset.loading.open_samples import open
from texvent.dataset.loading.stored_samples import StoredSamples
from texvent.errors import FileFormatError, InputError, shown
from texvent.events import EventStream
from texvent.networks.weight_files import Tensor
from texvent.represent.named import represent_window
from texvent.train.batches import Batches
from texvent.train.classification.augmentation import augment
from texvent.train.classification.config import Augmentation, ClassificationConfig
from texvent.train.classification.small_cnn import small_cnn
from texvent.train.schedule import EXTRA
from texvent.train.task import Score

IMAGE, CLASS, CLASSES = "image", "class_number", "classes"
NO_AUGMENTATION = Augmentation(shift=0)


class ClassificationTask:
    """Cross entropy, scored by the share of validation samples that are recognised."""

    score: ClassVar[Score] = Score("accuracy", is_higher_better=True)

    def __init__(self, config: ClassificationConfig) -> None:
        """Open the validation samples.

        Raises:
            InputError, ConfigError, FileFormatError: the data does not fit; the message says why.
        """
        self._config = config
        self._validation = _open(config, config.data.validation_split)
        self._classes = list(self._validation.labels)
        examples = self._examples(self._validation)
        self._channels = len(examples(0, np.random.default_rng(0))[IMAGE])

    def make_network(self) -> Any:
        """See `Task`."""
        return small_cnn(self._channels, len(self._classes), self._config.seed)

    def batches(self, *, workers: int) -> Batches:
        """See `Task`."""
        samples = _open(self._config, self._config.data.split)
        return self._batches(samples, self._config.augmentation, workers, shuffle=True)

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """See `Task`."""
        functional = require("torch", extra=EXTRA).nn.functional
        return functional.cross_entropy(network(batch[IMAGE].to(device)), batch[CLASS].to(device))

    def validate(self, network: Any, device: Any, *, workers: int) -> dict[str, float]:
        """Accuracy and mean loss."""
        right = loss = 0.0
        batches = self._batches(self._validation, NO_AUGMENTATION, workers, shuffle=False)
        for batch in batches.epoch(0):
            scores, classes = network(batch[IMAGE].to(device)), batch[CLASS].to(device)
            right += float((scores.argmax(dim=1) == classes).sum())
            loss += float(self.loss(network, batch, device)) * len(classes)
        count = len(self._validation)
        return {"accuracy": right / count, "validation loss": loss / count}

    def published(self, network: Any) -> Mapping[str, Any]:
        """See `Task`."""
        tensors = {name: one.detach().cpu() for name, one in network.tensors.items()}
        return {"state_dict": tensors, CLASSES: self._classes}

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """See `Task`."""
        known = content.get(CLASSES, self._classes)
        if known != self._classes:
            raise FileFormatError(
                f"{path} tells apart the classes {shown(known)}, and the samples have "
                f"{shown(self._classes)}; they must be equal, in the same order"
            )
        network.read(content, path, "texvent train classification writes it as weights.pt")

    def _batches(
        self, samples: StoredSamples, augmentation: Augmentation, workers: int, *, shuffle: bool
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
        self, samples: StoredSamples, augmentation: Augmentation = NO_AUGMENTATION
    ) -> ClassExamples:
        return ClassExamples(samples, self._config, augmentation)


@dataclass(frozen=True)
class ClassExamples:
    """Images and classes of samples, by number."""

    samples: StoredSamples
    config: ClassificationConfig
    augmentation: Augmentation

    def __call__(self, number: int, chance: np.random.Generator) -> Mapping[str, Any]:
        """The image and the class of a sample."""
        network, samples = self.config.network, self.samples
        events = take_run(samples.events(number), self.config.data.slice_events, chance)
        events = augment(events, self.augmentation, chance)
        window = (int(events.t[0]), int(events.t[-1]) + 1) if len(events) else (0, 1)
        image = represent_window(
            network.representation, events, window, **network.representation_options
        )
        image = np.asarray(image, np.float32)
        image = image.reshape(-1, *image.shape[-2:])
        return {IMAGE: image, CLASS: samples.class_number(number)}


def take_run(events: EventStream, count: int | None, chance: np.random.Generator) -> EventStream:
    """A random run of so many events, or all if there are no more."""
    if count is None or len(events) <= count:
        return events
    first = int(chance.integers(len(events) - count + 1))
    return events[first : first + count]


def _open(config: ClassificationConfig, split: str) -> StoredSamples:
    data = config.data
    samples = open(data.folder, variant=data.variant, split=split)
    if not samples.labels:
        raise InputError(f"{data.folder} has no classes; give its sources a label")
    unlabelled = sum(samples.class_number(number) < 0 for number in range(len(samples)))
    if unlabelled:
        raise InputError(f"{unlabelled} samples of split {split} of {data.folder} have no class")
    return samples
