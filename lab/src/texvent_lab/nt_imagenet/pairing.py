"""Samples of ours beside the recorded streams that have the same caption."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from io import StringIO
from pathlib import Path

from texvent.dataset.generation.recipe import ITEMS_FILE, read_facts
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.specification.clips import clip_key, video_seed
from texvent.errors import FileFormatError, InputError, one_line
from texvent_lab.nt_imagenet.files import Captioned, Pair
from texvent_lab.nt_imagenet.selection import Stream


def list_pairs(
    folder: Path, captioned: Sequence[Captioned], streams: Sequence[Stream]
) -> list[Pair]:
    """Every sample of a data set whose prompt is one of the captions, with its recorded stream.

    Args:
        folder: data set that was made from the captions.
        captioned: the captions.
        streams: the recorded streams.

    Raises:
        InputError: no data set is there, or it was not made from these captions.
        FileFormatError: it is damaged.
    """
    ids = ids_of_clips(folder, captioned)
    by_id = {stream.id: stream for stream in streams}
    pairs = []
    for shard in StoredDataset.open(folder).shards():
        for sample in shard.samples:
            stream = by_id.get(ids.get(sample.clip, ""))
            if stream is not None:
                pairs.append(
                    Pair(
                        id=stream.id,
                        label=stream.wnid,
                        stream=stream.path.as_posix(),
                        stream_events=stream.events,
                        shard=shard.place,
                        key=sample.key,
                        events=sample.events,
                    )
                )
    return pairs


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
