"""Publication of a data set: its card, README.md, as the Hugging Face Hub shows and reads it."""

from __future__ import annotations

import json
from typing import Any

import yaml

from texvent.dataset.generation.shards import EXTENSION
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.statistics import COUNTS, DatasetStatistics, Statistics, counts_rows
from texvent.errors import InputError, OutputError, warn
from texvent.io.atomic import atomic_file

CARD_FILE = "README.md"
MARK = "<!-- written by texvent dataset publish -->"
"""In cards of ours, which may be replaced."""
TAGS = ("event-camera", "neuromorphic", "synthetic", "webdataset", "texvent")
SIZES = (("n<1K", 10**3), ("1K<n<10K", 10**4), ("10K<n<100K", 10**5), ("100K<n<1M", 10**6),
         ("1M<n<10M", 10**7), ("10M<n<100M", 10**8))  # fmt: skip
NUMBER = "??????"
"""Pattern of shard numbers. A star would also find those of "train-hard" for "train"."""
TYPES: dict[str, dict[str, Any]] = {
    "x.npy": {"list": "uint16"},
    "y.npy": {"list": "uint16"},
    "t.npy": {"list": "uint32"},
    "p.npy": {"list": "uint8"},
    "label.npy": {"list": "uint8"},
    "json": {"dtype": "json"},
    "txt": {"dtype": "string"},
    "png": {"dtype": "image"},
}
"""Member → its type in Hugging Face `datasets`, which would guess it from the first five samples,
where a list in `.json` may be empty."""
BODY = """# {name}

{description}

{samples} samples of {clips} videos: {events} simulated events of an event camera in {seconds} s
({sensors} pixels), each sample with its caption and with all that made it. An event is a column x,
a row y (from the top left), a time t in µs and a polarity p (1: brighter, 0: darker).

{notes}

## Counts

{counts}

## How to load it

With texvent:

```python
import texvent.dataset

samples = texvent.dataset.open("DIR", variant="{variant}", split="{split}")
events, caption = samples[0].events, samples[0].caption
```

With [webdataset](https://github.com/webdataset/webdataset):

```python
import webdataset

samples = webdataset.WebDataset("DIR/{first}", shardshuffle=False).decode()
for sample in samples:
    x, y, t, p = (sample[f"{{name}}.npy"] for name in "xytp")
    caption = sample["txt"]
```

With [datasets](https://github.com/huggingface/datasets) 4.7 or newer, from the Hub or a folder:

```python
from datasets import load_dataset

samples = load_dataset("DIR", "{variant}", split="{hub_split}")
times = samples.select_columns(["t.npy"]).with_format("numpy")[0]["t.npy"]
```

## How it was made

{making}

## Limits

- Events are simulated, not recorded, and lack what the model of the camera leaves out. Test on
  recordings.
- Captions are the prompts that the videos were made from; a video may show less.
{limits}
"""
MOST_NAMED = 3


def publish(
    dataset: StoredDataset, *, license: str | None = None, notes: str = "", partial: bool = False
) -> tuple[DatasetStatistics, int]:
    """Write the card of a data set; equal shards give equal bytes.

    Args:
        dataset: the data set.
        license: such as "cc-by-4.0"; None: that of the specification.
        notes: further text of the card, Markdown.
        partial: whether shards may be missing.

    Returns:
        The statistics, and the number of shards that are missing.

    Raises:
        InputError: shards are missing, or there are no samples.
        OutputError: the card cannot be written, or is another's.
    """
    missing = dataset.missing()
    statistics = DatasetStatistics.of(dataset)
    if missing and not partial:
        raise InputError(
            f"{len(missing)} shards are missing, such as {', '.join(missing[:MOST_NAMED])}; make "
            "them (texvent dataset make), or publish what there is with --partial"
        )
    if not statistics.total.samples:
        raise InputError(f"{dataset.folder} holds no samples to publish")
    card = dataset.folder / CARD_FILE
    if card.exists() and MARK not in card.read_text("utf-8", errors="replace"):
        raise OutputError(
            f"{card} was not written by texvent; move it away, or put its text into a file and "
            "give that with --notes"
        )
    license = license or str(dataset.specification.get("license") or "")
    if not license:
        warn("no licence is stated, so others may not use the data set; state one with --license")
    text = card_text(dataset, statistics, license=license, notes=notes, missing=len(missing))
    with atomic_file(card, overwrite=True) as part:
        part.write_text(text, encoding="utf-8")
    return statistics, len(missing)


def card_text(
    dataset: StoredDataset, statistics: DatasetStatistics, *, license: str, notes: str, missing: int
) -> str:
    """The card, header included.

    Args:
        dataset: the data set.
        statistics: of it.
        license: such as "cc-by-4.0"; "" if none is stated.
        notes: further text, Markdown.
        missing: number of shards that are not there.
    """
    total, (variant, split) = statistics.total, next(iter(statistics.parts))
    first = next(one for one in dataset.shards(variant) if one.record.split == split)
    if missing:
        notes = f"{missing} shards are missing: this is a part of the data set.\n\n{notes}"
    body = BODY.format(
        name=dataset.name,
        description=dataset.specification.get("description") or "",
        samples=f"{total.samples:,}",
        clips=f"{len(total.clips):,}",
        events=f"{sum(total.events):,}",
        seconds=f"{sum(total.durations_us) / 1e6:,.1f}",
        sensors=", ".join(total.sensors),
        notes=notes.strip(),
        counts="\n".join(_table(statistics)),
        variant=variant,
        split=split,
        hub_split=hub_name(split),
        first=first.place,
        making=_making(dataset, total),
        limits="\n".join(f"- {line}" for line in _limits(total)),
    )
    header = yaml.safe_dump(
        _header(dataset, statistics, license), sort_keys=False, allow_unicode=True, width=100
    )
    return f"---\n{header}---\n\n{MARK}\n\n{body}"


def _header(dataset: StoredDataset, statistics: DatasetStatistics, license: str) -> dict[str, Any]:
    configs, features = [], []
    for number, variant in enumerate(dict.fromkeys(one for one, _ in statistics.parts)):
        splits = [split for one, split in statistics.parts if one == variant]
        files = [
            {"split": hub_name(split), "path": f"{variant}/{split}-{NUMBER}{EXTENSION}"}
            for split in splits
        ]
        is_first = {"default": True} if number == 0 else {}
        configs.append({"config_name": variant, **is_first, "data_files": files})
        features.append({"config_name": variant, "features": _features(dataset, variant)})
    samples = statistics.total.samples
    return {
        "license": license or "unknown",
        "pretty_name": dataset.name,
        "task_categories": ["text-to-video", "other"],
        "size_categories": [next((name for name, least in SIZES if samples < least), "n>100M")],
        "tags": [*TAGS],
        "configs": configs,
        "dataset_info": features,
    }


def hub_name(split: str) -> str:
    """Name of a split that Hugging Face allows."""
    return split.replace("-", "_")


def _features(dataset: StoredDataset, variant: str) -> list[dict[str, Any]]:
    """Types of the members of a variant, as the Hub writes them."""
    members, types = dict[str, None](), dict(TYPES)
    names = {str(number): label for number, label in enumerate(dataset.labels)}
    types["cls"] = {"dtype": {"class_label": {"names": names}}}
    for shard in dataset.shards(variant):
        for sample in shard.samples:
            members |= dict.fromkeys(sample.members)
            (_, times), (_, polarities) = sample.members["t.npy"], sample.members["p.npy"]
            # Both columns have one header and one number per event; times of 8 bytes are int64.
            if sample.events and times - polarities == 7 * sample.events:
                types["t.npy"] = {"list": "int64"}
    known = [{"name": name, **types[name]} for name in members if name in types]
    return [*known, *({"name": name, "dtype": "string"} for name in ("__key__", "__url__"))]


def _table(statistics: DatasetStatistics) -> list[str]:
    rows = [list(COUNTS), ["---"] * len(COUNTS), *counts_rows(statistics)]
    lines = [f"| {' | '.join(row)} |" for row in rows]
    counts = sorted(statistics.total.classes.values())
    if counts:
        lines += ["", f"{len(counts)} classes, {counts[0]:,} to {counts[-1]:,} samples of each; "
                  "numbers follow the alphabet."]  # fmt: skip
    return lines


def _making(dataset: StoredDataset, total: Statistics) -> str:
    kept = {name: one for name, one in dataset.specification.items() if name != "sources"}
    lines = [
        f"With `texvent dataset make` of texvent {', '.join(sorted(total.versions))}, identity "
        f"`{dataset.identity[:16]}`. The `.json` of a sample holds every option, the seed and the "
        "source of that sample; `specification.json` holds what decided all of them:",
        f"```json\n{json.dumps(kept, indent=1, ensure_ascii=False)}\n```",
    ]
    return "\n\n".join(lines)


def _limits(total: Statistics) -> list[str]:
    lines = []
    doubtful = sum(total.warnings.values())
    if doubtful:
        lines.append(
            f"{doubtful:,} samples carry a warning, which the records beside the shards state."
        )
    if total.left_out or total.failed:
        lines.append(
            f"{total.left_out:,} samples were left out and {total.failed:,} failed; the "
            "records beside the shards name each with its reason."
        )
    if len(total.versions) > 1:
        lines.append("Its shards were made by several versions of texvent, whose events differ.")
    return lines
