"""Samples of data sets: stored ones, and those of a specification, simulated when they are read."""

from __future__ import annotations

from pathlib import Path

from texvent.dataset.generation.sample import simulate_sample
from texvent.dataset.loading.stored_samples import open
from texvent.dataset.simulated_clips import SimulatedClips
from texvent.dataset.specification.specification import Filters
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent_lab.train.classification.config import Source


class DataSetSamples:
    """A split of a data set; see `LabelledSamples`."""

    def __init__(self, source: Source, split: str) -> None:
        """Open it.

        Raises:
            InputError, ConfigError, FileFormatError: as `texvent.dataset.open`.
        """
        self.name = f"split {split} of {source.folder}"
        self._samples = open(source.folder or Path(), variant=source.variant, split=split)
        self.labels, self.identity = self._samples.labels, self._samples.index.identity

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
        """Of all samples."""
        index = self._samples.index
        sizes = map(SensorSize._make, index.size.tolist())
        return dict(zip(index.key.tolist(), sizes, strict=True))

    def title(self, number: int) -> str:
        """See `LabelledSamples`."""
        return f"sample {self._samples.index.key[number]}"


class SpecifiedSamples:
    """A split of a specification; see `LabelledSamples`."""

    def __init__(self, source: Source, split: str) -> None:
        """Read the specification; nothing is simulated yet.

        Raises:
            InputError, ConfigError: as `SimulatedClips`.
        """
        self.name = f"split {split} of {source.specification}"
        self._clips = SimulatedClips(
            source.specification or Path(), split=split, variant=source.variant
        )
        self.labels, self.identity = self._clips.labels, self._clips.recipe.identity

    def __len__(self) -> int:
        """Number of samples."""
        return len(self._clips)

    def class_number(self, number: int) -> int:
        """See `LabelledSamples`."""
        return self._clips.class_number(number)

    def events(self, number: int) -> EventStream:
        """See `LabelledSamples`."""
        return simulate_sample(self._clips.simulation(number), Filters(min_events=0)).events

    def sizes(self) -> dict[str, SensorSize]:
        """Of the first sample."""
        return {self.title(0): self._clips.simulation(0).video.size}

    def title(self, number: int) -> str:
        """See `LabelledSamples`."""
        return f"sample {number} of {self.name}"
