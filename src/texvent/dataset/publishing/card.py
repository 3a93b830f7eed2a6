"""The card of a data set: README.md as the Hugging Face Hub shows and reads it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import yaml

from texvent.dataset.contents.made_set import MadeSet
from texvent.dataset.contents.statistics import SetStatistics, Statistics, number_text
from texvent.dataset.generation.recipe import VIDEOS
from texvent.dataset.generation.tar_shard import EXTENSION
from texvent.dataset.publishing.features import features_of
from texvent.dataset.publishing.how_to_load import loading_text
from texvent.dataset.publishing.notice import Notice

CARD_FILE = "README.md"
TAGS = ("event-camera", "neuromorphic", "synthetic", "webdataset", "croissant", "texvent")
SIZES = (("n<1K", 10**3), ("1K<n<10K", 10**4), ("10K<n<100K", 10**5), ("100K<n<1M", 10**6),
         ("1M<n<10M", 10**7), ("10M<n<100M", 10**8))  # fmt: skip
LARGEST = "n>100M"
NUMBER = "??????"
"""Of a shard, as a pattern. A star would also find those of "train-hard" for "train"."""


def card_text(made: MadeSet, statistics: SetStatistics, notice: Notice, *, missing: int) -> str:
    """The card, header included.

    Args:
        made: the data set.
        statistics: of it.
        notice: what its author says.
        missing: shards that are not there.
    """
    header = yaml.safe_dump(
        _header(made, statistics, notice), sort_keys=False, allow_unicode=True, width=100
    )
    parts = [
        f"---\n{header}---",
        notice.MARK,
        f"# {made.name}",
        str(made.specification.get("description") or ""),
        f"{missing} shards are missing: this is a part of the data set." if missing else "",
        _what(made, statistics.total),
        "![Samples](samples.png)" if (made.folder / "samples.png").is_file() else "",
        notice.notes.strip(),
        "## What there is",
        _counts(statistics),
        _classes(statistics.total),
        "## How to load it",
        loading_text(made, next(iter(statistics.parts))),
        "## How it was made",
        _making(made, statistics.total),
        "## Limits",
        _limits(statistics.total),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def _header(made: MadeSet, statistics: SetStatistics, notice: Notice) -> dict[str, Any]:
    configs, features = [], []
    for number, variant in enumerate(dict.fromkeys(one for one, _ in statistics.parts)):
        splits = [split for one, split in statistics.parts if one == variant]
        files = [
            {"split": hub_name(split), "path": f"{variant}/{split}-{NUMBER}{EXTENSION}"}
            for split in splits
        ]
        is_first = {"default": True} if number == 0 else {}
        configs.append({"config_name": variant, **is_first, "data_files": files})
        features.append({"config_name": variant, "features": features_of(made, variant)})
    return {
        "license": notice.license_of(made) or "unknown",
        "pretty_name": made.name,
        "task_categories": ["text-to-video", "other"],
        "size_categories": [size_category(statistics.total.samples)],
        "tags": [*TAGS],
        "configs": configs,
        "dataset_info": features,
    }


def hub_name(split: str) -> str:
    """A split as Hugging Face allows it to be called."""
    return split.replace("-", "_")


def size_category(samples: int) -> str:
    """As the Hub names sizes.

    Example:
        >>> size_category(999), size_category(1000)
        ('n<1K', '1K<n<10K')
    """
    return next((name for name, bound in SIZES if samples < bound), LARGEST)


def _what(made: MadeSet, total: Statistics) -> str:
    sensors = ", ".join(total.sensors)
    seconds = sum(total.durations_us) / 1e6
    return (
        f"{total.samples:,} samples of {len(total.clips):,} videos: {sum(total.events):,} "
        f"simulated events of an event camera in {seconds:,.1f} s ({sensors} pixels), each sample "
        "with its caption and with all that made it. An event is a column x, a row y (from the "
        "top left), a time t in µs and a polarity p (1: brighter, 0: darker)."
    )


def _counts(statistics: SetStatistics) -> str:
    lines = [
        "| variant | split | samples | events | events per sample (median) | seconds per sample "
        "| events per second (median) | MB |",
        "|---|---|---:|---:|---:|---:|---:|---:|",
    ]
    for (variant, split), part in statistics.parts.items():
        facts = part.tables
        lines.append(
            f"| {variant} | {split} | {part.samples:,} | {sum(part.events):,} | "
            f"{_median(facts['events_per_sample'])} | {_median(facts['duration_s_per_sample'])} | "
            f"{_median(facts['events_per_second'])} | {part.bytes / 1e6:,.1f} |"
        )
    return "\n".join(lines)


def _median(facts: Mapping[str, float]) -> str:
    return number_text(facts["median"]) if facts else "–"


def _classes(total: Statistics) -> str:
    if not total.classes:
        return ""
    counts = sorted(total.classes.values())
    return (
        f"{len(counts)} classes, {counts[0]:,} to {counts[-1]:,} samples of each; numbers follow "
        "the alphabet."
    )


def _making(made: MadeSet, total: Statistics) -> str:
    versions = ", ".join(sorted(total.versions))
    kept = {name: one for name, one in made.specification.items() if name != "sources"}
    lines = [
        f"With `texvent dataset make` of texvent {versions}, identity `{made.identity[:16]}`. The "
        "`.json` of a sample holds every option, the seed and the source of that sample; "
        "`specification.json` holds what decided all of them:",
        f"```json\n{json.dumps(kept, indent=1, ensure_ascii=False)}\n```",
    ]
    if made.is_merged:
        names = ", ".join(str(one["specification"]["name"]) for one in made.facts["merged"])
        lines.insert(0, f"Merged from {names} with `texvent dataset merge`.")
    if made.has_videos:
        lines.append(
            f"The videos themselves lie in `{VIDEOS}/` (lossless AVI, one per clip); no loader "
            "reads them unless it is told to."
        )
    return "\n\n".join(lines)


def _limits(total: Statistics) -> str:
    lines = [
        "Events are simulated, not recorded: no sensor was there, and what a model of the camera "
        "leaves out is not in them. Test on recordings what is trained on these.",
        "Captions are the prompts that the videos were made from. They say what was asked for, "
        "not what can be seen; the video may show less.",
    ]
    doubtful = sum(total.warnings.values())
    if doubtful:
        lines.append(
            f"{doubtful:,} samples carry a warning, such as a word that was not understood: see "
            "`warnings` in the index."
        )
    if total.left_out or total.failed:
        lines.append(
            f"{len(total.left_out):,} samples were left out and {total.failed:,} failed; the "
            "records beside the shards name each with its reason."
        )
    if len(total.versions) > 1:
        lines.append("Its shards were made by several versions of texvent, whose events differ.")
    return "\n".join(f"- {line}" for line in lines)
