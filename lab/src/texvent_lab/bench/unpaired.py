"""Simulated streams against recorded ones of other scenes, such as N-ImageNet's, by statistics.

What a text describes was never recorded, so there is no pair to compare. Patches of all files of a
folder are pooled, and the Fréchet distance between their statistics is set between a floor (one
half of the recorded files against the other) and a null (recorded files with shuffled times).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.arrays.n_imagenet import load_stream
from texvent.io.files import event_extensions
from texvent.metrics.summary import normalise
from texvent.metrics.unpaired.frechet import compare_statistics
from texvent.metrics.unpaired.patch_statistics import patch_statistics
from texvent_lab.bench.progress import Progress, no_progress
from texvent_lab.bench.selftest.perturbations import perturb

NULL = "shuffle all times"


@dataclass(frozen=True, kw_only=True)
class UnpairedReport:
    """Distances of pooled patch statistics, squared standard deviations of the recorded ones."""

    simulated_files: int
    recorded_files: int
    simulated: float
    """Simulated streams against recorded ones."""
    floor: float
    """Every second recorded file against the others."""
    null: float
    """Recorded files with shuffled times against the recorded ones."""

    @property
    def normalised(self) -> float:
        """0 at the null, 1 at the floor; NaN where the null is no worse than the floor."""
        return normalise(self.simulated, floor=self.floor, null=self.null, better="lower")


def compare_folders(
    simulated: Path,
    recorded: Path,
    *,
    limit: int | None = None,
    progress: Progress = no_progress,
) -> UnpairedReport:
    """Compare all event files of two folders, sub-folders included.

    Args:
        simulated: streams to judge.
        recorded: streams of a real sensor; files without a size are N-ImageNet's (640x480).
        limit: use at most this many files of each folder, evenly spaced in order of their names.
        progress: told of progress.

    Raises:
        InputError: a folder is missing or holds no event file; fewer than two recorded ones.
        FileFormatError: a file is damaged.
    """
    judged, known = (_list_files(folder, limit) for folder in (simulated, recorded))
    if len(known) < 2:
        raise InputError(f"{recorded} holds one event file; its floor needs two")
    own = _statistics(judged, progress)
    parts = [_statistics(known[start::2], progress) for start in (0, 1)]
    shuffled = _statistics(known, progress, change=lambda events: perturb(events, NULL))
    reference = np.concatenate(parts)
    return UnpairedReport(
        simulated_files=len(judged),
        recorded_files=len(known),
        simulated=compare_statistics(own, reference),
        floor=compare_statistics(*parts),
        null=compare_statistics(shuffled, reference),
    )


def _list_files(folder: Path, limit: int | None) -> list[Path]:
    if not folder.is_dir():
        raise InputError(f"there is no folder {folder}")
    extensions = event_extensions()
    files = sorted(path for path in folder.rglob("*") if path.suffix.lower() in extensions)
    if not files:
        raise InputError(f"{folder} holds no event file")
    if limit is None or limit >= len(files):
        return files
    return [files[number * len(files) // limit] for number in range(limit)]


def _statistics(
    files: Sequence[Path],
    progress: Callable[[str], None],
    change: Callable[[EventStream], EventStream] | None = None,
) -> NDArray[np.float64]:
    found = []
    for path in files:
        progress(str(path))
        events = load_stream(path)
        found.append(patch_statistics(change(events) if change else events))
    return np.concatenate(found)
