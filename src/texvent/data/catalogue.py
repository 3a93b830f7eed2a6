"""Data sets of `texvent data pull`, read from `catalogue.toml`.

None of them belongs to texvent and none is in the repository.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from importlib.resources import files
from typing import Literal

from texvent._registry import suggest
from texvent.errors import ConfigError, shown


@dataclass(frozen=True)
class Archive:
    """One release file of a package on the registry."""

    package: str
    version: str
    filename: str
    kind: Literal["sdist", "wheel"]
    sha256: str
    size: int
    """Bytes."""


@dataclass(frozen=True)
class DataFile:
    """One file of an archive."""

    member: str
    """Its path in the archive."""
    sha256: str

    @property
    def name(self) -> str:
        """Its name in the data set's folder, as in the archive."""
        return self.member.rpartition("/")[2]


@dataclass(frozen=True)
class DataFolder:
    """All files right inside a folder of an archive."""

    member: str
    """The folder's path in the archive."""
    count: int
    """Number of files."""
    sha256: str
    """Digest of the text that `sha256sum` prints for them in order of name: `digest  name`, one per
    line."""

    @property
    def name(self) -> str:
        """Its name in the data set's folder, as in the archive."""
        return self.member.rpartition("/")[2]


@dataclass(frozen=True)
class DataSet:
    """A recording or clip, by the name the user types."""

    name: str
    description: str
    archive: Archive
    files: tuple[DataFile, ...]
    caveat: str
    """Known facts about its licence; shown before the download."""
    folders: tuple[DataFolder, ...] = ()
    frame_offset_us: int = 0
    """Added to the times of its frames, µs, so that they fit its events: found once by
    `texvent calibrate` and kept, so that no benchmark fits it again."""

    @property
    def path(self) -> str:
        """The path to open, within the data set's folder: its only file, or the folder itself."""
        return "" if self.folders or len(self.files) > 1 else self.files[0].name


def _read_catalogue() -> dict[str, DataSet]:
    text = files(__package__).joinpath("catalogue.toml").read_text(encoding="utf-8")
    table = tomllib.loads(text)
    archives = {name: Archive(name, **facts) for name, facts in table["archives"].items()}
    return {
        name: DataSet(
            name=name,
            archive=archives[facts.pop("archive")],
            files=tuple(DataFile(**one) for one in facts.pop("files")),
            folders=tuple(DataFolder(**one) for one in facts.pop("folders", ())),
            **facts,
        )
        for name, facts in table["sets"].items()
    }


DATA_SETS: dict[str, DataSet] = _read_catalogue()
"""Name → data set."""


def find_data_set(name: str) -> DataSet:
    """The data set called `name`.

    Raises:
        ConfigError: there is none.
    """
    if name not in DATA_SETS:
        raise ConfigError(f"unknown data set {shown(name)}; {suggest(name, tuple(DATA_SETS))}")
    return DATA_SETS[name]
