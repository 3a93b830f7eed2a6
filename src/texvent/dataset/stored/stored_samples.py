"""The samples of a data set, read by number."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from texvent.dataset.sample_table import Arrays, SampleTable, Targets, Window
from texvent.dataset.stored.folder import MEMBERS, Choice, Index, StoredDataset, choose, read_index
from texvent.dataset.stored.sample_files import SampleFiles
from texvent.errors import FileFormatError, InputError, shown
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.truth.boxes import detection_target
from texvent.truth.clip import ClipTruth
from texvent.truth.flow_between import FrameFlow
from texvent.truth.layout import CLIP_FILES

NO_CLASS = -1


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
        representation: what `make` gives; see `StoredSamples.represented`.
        representation_options: its options, such as `{"bins": 10}`.
        slice_us: length of a slice, µs.
        slice_events: or its number of events.

    Raises:
        InputError: no such folder, it holds no sample, or a sample is shorter than a slice.
        FileFormatError: a shard is missing, has another size, or its record is damaged.
        ConfigError: no such variant, split or label; an unknown representation or option.

    Example:
        >>> import texvent
        >>> sources = (texvent.dataset.SampleSource(prompts=("a red ball bounces",)),)
        >>> options = {"sensor": "64x48", "duration": 0.2}
        >>> balls = texvent.dataset.Specification(name="balls", sources=sources, options=options)
        >>> work = texvent.dataset.make(balls, "balls", progress=False)
        >>> samples = texvent.dataset.open("balls", representation="voxel-e2vid")
        >>> len(samples), samples.make(0)["representation"].shape
        (1, (5, 48, 64))
    """
    dataset = StoredDataset.open(Path(folder))
    index = read_index(dataset, variant=variant, split=split)
    # Of the whole set, so that the numbers of classes do not depend on what is chosen of it.
    labels = dataset.labels
    if label is not None:
        chosen = choose("label", label, labels)
        places = [place for place, one in enumerate(index.labels) if one in chosen]
        index = index.select(np.flatnonzero(np.isin(index.label, places)))
        if not len(index):
            raise InputError(f"{folder} holds no sample of {shown(label)} in what was chosen of it")
    return StoredSamples(
        folder=dataset.folder,
        index=index,
        labels=labels,
        representation=representation,
        representation_options=representation_options or {},
        slice_us=slice_us,
        slice_events=slice_events,
    )


@dataclass(frozen=True, eq=False)
class StoredSample:
    """All that a data set holds of one sample.

    Example:
        >>> import texvent
        >>> sources = (texvent.dataset.SampleSource(prompts=("a red ball bounces",)),)
        >>> options = {"sensor": "64x48", "duration": 0.2}
        >>> balls = texvent.dataset.Specification(name="balls", sources=sources, options=options)
        >>> work = texvent.dataset.make(balls, "balls", progress=False)
        >>> sample = texvent.dataset.open("balls")[0]
        >>> sample.caption, sample.split, sample.events.size
        ('a red ball bounces', 'train', SensorSize(width=64, height=48))
    """

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
class StoredSamples(SampleTable):
    """A table of samples that were made, in the order of their files.

    `texvent.dataset.open` makes one. Reading a sample takes one read of the shard. `make` gives
    too:

    * `class_number`: place in `labels`; −1 without a class.
    * `caption`: its prompt, "" without one.
    * `key`: of the sample.
    * `boxes`: `boxes`, `labels`, `track_ids` and `times`, as
      `texvent.truth.boxes.detection_target` gives them.
    * `flow`: px from frame to frame, [N − 1, 2, H, W] float32; `depth`: m, [N, H, W].

    With slices, `flow` is the displacement over each slice of what a pixel shows at its start,
    [slices, 2, H, W], composed by `texvent.truth.flow_between.FrameFlow`; `depth` that of the last
    frame up to its end, [slices, H, W]; `boxes` a tuple, those after its start, up to its end.

    Raises:
        ConfigError: an unknown representation or option, or two kinds of slices.
        InputError: a sample is shorter than one slice, or does not store a target.

    Example:
        >>> import texvent
        >>> sources = (texvent.dataset.SampleSource(prompts=("a red ball bounces",)),)
        >>> options = {"sensor": "64x48", "duration": 0.2}
        >>> balls = texvent.dataset.Specification(name="balls", sources=sources, options=options)
        >>> work = texvent.dataset.make(balls, "balls", progress=False)
        >>> samples = texvent.dataset.open("balls")
        >>> [len(samples.select(samples.index.events > least)) for least in (0, 10**6)]
        [1, 0]
    """

    folder: Path
    """Folder of the data set."""
    index: Index
    """Facts of each sample, known without reading it: `index.events`, `index.duration_us` and
    others."""
    labels: tuple[str, ...]
    """All classes of the data set; a sample's class number is its place here."""

    known_targets: ClassVar[tuple[str, ...]] = ("boxes", "flow", "depth")

    def __repr__(self) -> str:
        given = f", {self.representation}" if self.representation else ""
        return f"StoredSamples({len(self):,} of {self.folder}, {len(self.labels)} classes{given})"

    def __post_init__(self) -> None:
        super().__post_init__()
        self._refuse_short()
        for target in self.targets:
            places = self.index.members[:, MEMBERS.index(CLIP_FILES[target][0]), 0]
            lacking = int((places < 0).sum())
            if lacking:
                raise InputError(
                    f"{lacking:,} of {len(self):,} samples store no {target}; name {target} in "
                    "`truth` of the specification, and make the data set again"
                )

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
        index, shard, files = self.index, int(self.index.shard[number]), self._files(number)
        facts = files.facts()
        return StoredSample(
            key=files.key,
            events=files.columns().with_metadata(facts),
            caption=index.captions[index.caption[number]],
            label=index.labels[index.label[number]],
            class_number=self.class_number(number),
            variant=index.variants[shard],
            split=index.splits[shard],
            facts=facts,
            truth=files.truth(),
        )

    @property
    def count(self) -> int:
        """Number of samples."""
        return len(self)

    def seed_of(self, number: int) -> int:
        """Seed of the simulation of a sample.

        Raises:
            IndexError: there is no such number.
        """
        return int(self.index.seed[self._checked(number)])

    def truth(self, number: int) -> ClipTruth:
        """Ground truth of a sample; its arrays are read when they are asked for.

        Raises:
            IndexError, FileFormatError: as for `[number]`.
        """
        return self._files(number).truth()

    def events(self, number: int) -> EventStream:
        """The events of a sample, without metadata.

        Raises:
            IndexError, FileFormatError: as for `[number]`.
        """
        return self._files(number).columns()

    def class_number(self, number: int) -> int:
        """Place of the class of a sample in `labels`; −1 without a class."""
        return int(self._class_numbers[self.index.label[self._checked(number)]])

    def members(self, number: int, only: Sequence[str] = MEMBERS) -> dict[str, bytes]:
        """The files of a sample: extension, such as "json" or "png", → content.

        Raises:
            IndexError, FileFormatError: as for `[number]`.
        """
        return self._files(number).read(only)

    def select(self, numbers: ArrayLike) -> StoredSamples:
        """The samples of these numbers, in that order, or where a mask is true.

        `samples.select(samples.index.events > 1000)` leaves out those of few events.
        """
        chosen = np.asarray(numbers)
        chosen = np.flatnonzero(chosen) if chosen.dtype == bool else chosen.astype(np.int64)
        return replace(self, index=self.index.select(chosen))

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

    def _files(self, number: int) -> SampleFiles:
        number, index = self._checked(number), self.index
        places = zip(MEMBERS, index.members[number].tolist(), strict=True)
        return SampleFiles(
            self.folder / index.shards[int(index.shard[number])],
            str(index.key[number]),
            {name: (begin, size) for name, (begin, size) in places if begin >= 0},
            SensorSize(*index.size[number].tolist()),
        )

    def _checked(self, number: int) -> int:
        if not -len(self) <= number < len(self):
            raise IndexError(f"sample {number} does not exist; there are {len(self)}")
        return int(number) % len(self)

    def _sizes(self) -> Iterable[SensorSize]:
        # Yielded, because sorting millions takes a while and they are not always asked for.
        yield from (SensorSize(*size) for size in np.unique(self.index.size, axis=0).tolist())

    def _clip(self, number: int) -> tuple[EventStream, Sequence[Window], Targets]:
        files, start = self._files(number), int(self.index.start_us[number])
        end = start + int(self.index.duration_us[number])
        windows = [(start, end)]
        if (step := self.slice_us) is not None:
            windows = [(stop - step, stop) for stop in range(start + step, end + 1, step)]
        return files.columns(), windows, partial(self._targets, files.truth())

    def _targets(self, truth: ClipTruth, windows: Sequence[Window] | None) -> Arrays:
        if windows is None:
            return {name: _whole_target(truth, name) for name in self.targets}
        return {name: _sliced_target(truth, name, windows) for name in self.targets}

    def _facts(self, number: int) -> Arrays:
        caption, key = self.index.captions[self.index.caption[number]], self.index.key[number]
        number = self.class_number(number)
        return {"class_number": number, "caption": caption or "", "key": str(key)}

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


def _whole_target(truth: ClipTruth, target: str) -> Any:
    """A target of all frames."""
    if target == "boxes":
        return detection_target(truth.boxes)
    return np.moveaxis(truth.flow(), -1, 1) if target == "flow" else truth.depth()


def _sliced_target(truth: ClipTruth, target: str, windows: Sequence[Window]) -> Any:
    """A target of each slice: boxes in a tuple, others stacked."""
    if target == "boxes":
        times = truth.boxes["t"]
        within = (truth.boxes[(times > start) & (times <= stop)] for start, stop in windows)
        return tuple(map(detection_target, within))
    if target == "depth":
        depth, ends = truth.depth(), [stop for _, stop in windows]
        return depth[np.searchsorted(truth.times_us, ends, "right") - 1]
    steps = FrameFlow(truth.times_us, truth.flow(), _occluded(truth))
    return np.stack([steps.between(*window) for window in windows])


def _occluded(truth: ClipTruth) -> NDArray[np.bool_] | None:
    try:
        return truth.occluded()
    except InputError:  # not known of videos
        return None
