"""N-MNIST: digits on a display, recorded by a real sensor that moves.

Polarity: the stored bit is 1 where brightness falls, so it is flipped. Measured on pairs of a
recording and its digit, whose path is known; a test repeats the measurement.

Source: G. Orchard et al., "Converting static image datasets to spiking neuromorphic datasets using
saccades", Frontiers in Neuroscience 2015. The recordings are under CC BY-SA 4.0.
"""

from __future__ import annotations

import csv
import tempfile
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple, Protocol

from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.events import EventStream
from texvent.io.files import open_events
from texvent.sensor import SensorSize
from texvent_lab.bench.digits.inputs import CLASSES

SIZE = SensorSize(34, 34)
LABELS_FILE = "labels.csv"
FIRST_TEST = 60_000
"""Recording 60000 + k shows MNIST's test image k; recording k shows training image k, from 1."""
PARTS = ("Train", "Test")
"""Folders of the published data set."""


class Recording(NamedTuple):
    """Events of a digit."""

    events: EventStream
    """Brightness rises where p is 1."""
    label: int


class RecordingFiles(Protocol):
    """Where recordings lie."""

    def locate(self, number: int) -> tuple[Path, int]:
        """File and label of a recording."""
        ...


def read_recordings(path: Path, numbers: Sequence[int]) -> list[Recording]:
    """Recordings by their numbers.

    Args:
        path: the folder with the published Train and Test, or a folder or .zip file with
            `NUMBER.bin` files and `labels.csv` (columns id and label).
        numbers: 1..60000 of Train, 60001..70000 of Test.

    Raises:
        InputError: there is no such file or recording.
        FileFormatError: a file is damaged.
    """
    with _opened(path, numbers) as files:
        return [_read(*files.locate(number)) for number in numbers]


def _read(path: Path, label: int) -> Recording:
    found = open_events(path, format="atis", size=SIZE).collect()
    flipped = EventStream(found.x, found.y, found.t, 1 - found.p, SIZE)
    return Recording(flipped, label)


@contextmanager
def _opened(path: Path, numbers: Sequence[int]) -> Iterator[RecordingFiles]:
    if path.is_dir():
        has_labels = (path / LABELS_FILE).is_file()
        yield _NumberedFiles(path) if has_labels else _PublishedFiles(path)
    elif path.is_file():
        with tempfile.TemporaryDirectory() as folder:
            _unpack(path, numbers, Path(folder))
            yield _NumberedFiles(Path(folder))
    else:
        raise InputError(f"there is no {path}; give N-MNIST's folder, or a .zip file of recordings")


def _unpack(path: Path, numbers: Sequence[int], folder: Path) -> None:
    try:
        with zipfile.ZipFile(path) as archive:
            for name in (LABELS_FILE, *(f"{number}.bin" for number in numbers)):
                archive.extract(name, folder)
    except KeyError as error:
        raise InputError(f"{path}: {error.args[0]}") from error
    except (zipfile.BadZipFile, OSError, EOFError) as error:
        raise FileFormatError(f"{path} is no .zip file ({one_line(error)})") from error


class _NumberedFiles:
    """`NUMBER.bin` files beside `labels.csv`."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._labels = folder, _read_labels(folder / LABELS_FILE)

    def locate(self, number: int) -> tuple[Path, int]:
        path = self._folder / f"{number}.bin"
        if number not in self._labels or not path.is_file():
            raise InputError(
                f"there is no {path.name} in {self._folder} with a label in {LABELS_FILE}"
            )
        return path, self._labels[number]


class _PublishedFiles:
    """`Train/DIGIT/00001.bin` and `Test/DIGIT/00001.bin`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        for part in PARTS:
            if not (folder / part).is_dir():
                raise InputError(
                    f"{folder} has neither {LABELS_FILE} nor a folder {part}; give the folder of "
                    "N-MNIST's unpacked Train and Test"
                )

    def locate(self, number: int) -> tuple[Path, int]:
        part = self._folder / PARTS[number > FIRST_TEST]
        name = f"{number - FIRST_TEST if number > FIRST_TEST else number:05d}.bin"
        for label in range(CLASSES):
            path = part / str(label) / name
            if path.is_file():
                return path, label
        raise InputError(f"there is no {name} in the folders 0..9 of {part}")


def _read_labels(path: Path) -> Mapping[int, int]:
    try:
        with path.open(encoding="utf-8", newline="") as file:
            rows = [(row["id"], row["label"]) for row in csv.DictReader(file)]
            labels = {int(number): int(label) for number, label in rows}
    except (OSError, KeyError, ValueError, TypeError, csv.Error) as error:
        raise FileFormatError(
            f"{path} has no columns id and label of whole numbers ({one_line(error)})"
        ) from error
    wrong = [label for label in labels.values() if not 0 <= label < CLASSES]
    if wrong:
        raise FileFormatError(f"{path} holds the label {shown(wrong[0])}; labels are 0..9")
    return labels
