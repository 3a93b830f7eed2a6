"""Digits of MNIST's files, and recordings as the images that networks see."""

from __future__ import annotations

import gzip
import math
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import DURATION_US
from texvent.errors import FileFormatError, InputError, one_line
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.represent.named import represent_window
from texvent_lab.bench.digits.sheet import DigitSheet

IMAGES, LABELS = "t10k-images", "t10k-labels"
KINDS = {IMAGES: "idx3-ubyte", LABELS: "idx1-ubyte"}
SIDE = 28
"""Width and height of a digit, px."""
CLASSES = 10
MAX_BYTES = 2**28
UINT8 = 8
"""Number of the type of values in a file's head."""


class Mnist(NamedTuple):
    """The test images, which stand in the order of the published file."""

    images: NDArray[np.uint8]
    """[n, 28, 28], 0 is background."""
    labels: NDArray[np.uint8]
    """[n] 0..9."""


def read_mnist(folder: Path) -> Mnist:
    """MNIST's test images and labels.

    Args:
        folder: holds t10k-images-idx3-ubyte and t10k-labels-idx1-ubyte, each as it is or
            compressed (.gz).

    Raises:
        InputError: a file is missing.
        FileFormatError: a file is damaged, or the two do not belong together.
    """
    images, labels = (read_idx(_find(folder, kind)) for kind in (IMAGES, LABELS))
    if images.shape[1:] != (SIDE, SIDE):
        raise FileFormatError(
            f"the images in {folder} are of shape {list(images.shape)}; they must be 28x28"
        )
    if labels.shape != images.shape[:1] or (len(labels) and labels.max() >= CLASSES):
        raise FileFormatError(
            f"{folder} holds {len(images)} images and labels of shape {list(labels.shape)}; give "
            "one label 0..9 per image"
        )
    return Mnist(images, labels)


def read_idx(path: Path) -> NDArray[np.uint8]:
    """The array of an IDX file of bytes, such as [10000, 28, 28].

    Raises:
        InputError: the file cannot be read.
        FileFormatError: it is damaged, or holds something else.

    Format: two zero bytes, the type (8: bytes), the number of axes; the length of each axis as a
        big-endian uint32; the values, the last axis fastest.
    """
    content = _content(path)
    axes = content[3] if len(content) > 3 else 0
    head = 4 + 4 * axes
    if content[:3] != bytes((0, 0, UINT8)) or not 1 <= axes <= 3 or len(content) < head:
        raise FileFormatError(f"{path} is no IDX file of bytes; give the file as it was published")
    shape = tuple(int(one) for one in np.frombuffer(content, ">u4", axes, 4))
    if len(content) - head != math.prod(shape):
        raise FileFormatError(
            f"{path} holds {len(content) - head} values, its head says {list(shape)}; it was cut "
            "off or changed"
        )
    return np.frombuffer(content, np.uint8, offset=head).reshape(shape)


def _find(folder: Path, kind: str) -> Path:
    names = [f"{kind}{sign}{KINDS[kind]}{end}" for sign in "-." for end in (".gz", "")]
    for name in names:
        if (folder / name).is_file():
            return folder / name
    raise InputError(f"there is no {names[0]} in {folder}; give the folder of MNIST's test files")


def _content(path: Path) -> bytes:
    try:
        with gzip.open(path) if path.suffix == ".gz" else path.open("rb") as file:
            content = file.read(MAX_BYTES + 1)
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)}); fetch it again") from error
    except OSError as error:
        raise InputError(f"cannot read {path}: {one_line(error)}") from error
    if len(content) > MAX_BYTES:
        raise FileFormatError(f"{path} holds more than {MAX_BYTES} bytes; MNIST's files hold less")
    return content


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
