"""Recordings with a text: samples of a data set, or N-ImageNet's streams with captions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.reading.stored_events import read_events
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.arrays.n_imagenet import load_stream
from texvent_lab.nt_imagenet.files import Captioned
from texvent_lab.nt_imagenet.selection import STREAM_EXTENSION, validation_folder


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
