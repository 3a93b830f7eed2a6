"""Annotated sentences: what a person reads in a prompt.

A file of JSON, a list of:

    {"id": "g1", "prompt": "Two red cars drive past a tree, then stop.",
     "things": [{"noun": "car", "count": 2, "attributes": ["red"]}, {"noun": "tree"}],
     "actions": [{"verb": "drive", "subject": "car", "order": 1},
                 {"verb": "stop", "subject": "car", "order": 2}],
     "relations": [["car", "past", "tree"]],
     "place": null, "light_weather": null, "camera": null, "negated": []}

`object` of an action is what is kicked or held; `order` says which comes first. `"implied": true`
marks what the sentence does not name. A text, a list of texts or null may stand for place,
light_weather, camera and negated.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.errors import InputError, one_line


@dataclass(frozen=True)
class GoldThing:
    """A thing that the prompt names."""

    noun: str
    count: int | str | None = None
    attributes: tuple[str, ...] = ()
    is_implied: bool = False
    """Whether a person adds it: the racket of a tennis serve."""


@dataclass(frozen=True)
class GoldAction:
    """What a thing does."""

    verb: str
    subject: str
    object: str | None = None
    order: int | None = None
    is_implied: bool = False


@dataclass(frozen=True)
class GoldSentence:
    """A prompt and what it says."""

    id: str
    prompt: str
    things: tuple[GoldThing, ...]
    actions: tuple[GoldAction, ...]
    relations: tuple[tuple[str, str, str], ...]
    place: tuple[str, ...]
    light_weather: tuple[str, ...]
    camera: tuple[str, ...]
    negated: tuple[str, ...]


def read_gold(path: Path) -> list[GoldSentence]:
    """The annotated sentences of a file.

    Raises:
        InputError: it cannot be read, or an entry is not of the form above.
    """
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"cannot read {path} ({one_line(error)})") from error
    if not isinstance(entries, list) or not entries:
        raise InputError(f"{path} must be a list of annotated prompts")
    found = []
    for number, entry in enumerate(entries, 1):
        try:
            found.append(_sentence(entry))
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise InputError(
                f"{path}, entry {number} is not of the form that benchmarks/prompts/gold.py "
                f"describes ({one_line(error)})"
            ) from error
    return found


def _sentence(entry: Mapping[str, Any]) -> GoldSentence:
    actions = (
        GoldAction(
            str(one["verb"]),
            _plain(one["subject"]),
            _text(one.get("object")),
            one.get("order"),
            bool(one.get("implied")),
        )
        for one in entry.get("actions") or ()
        if one.get("subject")
    )
    things = (
        GoldThing(
            _plain(one["noun"]),
            one.get("count"),
            _texts(one.get("attributes")),
            bool(one.get("implied")),
        )
        for one in entry.get("things") or ()
    )
    relations = ((_plain(a), str(b), _plain(c)) for a, b, c in entry.get("relations") or ())
    return GoldSentence(
        id=str(entry["id"]),
        prompt=str(entry["prompt"]),
        things=tuple(things),
        actions=tuple(actions),
        relations=tuple(relations),
        place=_texts(entry.get("place")),
        light_weather=_texts(entry.get("light_weather")),
        camera=_texts(entry.get("camera")),
        negated=_texts(entry.get("negated")),
    )


def _plain(noun: Any) -> str:
    """A noun without its gloss: "crane" for "crane (machine)"."""
    return re.sub(r"\s*\(.*\)", "", str(noun))


def _text(value: Any) -> str | None:
    return str(value) if value else None


def _texts(value: Any) -> tuple[str, ...]:
    if not value:
        return ()
    return (value,) if isinstance(value, str) else tuple(str(one) for one in value)
