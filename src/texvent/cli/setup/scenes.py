"""`texvent scenes`: the nouns that embedded scenes can show, and what they look like."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from rich.table import Table

from texvent._registry import suggest
from texvent.cli.notices import result_console, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_options
from texvent.errors import ConfigError, InputError, shown
from texvent.generate.scene_input import list_nouns, list_words
from texvent.io.atomic import atomic_file, check_output
from texvent.scenes.models.protocol import Noun
from texvent.scenes.spec.files import json_schema
from texvent.sensor import SensorSize

ACTIONS = ("list", "show", "--schema")
LIST_HELP = """List what prompts of the embedded generator can name: nouns by family, with
their other names; models of a folder of your own come first."""
SHOW_HELP = """Draw one noun as a PNG image: four views around it, or one with --views 1."""
SCHEMA_HELP = """Print the JSON Schema of scene files (docs/scenes.md), by which editors
complete and check them."""
SIZE = SensorSize(320, 240)
_TURN_S = 2.0
"""A spinning object turns once in this time."""


@dataclass(frozen=True, kw_only=True)
class ListOptions:
    """Which nouns."""

    assets: Path | None = None
    """Folder of models of your own (GLB, OBJ, PLY); see docs/assets.md."""


@dataclass(frozen=True, kw_only=True)
class ShowOptions:
    """Noun and its image."""

    positional: ClassVar[tuple[str, ...]] = ("noun",)
    short_flags: ClassVar[Mapping[str, str]] = {"output": "-o"}
    outputs: ClassVar[tuple[str, ...]] = ("output",)

    noun: str = REQUIRED
    """The noun, singular, or one of its other names."""
    output: Path = REQUIRED
    """The image to write, a .png file."""
    assets: Path | None = None
    """Folder of models of your own (GLB, OBJ, PLY); see docs/assets.md."""
    views: int = 4
    """Views around it, side by side: 1 to 12."""
    seed: int = 0
    """Another seed gives another variant."""
    overwrite: bool = False
    """Replace an existing file."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        write_out(
            "usage: texvent scenes list [--assets FOLDER]\n"
            "       texvent scenes show NOUN -o FILE.png [OPTIONS]\n"
            "       texvent scenes --schema [--assets FOLDER]\n\n"
            "What prompts of the embedded generator can name, and what it looks like.\n"
        )
        return 0 if arguments else 2
    action, *rest = arguments
    if action == "list":
        values = parse_options(
            rest, {"input": ListOptions()}, prog="texvent scenes list", description=LIST_HELP
        )
        return _list(**values)
    if action == "show":
        values = parse_options(
            rest, {"input": ShowOptions()}, prog="texvent scenes show", description=SHOW_HELP
        )
        return _show(ShowOptions(**values))
    if action == "--schema":
        values = parse_options(
            rest, {"input": ListOptions()}, prog="texvent scenes --schema", description=SCHEMA_HELP
        )
        return _write_schema(**values)
    raise ConfigError(f"unknown action 'scenes {action}'; {suggest(action, ACTIONS)}")


def _write_schema(assets: Path | None) -> int:
    write_out(f"{json.dumps(json_schema(list_words(list_nouns(assets))), indent=2)}\n")
    return 0


def _list(assets: Path | None) -> int:
    table = Table(box=None, pad_edge=False, header_style="bold")
    for title in ("family", "noun", "also called"):
        table.add_column(title, no_wrap=title == "noun")
    for family, noun in _families(assets):
        table.add_row(family, noun.name, ", ".join((*noun.synonyms, *noun.plurals)))
    with result_console() as console:
        console.print(table)
    return 0


def _families(assets: Path | None) -> Iterator[tuple[str, Noun]]:
    """Family and noun, assets first."""
    from texvent.scenes.assets.nouns import assets_of
    from texvent.scenes.models.nouns import FAMILIES

    nouns = list_nouns(assets)
    for noun in nouns.values():
        if assets_of(noun):
            yield "assets", noun
    for family, members in FAMILIES.items():
        for member in members:
            noun = nouns[member.name]
            if not assets_of(noun):
                yield family, noun


def _show(options: ShowOptions) -> int:
    if options.output.suffix.lower() != ".png":
        raise ConfigError(f"output is {options.output}; its name must end in .png")
    if not 1 <= options.views <= 12:
        raise ConfigError(f"views is {options.views}; it must be 1 to 12")
    check_output(options.output, overwrite=options.overwrite)
    nouns = list_nouns(options.assets)
    noun = _find(options.noun, nouns)
    image = _draw(noun, nouns, options)
    with atomic_file(options.output, overwrite=options.overwrite) as part:
        part.write_bytes(image)
    model = noun.build(colour=None, scale=1.0, seed=options.seed)
    sides = " x ".join(f"{side:.3g}" for side in (model.length, model.width, model.height))
    note = getattr(model, "note", "")
    write_out(f"{noun.name}: {sides} m{f', {note}' if note else ''}\n{options.output}\n")
    return 0


def _find(said: str, nouns: Mapping[str, Noun]) -> Noun:
    """The noun of a name or synonym, or the one that shows a kind."""
    from texvent.scenes.read import read

    wanted = said.lower().strip()
    if wanted in nouns:
        return nouns[wanted]
    found = read(wanted, nouns).scene.objects
    if found:
        return nouns[found[0].noun]
    raise InputError(f"{shown(said)} is no noun; {suggest(wanted, tuple(nouns), longest=220)}")


def _draw(noun: Noun, nouns: Mapping[str, Noun], options: ShowOptions) -> bytes:
    # Imported here: rendering brings Numba, which help and lists do not need.
    from texvent.generate.procedural import ProceduralConfig, ProceduralVideo
    from texvent.scenes.description import (
        ObjectMotion,
        SceneDescription,
        SceneObject,
        Surroundings,
    )
    from texvent.scenes.staging.compose import compose_scene
    from texvent.view.stills import draw_stills

    motion = ObjectMotion("spin" if options.views > 1 else "stand")
    description = SceneDescription(
        noun.name,
        objects=(SceneObject(noun.name, motion=motion),),
        surroundings=Surroundings("plain"),
    )
    scene = compose_scene(
        description, seed=options.seed, size=SIZE, duration_s=_TURN_S, nouns=nouns
    )
    video = ProceduralVideo(scene, SIZE, ProceduralConfig(duration=_TURN_S))
    step_us = round(1e6 * _TURN_S / options.views)
    return draw_stills(video, tuple(step_us * view for view in range(options.views)))
