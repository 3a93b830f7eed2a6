"""Recordings with a text: samples of a data set, or N-ImageNet's streams with captions."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.reading.stored_events import read_events
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.arrays.n_imagenet import load_stream
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent_lab.nt_imagenet.files import Captioned
from texvent_lab.nt_imagenet.selection import STREAM_EXTENSION, validation_folder
from texvent_lab.reconstruct.reconstructor import Reconstructor


@dataclass(frozen=True)
class Recording:
    """Events with the text they belong to."""

    id: str
    """What it shares with recordings of the same text in other sources."""
    text: str
    load: Callable[[], EventStream]
    label: str | None = None
    """Class of the text."""


def list_samples(
    folder: Path, *, split: str | None = None, ids: Mapping[str, str] | None = None
) -> dict[str, list[Recording]]:
    """The samples of a data set by variant.

    Args:
        folder: of the data set.
        split: take that split alone.
        ids: key of a clip → id; others are left out. Default: the keys themselves.

    Raises:
        InputError: it is no data set, there is no sample, or samples have no prompt.
        FileFormatError: the record of a shard is damaged.
    """
    found: dict[str, list[Recording]] = {}
    for shard in StoredDataset.open(folder).shards():
        if split not in (None, shard.record.split):
            continue
        for sample in shard.samples:
            id = sample.clip if ids is None else ids.get(sample.clip)
            if id is None:
                continue
            if not sample.prompt:
                raise InputError(
                    f"{folder} is made of videos without prompts; there is no text to fit"
                )
            load = partial(read_events, shard.path, sample)
            recording = Recording(id, sample.prompt, load, sample.label)
            found.setdefault(shard.record.variant, []).append(recording)
    if not found:
        where = "" if split is None else f" in split {split}"
        raise InputError(f"{folder} holds no sample of texvent{where}; make it first")
    return found


def list_streams(n_imagenet: Path, captioned: Sequence[Captioned]) -> list[Recording]:
    """N-ImageNet's streams of some captions.

    Raises:
        InputError: the folder holds no class, or lacks a stream.
    """
    root = validation_folder(n_imagenet)
    recordings = []
    for one in captioned:
        path = root / one.label / f"{one.id}{STREAM_EXTENSION}"
        if not path.is_file():
            raise InputError(f"{root} lacks {one.label}/{path.name}; its caption is there")
        recordings.append(Recording(one.id, one.caption, partial(load_stream, path), one.label))
    return recordings


def keep_common(
    sources: Mapping[str, Sequence[Recording]], *, limit: int | None = None
) -> dict[str, list[Recording]]:
    """The recordings whose ids all sources have, so that all rank the same texts.

    Args:
        sources: name → recordings.
        limit: keep at most this many ids, evenly spaced.

    Raises:
        InputError: they share no id.
    """
    ids = [set(recording.id for recording in one) for one in sources.values()]
    shared = sorted(set.intersection(*ids))
    if not shared:
        raise InputError(f"{' and '.join(sources)} share no id; were they made from one list?")
    if limit is not None and limit < len(shared):
        shared = [shared[number * len(shared) // limit] for number in range(limit)]
    kept = set(shared)
    return {
        name: [recording for recording in one if recording.id in kept]
        for name, one in sources.items()
    }


Image: TypeAlias = NDArray[np.uint8]
"""[H, W, 3] RGB."""
View: TypeAlias = Callable[[EventStream], list[Image]]
"""A recording → images of it, at least one."""

PALETTE = "paper"
EVENTS_PER_PIXEL = 70_000 / (640 * 480)
"""Events in one drawn image; EventCLIP takes 70,000 of N-ImageNet's 640x480."""
SLICE_PER_PIXEL = 0.35
"""Most events that a network sees at once, as in E2VID's program."""
FEWEST_SLICES = 5
"""A recurrent network needs a few slices before its image is one."""


@dataclass(frozen=True)
class DrawnEvents:
    """Runs of events, spread over the recording, each drawn as an image: ON blue, OFF red on white.

    Source: EventCLIP (Wu 2023), which draws runs of a fixed number of events and averages what
    CLIP says of them. Deviations: colours by count up to a percentile; the runs are spread evenly.
    """

    images: int = 4
    """Most images of a recording."""
    events_per_image: int | None = None
    """Events of a run; None: 70,000 at 640x480, in proportion for other sensors."""

    def __call__(self, events: EventStream) -> list[Image]:
        """The images; one, and blank, where there are no events."""
        from texvent.view.drawing.event_image import draw_events  # brings OpenCV
        from texvent.view.drawing.palettes import get_palette

        palette = get_palette(PALETTE)
        return [draw_events(count_events(run), palette) for run in self.runs(events)]

    def runs(self, events: EventStream) -> list[EventStream]:
        """The events of each image."""
        length = self.events_per_image or max(1, round(EVENTS_PER_PIXEL * _pixels(events.size)))
        count = min(self.images, max(1, len(events) // length))
        starts = np.linspace(0, max(0, len(events) - length), count).astype(int)
        return [events[int(start) : int(start) + length] for start in starts]


@dataclass(frozen=True)
class ReconstructedImages:
    """Images that a published network makes of the events, from the second half of a recording."""

    reconstructor: Reconstructor
    images: int = 4
    """Most images of a recording."""

    def __call__(self, events: EventStream) -> list[Image]:
        """The images.

        Raises:
            InputError, FileFormatError: as `Reconstructor.reconstruct`.
        """
        slices = event_slices(events)
        made = [image for _, image in self.reconstructor.reconstruct_all(enumerate(slices))]
        late = made[len(made) // 2 :]
        chosen = np.unique(np.linspace(0, len(late) - 1, self.images).round().astype(int))
        return [_as_rgb(late[int(place)]) for place in chosen]


def event_slices(events: EventStream) -> list[EventStream]:
    """A recording in slices of as many events, which follow one another."""
    most = SLICE_PER_PIXEL * _pixels(events.size)
    count = max(FEWEST_SLICES, math.ceil(len(events) / most))
    bounds = np.linspace(0, len(events), count + 1).astype(int)
    return [events[int(begin) : int(end)] for begin, end in itertools.pairwise(bounds)]


def _pixels(size: SensorSize) -> int:
    return size.width * size.height


def _as_rgb(image: NDArray[np.float32]) -> Image:
    levels = np.rint(np.clip(image, 0, 1) * 255).astype(np.uint8)
    return np.repeat(levels[:, :, None], 3, axis=2)
