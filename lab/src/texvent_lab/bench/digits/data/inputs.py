"""What the network sees of recordings: images of fixed windows, as small numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.saccades import DURATION_US
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.represent.named import represent_window

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

    def __len__(self) -> int:
        return len(self.labels)

    @property
    def median_count(self) -> float:
        """Events of the recording in the middle."""
        return float(np.median(self.counts.sum(axis=1)))

    @property
    def on_share(self) -> float:
        """Share of ON among all events."""
        return float(self.counts[:, 1].sum() / max(self.counts.sum(), 1))

    def __getitem__(self, which: NDArray[Any] | slice) -> InputSet:
        images = {name: values[which] for name, values in self.images.items()}
        return InputSet(images, self.counts[which], self.labels[which])

    def write(self, path: Path) -> None:
        """Write a compressed file that `read` reads."""
        with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
            arrays: dict[str, Any] = {**self.images, "counts": self.counts, "labels": self.labels}
            np.savez_compressed(file, **arrays)

    @classmethod
    def read(cls, path: Path) -> InputSet:
        """The recordings of a file that `write` wrote."""
        with np.load(path) as file:
            images = {name: file[name] for name in REPRESENTATIONS}
            return cls(images, file["counts"], file["labels"])


def join_inputs(parts: Sequence[InputSet]) -> InputSet:
    """All recordings, one part after the other."""
    return InputSet(
        {name: np.concatenate([one.images[name] for one in parts]) for name in REPRESENTATIONS},
        np.concatenate([one.counts for one in parts]),
        np.concatenate([one.labels for one in parts]),
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
