"""`texvent scenes`: the words of embedded scenes, and the schema of scene files."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from rich.table import Table

from texvent._registry import suggest
from texvent.cli.notices import result_console, write_out
from texvent.cli.options import parse_configs
from texvent.errors import InputError, shown
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.protocol import Noun
from texvent_scenes.scene_input import list_nouns, list_words
from texvent_scenes.spec.files import json_schema
from texvent_scenes.vocabulary import list_families, list_kinds, names_of
from texvent_scenes.words import list_plurals

DESCRIPTION = """List what prompts of the embedded generator can name: nouns by family, with their
other names, models of a folder of your own first; then motions, activities, places, lights,
weather, effects, colours, materials and camera moves. With a word, those that have it in a name, of
nouns with the size (length x width x height, length along x at heading 0) and the motions of their
own; `texvent generate "a car" --preview car.png` draws one.

  texvent scenes
  texvent scenes car
  texvent scenes walk
  texvent scenes --schema > scene.schema.json"""


@dataclass(frozen=True, kw_only=True)
class ScenesOptions:
    """Words to list."""

    positional: ClassVar[tuple[str, ...]] = ("word",)

    word: str | None = None
    """A noun, an activity or another entry, one of its other names, or a word of one."""
    assets: Path | None = None
    """Folder of models of your own (GLB, OBJ, PLY); see docs/assets.md."""
    schema: bool = False
    """Print the JSON Schema of scene files (docs/scenes.md), by which editors complete and check
    them."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments, {"input": ScenesOptions()}, prog="texvent scenes", description=DESCRIPTION
    )
    nouns = list_nouns(options.assets)
    if options.schema:
        write_out(f"{json.dumps(json_schema(list_words(nouns)), indent=2)}\n")
        return 0
    rows: list[tuple[str, tuple[str, ...], Noun | None]] = [
        (family, names_of(noun), noun) for family, noun in list_families(nouns)
    ]
    rows += [(kind, names, None) for kind, names in list_kinds()]
    titles = ["family", "word", "also called"]
    if options.word is not None:
        titles += ["size", "motions of its own"]
        wanted = options.word.lower().strip()
        word = re.compile(rf"\b{re.escape(wanted)}\b")
        known = tuple(name for _, names, _ in rows for name in names)
        rows = [
            row
            for row in rows
            if any(word.search(name) or wanted in list_plurals(name) for name in row[1])
        ]
        if not rows:
            raise InputError(f"{shown(wanted)} is in no list; {suggest(wanted, known)}")
    table = Table(*titles, box=None, pad_edge=False)
    for family, names, noun in rows:
        more = [] if options.word is None else ["", ""] if noun is None else _tell(noun)
        table.add_row(family, names[0], ", ".join(names[1:]), *more)
    with result_console() as console:
        console.print(table)
    return 0


def _tell(noun: Noun) -> list[str]:
    """Its size, and the motions that it has beside those of all bodies, the usual one first."""
    usual = "work" if noun.is_working else noun.motion
    kinds = [usual, *(["activities"] if noun.name in PERSON_NOUNS else sorted(noun.acts))]
    return [_size(noun), ", ".join(dict.fromkeys(kinds))]


def _size(noun: Noun) -> str:
    """Length, width and height, and the unit that was taken of an asset."""
    model = noun.build(colour=None, scale=1.0, seed=0)
    sides = " x ".join(f"{side:.3g}" for side in (model.length, model.width, model.height))
    note = getattr(model, "note", "")
    return f"{sides} m{f', {note}' if note else ''}"
