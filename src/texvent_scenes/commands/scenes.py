"""`texvent scenes`: the nouns that embedded scenes can show, and the schema of scene files."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from rich.table import Table

from texvent._registry import suggest
from texvent.cli.notices import result_console, write_out
from texvent.cli.options import parse_configs
from texvent.errors import InputError, shown
from texvent_scenes.models.protocol import Noun
from texvent_scenes.scene_input import list_nouns, list_words
from texvent_scenes.spec.files import json_schema

DESCRIPTION = """List what prompts of the embedded generator can name: nouns by family, with their
other names; models of a folder of your own come first. With a word, the nouns that have it in a
name, and their sizes; `texvent generate "a car" --preview car.png` draws one.

  texvent scenes
  texvent scenes car
  texvent scenes --schema > scene.schema.json"""


@dataclass(frozen=True, kw_only=True)
class ScenesOptions:
    """Nouns to list."""

    positional: ClassVar[tuple[str, ...]] = ("word",)

    word: str | None = None
    """A noun, one of its other names, or a word of one."""
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
    rows = list(_families(nouns))
    titles = ["family", "noun", "also called"]
    if options.word is not None:
        titles.append("size")
        wanted = options.word.lower().strip()
        word = re.compile(rf"\b{re.escape(wanted)}\b")
        rows = [row for row in rows if any(map(word.search, _names(row[1])))]
        if not rows:
            known = tuple(name for noun in nouns.values() for name in _names(noun))
            raise InputError(f"{shown(wanted)} is no noun; {suggest(wanted, known)}")
    table = Table(*titles, box=None, pad_edge=False)
    for family, noun in rows:
        cells = [family, noun.name, ", ".join(_names(noun)[1:])]
        table.add_row(*cells, *([_size(noun)] if options.word is not None else []))
    with result_console() as console:
        console.print(table)
    return 0


def _names(noun: Noun) -> tuple[str, ...]:
    return (noun.name, *noun.synonyms, *noun.plurals)


def _size(noun: Noun) -> str:
    """Length, width and height, and the unit that was taken of an asset."""
    model = noun.build(colour=None, scale=1.0, seed=0)
    sides = " x ".join(f"{side:.3g}" for side in (model.length, model.width, model.height))
    note = getattr(model, "note", "")
    return f"{sides} m{f', {note}' if note else ''}"


def _families(nouns: Mapping[str, Noun]) -> Iterator[tuple[str, Noun]]:
    """Family and noun, assets first."""
    from texvent_scenes.assets.nouns import assets_of
    from texvent_scenes.models.nouns import FAMILIES

    for noun in nouns.values():
        if assets_of(noun):
            yield "assets", noun
    for family, members in FAMILIES.items():
        for member in members:
            noun = nouns[member.name]
            if not assets_of(noun):
                yield family, noun
