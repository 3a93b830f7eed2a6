"""A simulated clip on disk, window by window.

An HDF5 file. `events` holds x, y, t (µs) and p of all windows one after the other; `ends` the
number of events up to the end of each window; `edges_us` the start of the first window and the end
of each. What else was asked for (`frame`, `flow` ...) has a chunk per window.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent.dataset.targets import Clip, Target, target_of
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.io.hdf5.storage import open_hdf5
from texvent.sensor import SensorSize

COLUMNS = "xytp"


@dataclass(frozen=True, eq=False)
class Windows:
    """Consecutive windows of one clip."""

    events: tuple[EventStream, ...]
    """Of each window; times are those of the clip."""
    edges_us: NDArray[np.int64]
    """Start of the first window and end of each, µs, [windows + 1]."""
    targets: Mapping[Target, NDArray[Any]]
    """What was asked for, [windows, ...]; `SimulatedSamples.make` describes each."""

    def __len__(self) -> int:
        """Number of windows."""
        return len(self.events)


def write_clip(path: Path, clip: Clip, targets: Sequence[Target]) -> None:
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
            file.create_dataset(f"events/{name}", data=getattr(events, name))
        file["ends"] = np.cumsum([len(one) for one in parts])
        file["edges_us"] = [clip.start_us, *clip.frames]
        file.attrs["width"], file.attrs["height"] = events.size
        for target in targets:
            values = np.stack([target_of(clip, target, window) for window in clip.windows])
            chunks = (1, *values.shape[1:])
            file.create_dataset(target, data=values, chunks=chunks, compression="lzf", shuffle=True)


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
