"""Digits of MNIST's files, and N-MNIST: the same digits on a display, recorded by a moving sensor.

Polarity: N-MNIST's stored bit is 1 where brightness falls, so it is flipped. Measured on pairs of a
recording and its digit, whose path is known; every run repeats the measurement.

Source: Y. LeCun, C. Cortes and C. Burges, MNIST; G. Orchard et al., "Converting static image
datasets to spiking neuromorphic datasets using saccades", Frontiers in Neuroscience 2015. The
recordings are under CC BY-SA 4.0.
"""

from __future__ import annotations

import gzip
import math
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, one_line
from texvent.events import EventStream
from texvent.io.files import open_events
from texvent.sensor import SensorSize

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


SIZE = SensorSize(34, 34)
FIRST_TEST = 60_000
"""Recording 60000 + k shows MNIST's test image k; recording k shows training image k, from 1."""
PARTS = ("Train", "Test")
"""Folders of the published data set."""


class DigitRecording(NamedTuple):
    """Events of a digit."""

    events: EventStream
    """Brightness rises where p is 1."""
    label: int


def read_recordings(folder: Path, numbers: Sequence[int]) -> list[DigitRecording]:
    """N-MNIST's recordings by their numbers.

    Args:
        folder: holds the published `Train/DIGIT/00001.bin` and `Test/DIGIT/00001.bin`.
        numbers: 1..60000 of Train, 60001..70000 of Test.

    Raises:
        InputError: there is no such file or recording.
        FileFormatError: a file is damaged.
    """
    return [_read(folder, number) for number in numbers]


def _read(folder: Path, number: int) -> DigitRecording:
    is_test = number > FIRST_TEST
    part = folder / PARTS[is_test]
    name = f"{number - FIRST_TEST if is_test else number:05d}.bin"
    for label in range(CLASSES):
        path = part / str(label) / name
        if path.is_file():
            found = open_events(path, format="atis", size=SIZE).collect()
            return DigitRecording(EventStream(found.x, found.y, found.t, 1 - found.p, SIZE), label)
    raise InputError(
        f"there is no {name} in the folders 0..9 of {part}; give the folder of N-MNIST's unpacked "
        "Train and Test"
    )
