"""Recordings of digits as the images that networks see."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import DURATION_US
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.represent.named import represent_window
from texvent_lab.bench.digits.data import DigitRecording
from texvent_lab.bench.digits.sheet import DigitSheet

WINDOW_US = (0, DURATION_US)


class Representation(NamedTuple):
    """A representation of texvent and how it is stored."""

    name: str
    options: Mapping[str, Any]
    dtype: type
    channels: int


REPRESENTATIONS: Mapping[str, Representation] = {
    "histogram": Representation("histogram-3d", {"bins": 3}, np.uint8, 6),
    "surface": Representation("time-surface", {"tau_us": 100_000}, np.float16, 2),
}
"""Events per polarity and movement of the sensor (what counts tell), and how recent the last event
of each pixel and polarity is at the end (what times tell)."""


@dataclass(frozen=True, eq=False)
class InputSet:
    """Recordings as images."""

    images: Mapping[str, NDArray[Any]]
    """Name of the representation → [n, C, 34, 34]."""
    counts: NDArray[np.int64]
    """[n, 2] OFF and ON events in the window."""
    labels: NDArray[np.int64]
    """[n] 0..9."""
    threshold: float = math.nan
    """Contrast threshold of simulated ones, log units."""
    is_matched: bool = True
    """Whether that threshold gives the wanted count; else the preset's own is kept."""

    @property
    def median_count(self) -> float:
        """Events of the recording in the middle."""
        return float(np.median(self.counts.sum(axis=1)))

    @property
    def on_share(self) -> float:
        """Share of ON among all events."""
        return float(self.counts[:, 1].sum() / max(self.counts.sum(), 1))

    def write(self, path: Path) -> None:
        """Write a compressed file that `read` reads."""
        arrays: dict[str, Any] = {**vars(self), **self.images}
        del arrays["images"]
        with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
            np.savez_compressed(file, **arrays)

    @classmethod
    def read(cls, path: Path) -> InputSet:
        """The recordings of a file that `write` wrote."""
        with np.load(path) as file:
            images = {name: file[name] for name in REPRESENTATIONS}
            threshold, is_matched = float(file["threshold"]), bool(file["is_matched"])
            return cls(images, file["counts"], file["labels"], threshold, is_matched)


def join_inputs(parts: Sequence[InputSet]) -> InputSet:
    """All recordings, one part after the other."""
    return InputSet(
        {name: np.concatenate([one.images[name] for one in parts]) for name in REPRESENTATIONS},
        np.concatenate([one.counts for one in parts]),
        np.concatenate([one.labels for one in parts]),
    )


def represent_recordings(recordings: Sequence[DigitRecording]) -> InputSet:
    """The images of recordings."""
    images, counts = zip(*(represent_all(one.events) for one in recordings), strict=True)
    return InputSet(
        {name: np.stack([one[name] for one in images]) for name in images[0]},
        np.stack(counts).sum(axis=(2, 3)),
        np.array([one.label for one in recordings], np.int64),
    )


def represent_all(events: EventStream) -> tuple[dict[str, NDArray[Any]], NDArray[np.int64]]:
    """Images of a recording or of a whole sheet, and its events per pixel.

    Returns:
        Name of the representation → [C, H, W]; [2, H, W] OFF and ON events in the window.
    """
    images: dict[str, NDArray[Any]] = {}
    counts = np.zeros(0, np.int64)
    for key, kind in REPRESENTATIONS.items():
        image = np.asarray(represent_window(kind.name, events, WINDOW_US, **kind.options))
        if key == "histogram":
            counts = image.sum(axis=1).astype(np.int64)
        if kind.dtype is np.uint8:
            image = image.clip(0, np.iinfo(np.uint8).max)
        images[key] = image.reshape(-1, *image.shape[-2:]).astype(kind.dtype)
    return images, counts


STEP_US = 5_000
CLEAR = 5.0
"""Levels of 0..255 per step from which a change is clear."""


def polarity_agreement(sheet: DigitSheet, recorded: Sequence[EventStream]) -> float:
    """Share of events that are ON where their digit brightens, or OFF where it darkens.

    Args:
        sheet: digits with the measured motion.
        recorded: their recordings, in the same order; events where the digit changes little do
            not count.

    Returns:
        0..1, NaN without an event that counts. About 0.5 means that recordings do not show these
        digits, less that their polarity is the opposite one.
    """
    events = sheet.lay_out(recorded)
    times = range(0, DURATION_US + 1, STEP_US)
    frames = np.stack([sheet.at(t_us).pixels for t_us in times])
    change = np.diff(frames, axis=0)
    step = events.t // STEP_US
    is_inside = (step >= 0) & (step < len(change))
    events, step = events[is_inside], step[is_inside]
    seen = change[step, events.y, events.x]
    is_clear = np.abs(seen) > CLEAR
    return float(((seen > 0) == (events.p == 1))[is_clear].mean()) if is_clear.any() else np.nan
