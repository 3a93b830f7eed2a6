"""Clips of a specification as consecutive windows: each is simulated once, then read from disk."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.dataset.simulated_samples import SlicedClip, Target, record_clip, target_of
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.io.hdf5.storage import open_hdf5
from texvent.runtime.files.cache_folder import cache_folder, make_folder
from texvent.runtime.identity import digest
from texvent.sensor import SensorSize
from texvent.settings.provenance import fingerprint
from texvent_lab.train.reconstruction.simulated_clips import SimulatedClips


@dataclass(frozen=True, kw_only=True)
class SequenceData:
    """Clips of a data set specification, simulated when they are first needed."""

    names_or_paths: ClassVar[tuple[str, ...]] = ("recordings",)
    """Names of data sets, or paths from the training file's folder."""

    specification: Path = Path()
    """Specification of the data set: TOML or YAML; see docs/datasets.md. Nothing needs to be made
    before."""
    recordings: tuple[str, ...] = ()
    """Recordings of frames and events in place of a specification: paths, or names of pulled data
    sets. Windows go from frame to frame; the last fifth is scored."""
    variant: str | None = None
    """None: the only one."""
    split: str = "train"
    """Trained on."""
    validation_split: str = "validation"
    """Scored after every epoch."""
    slice_us: int = 40_000
    """Length of a window, µs. The network sees the events of one window at a time."""
    length: int = 20
    """Windows of a training sequence: a random run of each clip, drawn anew in every epoch."""
    crop: int | None = None
    """Side of the random square that is trained on, px; None: the whole sensor."""
    cache: Path | None = None
    """Folder of the simulated clips, which may serve many trainings; None: `sequences` in
    texvent's cache folder."""

    def __post_init__(self) -> None:
        if self.recordings and self.specification != Path():
            raise ConfigError("specification and recordings are given; give one of them")
        check_range("slice_us", self.slice_us, 1, 10**12)
        check_range("length", self.length, 1, 1_000_000)
        check_range("crop", self.crop, 8, 65_536)

    @property
    def cache_folder(self) -> Path:
        """Folder of the clips."""
        return self.cache or cache_folder("sequences")


COLUMNS = "xytp"


@dataclass(frozen=True, eq=False)
class Windows:
    """Consecutive windows of one clip."""

    events: tuple[EventStream, ...]
    """Events of each window; times are those of the clip."""
    edges_us: NDArray[np.int64]
    """Start of the first window and end of each, µs, [windows + 1]."""
    targets: Mapping[Target, NDArray[Any]]
    """Targets asked for, [windows, ...]; `SimulatedSamples.make` describes each."""

    def __len__(self) -> int:
        """Number of windows."""
        return len(self.events)


def write_clip(path: Path, clip: SlicedClip, targets: Sequence[Target]) -> None:
    """Write a clip as a whole, over a file of that name.

    Raises:
        ConfigError: the video does not know a target.
        OutputError: the file cannot be written.
    """
    parts = [clip.events.cut(*window) for window in clip.windows]
    events = EventStream.concat(parts)
    # The hidden part holds a lock of its own.
    with (
        atomic_file(path, overwrite=True) as part,
        h5py.File(part, "w", locking=False) as file,
    ):
        for name in COLUMNS:
            column = getattr(events, name)
            file.create_dataset(f"events/{name}", data=column, chunks=True, fletcher32=True)
        file["ends"] = np.cumsum([len(one) for one in parts])
        file["edges_us"] = [clip.start_us, *clip.frames]
        file.attrs["width"], file.attrs["height"] = events.size
        for target in targets:
            values = np.stack([target_of(clip, target, window) for window in clip.windows])
            chunks = (1, *values.shape[1:])
            file.create_dataset(
                target, data=values, chunks=chunks, compression="lzf", shuffle=True, fletcher32=True
            )


def count_windows(path: Path) -> int:
    """Number of windows of a stored clip.

    Raises:
        FileFormatError: the file is damaged.
    """
    with open_hdf5(path) as file:
        return len(file["ends"])


def read_clip(path: Path, first: int, count: int, targets: Sequence[Target]) -> Windows:
    """Some windows of a stored clip; no others are read.

    Args:
        path: of the clip.
        first: number of the first window, from 0.
        count: of windows.
        targets: those to read.

    Raises:
        FileFormatError: the file is damaged.
    """
    with open_hdf5(path) as file:
        ends = [0, *file["ends"][: first + count].tolist()][first:]
        size = SensorSize(int(file.attrs["width"]), int(file.attrs["height"]))
        columns = {name: file[f"events/{name}"][ends[0] : ends[-1]] for name in COLUMNS}
        edges_us = file["edges_us"][first : first + count + 1]
        values = {target: file[target][first : first + count] for target in targets}
    events = EventStream(**columns, size=size)
    bounds = [end - ends[0] for end in ends]
    parts = [events[begin:end] for begin, end in itertools.pairwise(bounds)]
    return Windows(tuple(parts), edges_us, values)


@dataclass(frozen=True, eq=False)
class WindowedClips:
    """A split of a specification, cut into windows.

    The file of a clip is named by a digest of all that decides it, so a changed specification is
    never read from old files. Processes that need the same clip at once write equal files.
    """

    data: SequenceData
    split: str
    targets: tuple[Target, ...]

    @classmethod
    def open(cls, data: SequenceData, split: str, targets: Sequence[Target]) -> WindowedClips:
        """Read the specification, and simulate the first clip, which shows most mistakes.

        Args:
            data: which clips, and how they are cut.
            split: which of them.
            targets: what else each window comes with. Videos know only `frame`.

        Raises:
            InputError, ConfigError: the specification, split or variant does not exist, the split
                is empty, the first clip cannot be simulated or is too short, or the crop is larger
                than the sensor.
            OutputError: the cache folder cannot be made.
        """
        clips = cls(data, split, tuple(targets))
        if clips.simulated.recipe.items.are_videos:
            clips = replace(clips, targets=tuple(one for one in targets if one == "frame"))
        if not len(clips):
            raise InputError(
                f"split {split} of {data.specification} has no clips; give it a larger share in "
                "splits, or the specification more clips"
            )
        make_folder(clips.folder)
        clips.read(0, 0, data.length)
        size = clips.size
        if data.crop is not None and data.crop > min(size):
            raise InputError(
                f"crop is {data.crop} px, but {data.specification} has a sensor of {size}; give at "
                f"most {min(size)}"
            )
        return clips

    def __len__(self) -> int:
        """Number of clips."""
        return len(self.simulated)

    @cached_property
    def simulated(self) -> SimulatedClips:
        """The same clips without windows."""
        data = self.data
        return SimulatedClips(data.specification, split=self.split, variant=data.variant)

    @property
    def identity(self) -> str:
        """Identity of all clips of the specification, and of the files that they are made of."""
        recipe, variant = self.simulated.recipe, self.simulated.variant.name
        videos = [item.video for item in recipe.items.all]
        files = map(fingerprint, (*videos, *recipe.files_named[variant]))
        return digest([recipe.identity, *files])

    @property
    def folder(self) -> Path:
        """Folder of the simulated clips."""
        return self.data.cache_folder

    @cached_property
    def size(self) -> SensorSize:
        """Size of the sensor of the first clip."""
        return self.read(0, 0, 1).events[0].size

    def draw(self, number: int, chance: np.random.Generator, count: int | None = None) -> Windows:
        """A random run of windows of a clip.

        Args:
            number: of the clip.
            chance: of this clip in this epoch.
            count: windows; None: `data.length` of them.

        Raises:
            InputError: the clip is shorter, or cannot be simulated.
        """
        wanted = self.data.length if count is None else count
        available = count_windows(self._path(number))
        first = int(chance.integers(max(available - wanted, 0) + 1))
        return self.read(number, first, wanted)

    def read(self, number: int, first: int = 0, count: int | None = None) -> Windows:
        """Some windows of a clip, from window `first` on; without a count, all that follow.

        Raises:
            InputError: the clip does not have them, or cannot be simulated.
        """
        path = self._path(number)
        available = count_windows(path)
        wanted = available - first if count is None else count
        if first + wanted > available:
            raise InputError(
                f"clip {number} of split {self.split} has {available} windows of "
                f"{self.data.slice_us} µs, fewer than {first + wanted}; make its duration longer, "
                "or length or slice_us smaller"
            )
        return read_clip(path, first, wanted, self.targets)

    def _path(self, number: int) -> Path:
        """The file of a clip, simulated now if it is not there."""
        facts = (self.data.slice_us, *sorted(self.targets))
        path = self.folder / f"{self.simulated.identity(number, *facts)}.h5"
        if not path.exists():
            clip = record_clip(self.simulated.simulation(number), self.data.slice_us)
            write_clip(path, clip, self.targets)
        return path
