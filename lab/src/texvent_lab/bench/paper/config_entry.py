"""The paper's ablations (Tables 4 and 5): one config file each, run on scenes with known events."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from texvent.errors import InputError
from texvent.settings.resolution import Settings, resolve
from texvent_lab.bench.fidelity.entries import Entry


@dataclass(frozen=True, kw_only=True)
class ConfigEntry(Entry):
    """A row whose options stand in a config file."""

    path: Path
    """TOML or YAML file."""

    @classmethod
    def read(cls, path: Path, *, is_rate_matched: bool = False) -> ConfigEntry:
        """The row of a config file.

        Raises:
            InputError: the file cannot be read.
            ConfigError: it is wrong.
        """
        settings = resolve("simulate", {}, config=path)
        return cls(
            simulator=settings.run.simulator,
            interpolate=settings.interpolate.interpolate,
            path=path,
            is_rate_matched=is_rate_matched,
        )

    @property
    def name(self) -> str:
        """The file's name without its extension."""
        return self.path.stem

    def settings(self, seed: int) -> Settings:
        """Resolved options of a run.

        Raises:
            ConfigError: the file holds an unknown option, or a value out of range.
        """
        return resolve("simulate", {"seed": seed}, config=self.path)


def read_ablations(folder: Path, *, is_rate_matched: bool = False) -> list[ConfigEntry]:
    """One row per config file of a folder, E2 before E10.

    Raises:
        InputError: there is no such folder, or no config file in it.
        ConfigError: a file is wrong.
    """
    paths = sorted(folder.glob("*.toml"), key=_by_number)
    if not paths:
        raise InputError(
            f"no config file in {folder}; give the folder configs/paper of the source "
            "distribution, or one with TOML files of your own"
        )
    return [ConfigEntry.read(path, is_rate_matched=is_rate_matched) for path in paths]


def _by_number(path: Path) -> tuple[str, int, str]:
    match = re.fullmatch(r"(\D*)(\d+)(.*)", path.stem)
    return (match[1], int(match[2]), match[3]) if match else (path.stem, -1, "")
