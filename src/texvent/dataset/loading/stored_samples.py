"""The samples of a data set, read by number."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from texvent.config import check_range
from texvent.dataset.generation.shards import read_members
from texvent.dataset.loading.index import MEMBERS, Choice, Index, choose, read_index
from texvent.dataset.loading.targets import check_targets, targets_of
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.reading.stored_events import read_columns, sample_facts, sample_truth
from texvent.errors import ConfigError, FileFormatError, InputError, shown
from texvent.events import EventStream
from texvent.represent.named import load_representation, represent_window
from texvent.sensor import SensorSize
from texvent.truth.clip import ClipTruth

NO_CLASS = -1
Window: TypeAlias = tuple[int, int]
"""Start (included) and end (excluded), µs."""
Augmentation: TypeAlias = Callable[[EventStream, np.random.Generator], EventStream]
"""Gives a changed copy of events, by draws of the generator alone."""


def open(
    folder: str | Path,
    *,
    variant: Choice = None,
    split: Choice = None,
    label: Choice = None,
    representation: str | None = None,
    representation_options: Mapping[str, Any] | None = None,
    slice_us: int | None = None,
    slice_events: int | None = None,
) -> StoredSamples:
    """A data set that `texvent dataset make` made, or as much of it as is made.

    Args:
        folder: of the data set.
        variant: only this one, or these; None: all.
        split: only this one, or these; None: all.
        label: only this class, or these; None: all.
        representation: what `make` gives; see `StoredSamples`.
        representation_options: its options, such as `{"bins": 10}`.
        slice_us: length of a slice, µs.
        slice_events: or its number of events.

    Raises:
        InputError: no such folder, it holds no sample, or a sample is shorter than a slice.
        FileFormatError: a shard is missing, has another size, or its record is damaged.
        ConfigError: no such variant, split or label; an unknown representation or option.

    Example: `samples = open("cars", split="train"); samples[0].events`.
    """
    folder = Path(folder)
    index = read_index(folder, variant=variant, split=split)
    # Of the whole set, so that the numbers of classes do not depend on what is chosen of it.
    labels = StoredDataset.open(folder).labels
    if label is not None:
        chosen = choose("label", label, labels)
        places = [place for place, one in enumerate(index.labels) if one in chosen]
        index = index.select(np.flatnonzero(np.isin(index.label, places)))
        if not len(index):
            raise InputError(f"{folder} holds no sample of {shown(label)} in what was chosen of it")
    return StoredSamples(
        folder=folder,
        index=index,
        labels=labels,
        representation=representation,
        representation_options=representation_options or {},
        slice_us=slice_us,
        slice_events=slice_events,
    )


@dataclass(frozen=True, eq=False)
class StoredSample:
    """All that a data set holds of one sample."""

    key: str
    events: EventStream
    """With `facts` as metadata."""
    caption: str | None
    """Its prompt."""
    label: str | None
    """Its class."""
    class_number: int
    """Place of the class in `StoredSamples.labels`; −1 without a class."""
    variant: str
    split: str
    facts: Mapping[str, Any] = field(repr=False)
    """Provenance: prompt, settings, seed, versions."""
    truth: ClipTruth
    """Boxes, flow, depth, ids and poses, as far as the data set stores them."""


@dataclass(frozen=True, kw_only=True, eq=False)
class StoredSamples:
    """A table of samples that were made, in the order of their files.

    `texvent.dataset.open` makes one. Reading by number takes one read of the shard, from any
    number of threads or processes.

    Raises:
        ConfigError: an unknown representation or option, or two kinds of slices.
        InputError: a sample is shorter than one slice.
    """

    folder: Path
    """Folder of the data set."""
    index: Index
    """Facts of each sample, known without reading it: `index.events`, `index.duration_us` and
    others."""
    labels: tuple[str, ...]
    """All classes of the data set; a sample's class number is its place here."""
    representation: str | None = None
    """As `SimulatedSamples.representation`; None: the events themselves."""
    representation_options: Mapping[str, Any] = field(default_factory=dict)
    """As `SimulatedSamples.representation_options`."""
    slice_us: int | None = None
    """As `SimulatedSamples.slice_us`."""
    slice_events: int | None = None
    """Events per slice, instead of `slice_us`; a sample gives as many whole slices as it has."""
    targets: tuple[str, ...] = ()
    """Ground truth that `make` gives too: boxes, flow, depth."""
    augment: Augmentation | None = None
    """Changes the events of `make`, before they are sliced."""
    augment_seed: int = 0
    """Decides, with the epoch and the sample's number, what the generator of `augment` draws."""

    def __repr__(self) -> str:
        given = f", {self.representation}" if self.representation else ""
        return f"StoredSamples({len(self):,} of {self.folder}, {len(self.labels)} classes{given})"

    def __post_init__(self) -> None:
        check_range("slice_us", self.slice_us, 1)
        check_range("slice_events", self.slice_events, 1)
        if self.slice_us is not None and self.slice_events is not None:
            raise ConfigError("give either slice_us or slice_events, the length of a slice")
        if self.representation is not None:
            for size in np.unique(self.index.size, axis=0).tolist():
                check_representation(
                    self.representation, self.representation_options, SensorSize(*size)
                )
        elif self.representation_options:
            raise ConfigError("representation_options belong to a representation; name it")
        self._refuse_short()
        check_targets(self.targets, self.index, has_augment=self.augment is not None)

    def __len__(self) -> int:
        """Number of samples."""
        return len(self.index)

    def __iter__(self) -> Iterator[StoredSample]:
        """All samples in order."""
        return (self[number] for number in range(len(self)))

    def __getitem__(self, number: int) -> StoredSample:
        """All of a sample; `make` gives what networks take.

        Raises:
            IndexError: there is no such number.
            FileFormatError: its shard is missing, shorter than it was, or damaged.
        """
        number = self._checked(number)
        index, shard = self.index, int(self.index.shard[number])
        content = self.members(number, ("json",)).get("json", b"{}")
        facts = sample_facts(content, f"sample {index.key[number]} of {self._shard(number)}")
        events = self.events(number)
        return StoredSample(
            key=str(index.key[number]),
            events=events.with_metadata(facts),
            caption=index.captions[index.caption[number]],
            label=index.labels[index.label[number]],
            class_number=self.class_number(number),
            variant=index.variants[shard],
            split=index.splits[shard],
            facts=facts,
            truth=self.truth(number),
        )

    def truth(self, number: int) -> ClipTruth:
        """Ground truth of a sample; its arrays are read when they are asked for.

        Raises:
            IndexError, FileFormatError: as for `[number]`.
        """
        number = self._checked(number)
        key = str(self.index.key[number])
        return sample_truth(self._shard(number), key, self._places(number))

    def events(self, number: int) -> EventStream:
        """The events of a sample, without metadata.

        Raises:
            IndexError, FileFormatError: as for `[number]`.
        """
        number = self._checked(number)
        size = SensorSize(*self.index.size[number].tolist())
        key = str(self.index.key[number])
        return read_columns(self._shard(number), key, self._places(number), size)

    def class_number(self, number: int) -> int:
        """Place of the class of a sample in `labels`; −1 without a class."""
        return int(self._class_numbers[self.index.label[self._checked(number)]])

    def members(self, number: int, only: Sequence[str] = MEMBERS) -> dict[str, bytes]:
        """The files of a sample: extension, such as "json" or "png", → content.

        Raises:
            IndexError, FileFormatError: as for `[number]`.
        """
        number = self._checked(number)
        return read_members(self._shard(number), self._places(number), only)

    def make(self, number: int, *, epoch: int = 0) -> dict[str, Any]:
        """Arrays by name for training, as `SimulatedSamples.make`.

        Args:
            number: of the sample.
            epoch: which draws of `augment`.

        Returns:
            With slices, the first two have a first axis for them.

            * `representation`: see its own function. Without one, `events`: an EventStream, or a
              tuple of them, one for each slice.
            * `stop_us`: end of the slice, µs, int64; 1 µs after its last event with `slice_events`.
            * `boxes`: `boxes`, `labels`, `track_ids` and `times`, as
              `texvent.truth.boxes.detection_target` gives them.
            * `flow`: px from frame to frame, [N − 1, 2, H, W] float32; `depth`: m, [N, H, W].
              Targets of slices are tuples: what is of an instant after the start of the slice, up
              to its end; flow counts by its end.
            * `class_number`: place in `labels`; −1 without a class.
            * `caption`: its prompt, "" without one.
            * `key`, `number`, `seed`: of the sample.

        Raises:
            IndexError, FileFormatError: as for `[number]`.
            InputError: `augment` leaves too few events for a slice.
        """
        number = self._checked(number)
        index = self.index
        return {
            **self._arrays(number, epoch),
            "class_number": self.class_number(number),
            "caption": index.captions[index.caption[number]] or "",
            "key": str(index.key[number]),
            "number": number,
            "seed": int(index.seed[number]),
        }

    def select(self, numbers: ArrayLike) -> StoredSamples:
        """The samples of these numbers, in that order, or where a mask is true.

        Example: `samples.select(samples.index.events > 1000)`.
        """
        chosen = np.asarray(numbers)
        chosen = np.flatnonzero(chosen) if chosen.dtype == bool else chosen.astype(np.int64)
        return replace(self, index=self.index.select(chosen))

    def represented(
        self,
        representation: str | None = None,
        *,
        slice_us: int | None = None,
        slice_events: int | None = None,
        **options: Any,
    ) -> StoredSamples:
        """The same samples, which `make` turns into other arrays.

        Args:
            representation: its name; None: the events themselves.
            slice_us: as the field.
            slice_events: as the field.
            **options: of the representation, such as `bins=5`.

        Raises:
            ConfigError, InputError: as for the class.
        """
        return replace(
            self,
            representation=representation,
            representation_options=options,
            slice_us=slice_us,
            slice_events=slice_events,
        )

    def augmented(self, augment: Augmentation | None, *, seed: int = 0) -> StoredSamples:
        """The same samples, whose events `make` changes; None: unchanged.

        What happens to a sample depends on seed, epoch and number alone, in any order and in any
        worker.

        Args:
            augment: function of the events and a generator, such as
                `lambda events, chance: events.flip("x") if chance.random() < 0.5 else events`.
            seed: of the generators, 0 or more.

        Raises:
            ConfigError: the samples have targets, which `augment` would leave behind.
        """
        return replace(self, augment=augment, augment_seed=seed)

    def with_targets(self, *targets: str) -> StoredSamples:
        """The same samples, of which `make` gives ground truth too: boxes, flow, depth.

        Raises:
            ConfigError, InputError: samples do not store it, or `augment` would leave it behind.
        """
        return replace(self, targets=targets)

    @cached_property
    def _class_numbers(self) -> NDArray[np.int64]:
        """Number of each label of the index."""
        numbers = {label: number for number, label in enumerate(self.labels)}
        unknown = sorted({*filter(None, self.index.labels)} - {*numbers})
        if unknown:
            raise FileFormatError(
                f"{self.folder} is damaged: class {shown(unknown[0])} of a sample is none of its "
                "labels; run texvent dataset verify"
            )
        known = [NO_CLASS if label is None else numbers[label] for label in self.index.labels]
        return np.array(known, np.int64)

    def _shard(self, number: int) -> Path:
        return self.folder / self.index.shards[int(self.index.shard[number])]

    def _places(self, number: int) -> dict[str, tuple[int, int]]:
        """Member → position in the shard and bytes."""
        places = zip(MEMBERS, self.index.members[number].tolist(), strict=True)
        return {name: (begin, size) for name, (begin, size) in places if begin >= 0}

    def _checked(self, number: int) -> int:
        if not -len(self) <= number < len(self):
            raise IndexError(f"sample {number} does not exist; there are {len(self)}")
        return int(number) % len(self)

    def _arrays(self, number: int, epoch: int) -> dict[str, Any]:
        slices = list(self._slices(number, epoch))
        parts = [self._part(events, window) for events, window in slices]
        is_sliced = self.slice_us is not None or self.slice_events is not None
        arrays = stack_windows(parts) if is_sliced else parts[0]
        if self.targets:
            windows = [window for _, window in slices] if is_sliced else None
            arrays |= targets_of(self.truth(number), self.targets, windows)
        return arrays

    def _part(self, events: EventStream, window: Window) -> dict[str, Any]:
        stop = {"stop_us": np.int64(window[1])}
        if self.representation is None:
            return {"events": events, **stop}
        name, options = self.representation, self.representation_options
        return {"representation": represent_window(name, events, window, **options), **stop}

    def _slices(self, number: int, epoch: int) -> Iterator[tuple[EventStream, Window]]:
        events = self.events(number)
        if self.augment is not None:
            key = np.random.SeedSequence(self.augment_seed, spawn_key=(epoch, number))
            events = self.augment(events, np.random.default_rng(key))
        if self.slice_events is not None:
            if len(events) < self.slice_events:
                raise InputError(
                    f"augment leaves {len(events):,} events of sample {number}, fewer than a slice "
                    f"of {self.slice_events:,}; drop fewer, give shorter slices, or slice_us"
                )
            for begin in range(0, len(events) - self.slice_events + 1, self.slice_events):
                part = events[begin : begin + self.slice_events]
                yield part, (int(part.t[0]), int(part.t[-1]) + 1)
            return
        duration = int(self.index.duration_us[number])
        start = int(self.index.start_us[number])
        if self.slice_us is None:
            yield events, (start, start + duration)
            return
        for stop in range(start + self.slice_us, start + duration + 1, self.slice_us):
            window = (stop - self.slice_us, stop)
            yield events.cut(*window), window

    def _refuse_short(self) -> None:
        for name, length, known, unit in (
            ("duration_us", self.slice_us, self.index.duration_us, "µs"),
            ("events", self.slice_events, self.index.events, "events"),
        ):
            short = 0 if length is None else int((known < length).sum())
            if short:
                raise InputError(
                    f"{short:,} of {len(self):,} samples are shorter than a slice of {length:,} "
                    f"{unit}, the shortest has {int(known.min()):,}; give shorter slices, or "
                    f"leave samples out: samples.select(samples.index.{name} >= {length})"
                )


def check_representation(name: str, options: Mapping[str, Any], size: SensorSize | None) -> None:
    """Refuse a representation and options that no sample could have.

    Args:
        name: of the representation.
        options: of the representation.
        size: of the sensor; None if it is not known yet.

    Raises:
        ConfigError: an unknown name or option, or a value out of range.
    """
    load_representation(name, options)
    if size is not None:
        represent_window(name, EventStream.empty(size), (0, 1), **options)


def stack_windows(parts: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Arrays by name of several windows, along a first axis of time; others as tuples."""
    columns = {name: [part[name] for part in parts] for name in parts[0]}
    return {
        name: np.stack(one) if isinstance(one[0], np.ndarray | np.generic) else tuple(one)
        for name, one in columns.items()
    }
