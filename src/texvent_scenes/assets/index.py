"""Models of a folder and their names: by file names, or by an index.

Any other `.toml` file has nouns as lists of parts; see docs/nouns.md.
An index is `assets.toml` in the folder, a table for each file.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from texvent.errors import ConfigError, FileFormatError, InputError, shown
from texvent_scenes.models.parts import read_nouns
from texvent_scenes.models.protocol import Habitat
from texvent_scenes.spec.data import build_table
from texvent_scenes.spec.limits import Between

ENDINGS = (".glb", ".obj", ".ply")
INDEX_NAME = "assets.toml"
Axis: TypeAlias = Literal["x", "-x", "y", "-y", "z", "-z"]
Size: TypeAlias = Annotated[float, Between(1e-9, 1e5)]
MOST_FILES = 20_000
_CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])")
_NUMBER = re.compile(r"\d+$")


@dataclass(frozen=True)
class Asset:
    """One model of a folder."""

    path: Path
    """Its file."""
    noun: str
    """Name in prompts: lower case, singular."""
    synonyms: tuple[str, ...] = ()
    """Other names."""
    height: Size | None = None
    """Height in metres; None: see `length` and `scale`."""
    length: Size | None = None
    """Longest side in metres."""
    scale: Size | None = None
    """Metres per unit of the file."""
    up: Axis | None = None
    """Axis of the file that points up; None: y, for PLY z."""
    forward: Axis | None = None
    """Axis of the file that is its front; None: z, for PLY -y."""
    habitat: Habitat | None = None
    """"ground", "air", "water" or "fixed"; None: as the embedded noun of that name."""
    motion: str | None = None
    """Motion if the prompt does not say; None: as the embedded noun of that name."""
    speed: Size | None = None
    """Its usual speed, m/s; None: as the embedded noun of that name."""
    place: str | None = None
    """Usual place, such as "indoor"; None: as the embedded noun of that name."""


def read_folder(folder: Path) -> tuple[Asset, ...]:
    """All models below a folder, by path; an index in a folder describes the files below it.

    Raises:
        InputError: the folder does not exist, or has no model or too many files.
        FileFormatError: an index is damaged, or names what does not exist.
    """
    if not folder.is_dir():
        raise InputError(f"the folder of assets {folder} does not exist")
    files = sorted(path for path in folder.rglob("*") if path.suffix.lower() in ENDINGS)
    lists = sorted(path for path in folder.rglob("*.toml") if path.name != INDEX_NAME)
    if not files and not lists:
        known = ", ".join(ENDINGS)
        raise InputError(f"{folder} holds no model; assets are {known} files, or .toml with parts")
    if len(files) > MOST_FILES:
        raise InputError(f"{folder} holds {len(files)} models; {MOST_FILES} are the most")
    found = {path: Asset(path, name_of(path)) for path in files}
    for index in sorted(folder.rglob(INDEX_NAME)):
        found.update(_read_index(index, found))
    parts = [Asset(path, one.name, one.synonyms) for path in lists for one in read_nouns(path)]
    return (*found.values(), *parts)


def name_of(path: Path) -> str:
    """The noun that a file name says: "Office_Chair-02.glb" is an "office chair"."""
    words = re.split(r"[^A-Za-z0-9]+", _CAMEL.sub(" ", path.stem))
    bare = [_NUMBER.sub("", word).lower() for word in words]
    return " ".join(word for word in bare if word) or path.stem.lower()


def _read_index(index: Path, known: Mapping[Path, Asset]) -> dict[Path, Asset]:
    try:
        tables = tomllib.loads(index.read_text(encoding="utf-8-sig"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise FileFormatError(f"{index} cannot be read: {error}") from error
    described = {}
    for name, table in tables.items():
        path = index.parent / name
        if path not in known:
            raise FileFormatError(f"{index} describes {shown(name)}, which is no model beside it")
        described[path] = _described(index, name, table, known[path])
    return described


def _described(index: Path, name: str, table: Any, bare: Asset) -> Asset:
    """An asset with what its table says."""
    own = {"path": bare.path}
    said = {"noun": bare.noun, **table, **own} if isinstance(table, dict) else table
    try:
        asset: Asset = build_table(Asset, said, f"{index}, {shown(name)}", {})
    except ConfigError as error:
        raise FileFormatError(str(error)) from None
    synonyms = tuple(word.lower() for word in asset.synonyms)
    return replace(asset, noun=asset.noun.lower(), synonyms=synonyms)
