"""Samples of a data set, and recordings of other people's folders."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from texvent.dataset.stored.stored_samples import open
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.files import event_extensions, load
from texvent.runtime.identity import digest
from texvent.sensor import SensorSize, as_size
from texvent_lab.train.classification.config import LabelledSource


class DataSetSamples:
    """A split of a data set; see `LabelledSamples`."""

    def __init__(self, source: LabelledSource, split: str) -> None:
        """Open it.

        Raises:
            InputError, ConfigError, FileFormatError: as `texvent.dataset.open`.
        """
        self.name = f"split {split} of {source.folder}"
        self._samples = open(source.folder or Path(), variant=source.variant, split=split)
        self.labels = self._samples.labels
        self.identity = _identity(self._samples.index.key.tolist(), self._samples.index.digests)

    def __len__(self) -> int:
        """Number of samples."""
        return len(self._samples)

    def class_number(self, number: int) -> int:
        """See `LabelledSamples`."""
        return self._samples.class_number(number)

    def events(self, number: int) -> EventStream:
        """See `LabelledSamples`."""
        return self._samples.events(number)

    def sizes(self) -> dict[str, SensorSize]:
        """Sizes of all samples."""
        index = self._samples.index
        sizes = map(SensorSize._make, index.size.tolist())
        return dict(zip(index.key.tolist(), sizes, strict=True))

    def title(self, number: int) -> str:
        """See `LabelledSamples`."""
        return f"sample {self._samples.index.key[number]}"


class RecordedSamples:
    """A split of recordings; see `LabelledSamples`."""

    def __init__(self, source: LabelledSource, split: str) -> None:
        """List the files; none is read.

        Raises:
            InputError: no such folder, no classes in it, or no files in them.
        """
        folder = Path(source.recordings or "") / split
        if not folder.is_dir():
            raise InputError(
                f"there is no folder {folder}; recordings holds a folder per split, which holds a "
                "folder per class"
            )
        self.name = str(folder)
        self._size = None if source.sensor is None else as_size(source.sensor)
        self._is_flipped = source.flip_polarity
        classes = sorted(one for one in folder.iterdir() if one.is_dir())
        self.labels = tuple(one.name for one in classes)
        extensions = event_extensions()
        self._files = [
            (number, path)
            for number, one in enumerate(classes)
            for path in sorted(one.iterdir())
            if path.suffix.lower() in extensions
        ]
        if not self._files:
            raise InputError(f"{folder} holds no event files in folders of classes")
        names = [str(path.relative_to(folder)) for _, path in self._files]
        self.identity = _identity(names, [path.stat().st_size for _, path in self._files])

    def __len__(self) -> int:
        """Number of samples."""
        return len(self._files)

    def class_number(self, number: int) -> int:
        """See `LabelledSamples`."""
        return self._files[number][0]

    def events(self, number: int) -> EventStream:
        """See `LabelledSamples`."""
        path = self._files[number][1]
        try:
            events = load(path)
        except InputError:  # it stores no size
            events = load(path, size=self._size)
        if not self._is_flipped:
            return events
        return EventStream(events.x, events.y, events.t, 1 - events.p, events.size)

    def sizes(self) -> dict[str, SensorSize]:
        """Sizes of the first file of each class."""
        first: dict[int, int] = {}
        for number, (label, _) in enumerate(self._files):
            first.setdefault(label, number)
        return {self.title(number): self.events(number).size for number in first.values()}

    def title(self, number: int) -> str:
        """See `LabelledSamples`."""
        return str(self._files[number][1])


def _identity(names: Sequence[str], contents: Sequence[object]) -> str:
    """Number of samples, and a digest of their names in order and of facts of their contents."""
    return f"{len(names)} ({digest([*names, *contents])[:12]})"
