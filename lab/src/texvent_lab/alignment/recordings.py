"""Recordings with a text: samples of a data set, or N-ImageNet's streams with captions."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from io import StringIO
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.generation.recipe import ITEMS_FILE, read_facts
from texvent.dataset.specification.clips import clip_key, video_seed
from texvent.dataset.stored.folder import StoredDataset
from texvent.errors import FileFormatError, InputError, one_line
from texvent.events import EventStream
from texvent.io.arrays.npz import load_stream
from texvent.represent.event_frame import count_events
from texvent_lab.nt_imagenet.files import Captioned
from texvent_lab.nt_imagenet.selection import STREAM_EXTENSION, validation_folder


@dataclass(frozen=True)
class TextRecording:
    """Events with the text they belong to."""

    id: str
    """Name that it shares with recordings of the same text in other sources."""
    text: str
    load: Callable[[], EventStream]
    key: str = ""
    """That of the sample; a clip has one per seed."""


def list_samples(
    folder: Path, *, split: str | None = None, ids: Mapping[str, str] | None = None
) -> dict[str, list[TextRecording]]:
    """The samples of a data set by variant.

    Args:
        folder: of the data set.
        split: take that split alone.
        ids: key of a clip → id; others are left out. Default: the keys themselves.

    Raises:
        InputError: it is no data set, there is no sample, or samples have no prompt.
        FileFormatError: the record of a shard is damaged.
    """
    found: dict[str, list[TextRecording]] = {}
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
            load = shard.files(sample).events
            recording = TextRecording(id, sample.prompt, load, sample.key)
            found.setdefault(shard.record.variant, []).append(recording)
    if not found:
        where = "" if split is None else f" in split {split}"
        raise InputError(f"{folder} holds no sample of texvent{where}; make it first")
    return found


def ids_of_clips(folder: Path, captioned: Sequence[Captioned]) -> Mapping[str, str]:
    """Key of a clip of a data set → id of its caption.

    Raises:
        InputError: no data set is there, or it was not made from these captions.
        FileFormatError: it is damaged.
    """
    known = {(one.seed, one.label, one.caption): one.id for one in captioned}
    specification = read_facts(folder).get("specification", {})
    path, ids = folder / ITEMS_FILE, dict[str, str]()
    try:
        root, repeats = int(specification["seed"]), int(specification["repeats"])
        items = [json.loads(line) for line in StringIO(path.read_text(encoding="utf-8"))]
        for item in items:
            id = known.get((item["seed"], item["label"], item["prompt"]))
            if id is not None:
                for repeat in range(repeats):
                    seed = video_seed(root, item["key"], item["seed"], repeat)
                    ids[clip_key(item["key"], seed)] = id
    except (OSError, ValueError, TypeError, KeyError, AttributeError) as error:
        raise FileFormatError(f"{path} is damaged ({one_line(error)})") from error
    if not ids:
        raise InputError(
            f"{folder} was not made from these captions; make it with texvent dataset make from "
            "the specification.toml beside them"
        )
    return ids


def list_streams(n_imagenet: Path, captioned: Sequence[Captioned]) -> list[TextRecording]:
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
        recordings.append(TextRecording(one.id, one.caption, partial(load_stream, path)))
    return recordings


def keep_common(
    sources: Mapping[str, Sequence[TextRecording]], *, limit: int | None = None
) -> dict[str, list[TextRecording]]:
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
        pixels = events.size.width * events.size.height
        length = self.events_per_image or max(1, round(EVENTS_PER_PIXEL * pixels))
        count = min(self.images, max(1, len(events) // length))
        starts = np.linspace(0, max(0, len(events) - length), count).astype(int)
        return [events[int(start) : int(start) + length] for start in starts]
