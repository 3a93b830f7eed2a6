"""Which models a folder holds, and what they are called: by file names, or by an index.

Any other `.toml` file has nouns as lists of parts; see docs/nouns.md.
An index is `assets.toml` in the folder, a table for each file.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError, few, shown
from texvent.scenes.models.parts import read_nouns

ENDINGS = (".glb", ".obj", ".ply")
INDEX_NAME = "assets.toml"
AXES = ("x", "-x", "y", "-y", "z", "-z")
HABITATS = ("ground", "air", "water", "fixed")
MOST_FILES = 20_000
_CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])")
_NUMBER = re.compile(r"\d+$")


@dataclass(frozen=True)
class Asset:
    """One model of a folder."""

    path: Path
    """Its file."""
    noun: str
    """What prompts call it: lower case, singular."""
    synonyms: tuple[str, ...] = ()
    """Other names."""
    height: float | None = None
    """Height in metres; None: see `length` and `scale`."""
    length: float | None = None
    """Longest side in metres."""
    scale: float | None = None
    """Metres per unit of the file."""
    up: str | None = None
    """Axis of the file that points up; None: y, for PLY z."""
    forward: str | None = None
    """Axis of the file that is its front; None: z, for PLY -y."""
    habitat: str | None = None
    """"ground", "air", "water" or "fixed"; None: as the embedded noun of that name."""
    motion: str | None = None
    """What it does if the prompt does not say; None: as the embedded noun of that name."""
    speed: float | None = None
    """Its usual speed, m/s; None: as the embedded noun of that name."""
    place: str | None = None
    """Where it usually is, such as "indoor"; None: as the embedded noun of that name."""


_KEYS = tuple(field.name for field in fields(Asset) if field.name != "path")


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
        tables = tomllib.loads(index.read_text(encoding="utf-8"))
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
    where = f"{index}, {shown(name)}"
    if not isinstance(table, dict):
        raise FileFormatError(f"{where}: a table is wanted, such as noun = 'chair'")
    unknown = [key for key in table if key not in _KEYS]
    if unknown:
        raise FileFormatError(f"{where}: unknown {few(unknown)}; there are {', '.join(_KEYS)}")
    values: dict[str, Any] = {"noun": bare.noun}
    for key, value in table.items():
        values[key] = _checked(where, key, value)
    return Asset(bare.path, **values)


def _checked(where: str, key: str, value: Any) -> Any:
    if key == "synonyms":
        if not (isinstance(value, list) and all(isinstance(word, str) for word in value)):
            raise FileFormatError(f"{where}: synonyms are a list of words, not {shown(value)}")
        return tuple(word.lower() for word in value)
    if key in ("height", "length", "scale", "speed"):
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        if not (is_number and 0.0 < value < 1e5):
            raise FileFormatError(f"{where}: {key} is a positive number, not {shown(value)}")
        return float(value)
    allowed = {"up": AXES, "forward": AXES, "habitat": HABITATS}.get(key)
    if not isinstance(value, str) or not value or (allowed and value not in allowed):
        options = f"one of {', '.join(allowed)}" if allowed else "a word"
        raise FileFormatError(f"{where}: {key} is {options}, not {shown(value)}")
    return value.lower()
