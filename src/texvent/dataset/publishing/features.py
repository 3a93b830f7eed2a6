"""The types of a sample's members as Hugging Face `datasets` is told them in the card.

Without this, `datasets` guesses from the first five samples, and the settings in `.json` differ
from sample to sample: a list that is empty in those five would make it refuse a later one.
"""

from __future__ import annotations

from typing import Any

from texvent.dataset.contents.made_set import MadeSet
from texvent.dataset.generation.records import SampleRecord

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
"""Member → its type; that of `cls` names the classes."""


def features_of(made: MadeSet, variant: str) -> list[dict[str, Any]]:
    """The features of a variant, as the Hub writes them."""
    members, is_long = dict[str, None](), False
    for shard in made.shards(variant):
        for sample in shard.samples:
            members |= dict.fromkeys(sample.members)
            is_long = is_long or _has_long_times(sample)
    types = {**TYPES, "cls": _class_type(made.labels)}
    if is_long:
        types["t.npy"] = {"list": "int64"}
    known = [{"name": name, **types[name]} for name in members if name in types]
    return [*known, *({"name": name, "dtype": "string"} for name in ("__key__", "__url__"))]


def _class_type(labels: tuple[str, ...]) -> dict[str, Any]:
    return {"dtype": {"class_label": {"names": {str(n): one for n, one in enumerate(labels)}}}}


def _has_long_times(sample: SampleRecord) -> bool:
    """True if the times have 8 bytes: the column p has one per event, and the same header."""
    (_, times), (_, polarities) = sample.members["t.npy"], sample.members["p.npy"]
    return sample.events > 0 and times - polarities == 7 * sample.events
