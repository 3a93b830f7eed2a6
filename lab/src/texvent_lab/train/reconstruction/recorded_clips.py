"""Recordings with frames as windows from frame to frame; and clips of two kinds as one set."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Protocol

import h5py
import numpy as np

from texvent.dataset.simulated_samples import Target
from texvent.errors import InputError
from texvent.extending import full_version
from texvent.io.atomic import atomic_file
from texvent.represent.slices import slice_between
from texvent.runtime.files.cache_folder import make_folder
from texvent.runtime.identity import digest
from texvent.sensor import SensorSize
from texvent.settings.provenance import fingerprint
from texvent_lab.frame_recordings import FrameRecording, locate_source, open_recording
from texvent_lab.train.reconstruction.sequences import (
    COLUMNS,
    SequenceData,
    Windows,
    count_windows,
    read_clip,
)

TRAINED_SHARE = 0.8
"""Part of a recording, from its start, that is trained on; the rest is scored."""
FRAME: Target = "frame"


class NumberedClips(Protocol):
    """Clips that are cut into windows, by number."""

    @property
    def data(self) -> SequenceData:
        """Options of the cut."""
        ...

    def __len__(self) -> int:
        """Number of clips."""
        ...

    @property
    def identity(self) -> str:
        """Identity of all clips; other ones have another."""
        ...

    @property
    def size(self) -> SensorSize:
        """Size of the sensor."""
        ...

    def draw(self, number: int, chance: np.random.Generator, count: int | None = None) -> Windows:
        """A random run of `count` windows of a clip; None: `data.length` of them."""
        ...

    def read(self, number: int, first: int = 0, count: int | None = None) -> Windows:
        """Some windows of a clip, from window `first` on; without a count, all that follow."""
        ...


@dataclass(frozen=True, eq=False)
class RecordedClips:
    """A split of recordings: runs of `data.length` windows to train on, the rest as one clip.

    Each recording is copied once into the cache, window by window.
    """

    data: SequenceData
    split: str

    @classmethod
    def open(cls, data: SequenceData, split: str) -> RecordedClips:
        """Read the recordings, those that are not in the cache.

        Raises:
            InputError: a recording is missing, has no frames, or is shorter than a clip; or the
                crop is larger than the sensor.
        """
        clips = cls(data, split)
        make_folder(data.cache_folder)
        if not len(clips):
            raise InputError(
                f"{', '.join(data.recordings)}: no run of {data.length} frames to train on; make "
                "length smaller"
            )
        if data.crop is not None and data.crop > min(clips.size):
            raise InputError(
                f"crop is {data.crop} px, but the sensor has {clips.size}; give at most "
                f"{min(clips.size)}"
            )
        return clips

    def __len__(self) -> int:
        """Number of clips."""
        return len(self.runs)

    @property
    def identity(self) -> str:
        """See `NumberedClips`."""
        return digest([path.name for path in self.files])

    @cached_property
    def files(self) -> list[Path]:
        """The copies of the recordings, made now where they are missing."""
        return [self._copy(source) for source in self.data.recordings]

    @cached_property
    def runs(self) -> list[tuple[Path, int, int]]:
        """File, first window and number of windows of each clip."""
        found = []
        for path in self.files:
            count = count_windows(path)
            middle, length = int(TRAINED_SHARE * count), self.data.length
            if self.split == self.data.split:
                starts = range(0, middle - length + 1, length)
                found += [(path, first, length) for first in starts]
            else:
                found.append((path, middle, count - middle))
        return found

    @cached_property
    def size(self) -> SensorSize:
        """See `NumberedClips`."""
        return self.read(0, 0, 1).events[0].size

    def draw(self, number: int, chance: np.random.Generator, count: int | None = None) -> Windows:
        """See `NumberedClips`."""
        wanted = self.data.length if count is None else count
        return self.read(number, int(chance.integers(self.runs[number][2] - wanted + 1)), wanted)

    def read(self, number: int, first: int = 0, count: int | None = None) -> Windows:
        """See `NumberedClips`."""
        path, start, available = self.runs[number]
        return read_clip(
            path, start + first, available - first if count is None else count, [FRAME]
        )

    def _copy(self, source: str) -> Path:
        place, offset_us = locate_source(source)
        facts = [full_version(), str(place.resolve()), fingerprint(str(place)), offset_us]
        path = self.data.cache_folder / f"{digest(facts)}.h5"
        if not path.exists():
            make_folder(path.parent)
            write_recording(path, open_recording(place), offset_us)
        return path


@dataclass(frozen=True, eq=False)
class ExtendedClips:
    """Clips, and the first few of others."""

    clips: NumberedClips
    more: NumberedClips
    count: int
    """Number of the others."""

    @property
    def data(self) -> SequenceData:
        """Options of the clips; the others are cut alike."""
        return self.clips.data

    def __len__(self) -> int:
        """Number of clips."""
        return len(self.clips) + self.count

    @property
    def identity(self) -> str:
        """See `NumberedClips`."""
        return digest([self.clips.identity, self.more.identity, self.count])

    @property
    def size(self) -> SensorSize:
        """See `NumberedClips`."""
        return self.clips.size

    def draw(self, number: int, chance: np.random.Generator, count: int | None = None) -> Windows:
        """See `NumberedClips`."""
        before = len(self.clips)
        if number < before:
            return self.clips.draw(number, chance, count)
        return self.more.draw(number - before, chance, count)

    def read(self, number: int, first: int = 0, count: int | None = None) -> Windows:
        """See `NumberedClips`."""
        before = len(self.clips)
        if number < before:
            return self.clips.read(number, first, count)
        return self.more.read(number - before, first, count)


def write_recording(path: Path, recording: FrameRecording, offset_us: int = 0) -> None:
    """Write a recording as `read_clip` reads clips: a window between every two frames.

    Args:
        path: of the new file.
        recording: read once, frame by frame.
        offset_us: added to the times of frames.
    """
    ahead, frames = itertools.tee(recording.frames)
    times_us = (frame.t_us + offset_us for frame in ahead)
    size = recording.frames.size
    ends, edges_us = [0], [next(frames).t_us + offset_us]
    # The hidden part holds a lock of its own.
    with atomic_file(path, overwrite=True) as part, h5py.File(part, "w", locking=False) as file:
        first = next(iter(slice_between([], [0, 1], size=size)))[1]
        columns: dict[str, Any] = {
            name: file.create_dataset(
                f"events/{name}", (0,), getattr(first, name).dtype, maxshape=(None,),
                chunks=(2**16,), fletcher32=True,
            )
            for name in COLUMNS
        }  # fmt: skip
        images = file.create_dataset(
            FRAME, (0, *size.shape), np.float32, maxshape=(None, *size.shape),
            chunks=(1, *size.shape), compression="lzf", shuffle=True, fletcher32=True,
        )  # fmt: skip
        for (end_us, events), frame in zip(_slices(recording, times_us), frames, strict=False):
            for name, column in columns.items():
                column.resize(ends[-1] + len(events), 0)
                column[ends[-1] :] = getattr(events, name)
            images.resize(len(ends), 0)
            images[-1] = frame.luma
            ends.append(ends[-1] + len(events))
            edges_us.append(end_us)
        file["ends"], file["edges_us"] = ends[1:], edges_us
        file.attrs["width"], file.attrs["height"] = size


def _slices(recording: FrameRecording, times_us: Iterator[int]) -> Iterator[tuple[int, Any]]:
    return slice_between(recording.events, times_us, size=recording.frames.size)
