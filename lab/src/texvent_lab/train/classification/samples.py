"""The labelled samples of a training: sources opened, checked, chosen and put together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError, shown
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.transform.edits import flip, reverse_time, shift, start_at_zero
from texvent_lab.train.classification.config import (
    Augmentation,
    ClassificationConfig,
    LabelledSource,
)
from texvent_lab.train.classification.sources import DataSetSamples, RecordedSamples


def augment(
    events: EventStream, augmentation: Augmentation, chance: np.random.Generator
) -> EventStream:
    """A copy that is reversed, mirrored and shifted as chance decides.

    Source: the program of J. Kim et al., "N-ImageNet", ICCV 2021 (its shift is 20 px).
    """
    flips_time, flips_x = chance.random(2) < 0.5
    dx, dy = chance.integers(-augmentation.shift, augmentation.shift + 1, 2)
    if augmentation.flip_time and flips_time:
        events = start_at_zero(reverse_time(events))
    if augmentation.flip_x and flips_x:
        events = flip(events, "x")
    return shift(events, int(dx), int(dy))


def take_run(events: EventStream, count: int | None, chance: np.random.Generator) -> EventStream:
    """A random run of so many events, or all if there are no more."""
    if count is None or len(events) <= count:
        return events
    first = int(chance.integers(len(events) - count + 1))
    return events[first : first + count]


_CHOICE = 2
"""Tells the draws of `per_class` from others of one seed."""


class LabelledSamples(Protocol):
    """A split of one source; picklable, read by number from any process."""

    name: str
    """Name of the split, for messages."""
    labels: tuple[str, ...]
    """Names of the classes."""
    identity: str
    """Identity of the samples; other ones have another."""

    def __len__(self) -> int:
        """Number of samples."""
        ...

    def class_number(self, number: int) -> int:
        """Place of the class of a sample in `labels`; −1 without a class."""
        ...

    def events(self, number: int) -> EventStream:
        """The events of a sample.

        Raises:
            TexventError: it cannot be read or made; the message names it.
        """
        ...

    def sizes(self) -> Mapping[str, SensorSize]:
        """Title → size of samples, at least of one: those that are known without reading all."""
        ...

    def title(self, number: int) -> str:
        """Name of a sample in messages."""
        ...


@dataclass(frozen=True, kw_only=True, eq=False)
class ChosenSamples:
    """Samples of several sources, one source after another."""

    sources: tuple[LabelledSamples, ...]
    labels: tuple[str, ...]
    """Names of the classes."""
    source: NDArray[np.int64]
    """[n] the source of each sample."""
    number: NDArray[np.int64]
    """[n] its number there."""
    class_number: NDArray[np.int64]
    """[n] place of its class in `labels`."""
    size: SensorSize | None
    """Size of all samples; None: they are scaled."""

    def __len__(self) -> int:
        """Number of samples."""
        return len(self.number)

    def events(self, place: int) -> EventStream:
        """The events of a sample.

        Raises:
            InputError: they are of another sensor than the first sample.
            TexventError: they cannot be read or made.
        """
        source, number = self._at(place)
        events = source.events(number)
        if self.size is not None and self.size != events.size:
            raise _other_size(source.title(number), events.size, self.size)
        return events

    def title(self, place: int) -> str:
        """Name of a sample."""
        source, number = self._at(place)
        return source.title(number)

    def _at(self, place: int) -> tuple[LabelledSamples, int]:
        return self.sources[int(self.source[place])], int(self.number[place])


def open_validation(config: ClassificationConfig) -> ChosenSamples:
    """The samples that are scored.

    Raises:
        InputError, ConfigError, FileFormatError: they do not fit; the message says why.
    """
    data = config.data
    samples = _open(data, data.validation_split)
    labels = samples.labels[: data.classes]
    if len(labels) < 2:
        raise InputError(
            f"{samples.name} has {len(labels)} classes, and a network tells at least 2 apart; give "
            "its samples labels"
        )
    if data.classes is not None and len(labels) < data.classes:
        raise InputError(f"classes is {data.classes}; {samples.name} has {len(labels)}")
    return _join((samples,), labels, config)


def open_training(config: ClassificationConfig, validation: ChosenSamples) -> ChosenSamples:
    """The samples that are trained on, with those of `extra`.

    Args:
        config: of the training.
        validation: see `open_validation`; classes and size must be equal.

    Raises:
        InputError, ConfigError, FileFormatError: they do not fit; the message says why.
    """
    given = [one for one in (config.data, config.extra) if one.is_given]
    sources = tuple(_open(source, source.split) for source in given)
    known = validation.sources[0]
    for source in sources:
        shown_there = {source.labels[source.class_number(one)] for one in range(len(source))}
        other = sorted(shown_there - {*known.labels})
        if other:
            raise InputError(
                f"{source.name} has samples of class {shown(other[0])}, which {known.name} has not"
            )
    chosen = _join(sources, validation.labels, config, [one.per_class for one in given])
    unseen = np.setdiff1d(validation.class_number, chosen.class_number)
    if len(unseen):
        raise InputError(
            f"{known.name} has samples of class {shown(validation.labels[unseen[0]])}, and "
            f"{sources[0].name} has none to train on"
        )
    if validation.size != chosen.size:
        raise InputError(
            f"samples to train on have {chosen.size}, those of {known.name} {validation.size}; "
            'give image_size, such as "64x48", to scale all of them'
        )
    return chosen


def _open(source: LabelledSource, split: str) -> LabelledSamples:
    samples: LabelledSamples
    if source.folder is not None:
        samples = DataSetSamples(source, split)
    elif source.recordings is not None:
        samples = RecordedSamples(source, split)
    else:
        raise ConfigError("there are no samples to train on; give folder or recordings in [data]")
    unlabelled = [number for number in range(len(samples)) if samples.class_number(number) < 0]
    if unlabelled:
        raise InputError(
            f"{len(unlabelled):,} of {len(samples):,} samples of {samples.name} have no class, "
            f"such as {samples.title(unlabelled[0])}; give all sources a label"
        )
    return samples


def _join(
    sources: tuple[LabelledSamples, ...],
    labels: Sequence[str],
    config: ClassificationConfig,
    per_class: Sequence[int | None] = (None,),
) -> ChosenSamples:
    """The samples of these classes, so many of each."""
    places = {label: place for place, label in enumerate(labels)}
    parts = []
    for number, (source, count) in enumerate(zip(sources, per_class, strict=True)):
        classes = [source.labels[source.class_number(one)] for one in range(len(source))]
        class_number = np.array([places.get(label, -1) for label in classes], np.int64)
        chance = np.random.default_rng((config.seed, _CHOICE, number))
        kept = _choose(class_number, count, chance)
        parts.append(np.stack([np.full(len(kept), number), kept, class_number[kept]]))
    source_number, number_there, classes_there = np.concatenate(parts, axis=1)
    if not len(number_there):
        raise InputError(f"{sources[0].name} holds no sample of {shown(list(labels))}")
    return ChosenSamples(
        sources=sources,
        labels=tuple(labels),
        source=source_number,
        number=number_there,
        class_number=classes_there,
        size=None if config.data.image_size is not None else _common_size(sources),
    )


def _choose(
    class_number: NDArray[np.int64], count: int | None, chance: np.random.Generator
) -> NDArray[np.int64]:
    """Numbers of the samples that have a class; of each class so many, or all, by chance."""
    numbers = np.flatnonzero(class_number >= 0)
    if count is None:
        return numbers
    shuffled = chance.permutation(numbers)
    kept = [shuffled[class_number[shuffled] == one][:count] for one in np.unique(class_number)]
    return np.sort(np.concatenate(kept)) if kept else numbers


def _common_size(sources: Sequence[LabelledSamples]) -> SensorSize:
    """The size of all samples, as far as it is known.

    Raises:
        InputError: they have several.
    """
    sizes = {title: size for source in sources for title, size in source.sizes().items()}
    common = next(iter(sizes.values()))
    for title, size in sizes.items():
        if size != common:
            raise _other_size(title, size, common)
    return common


def _other_size(title: str, size: SensorSize, expected: SensorSize) -> InputError:
    return InputError(
        f"{title} has {size}, others {expected}; give image_size, such as "
        f'"{expected}", to scale all of them'
    )
