"""`list` and `pull` of what can be downloaded by name: `texvent data` and `texvent weights`."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, DownloadColumn, Progress, TextColumn, TransferSpeedColumn
from rich.table import Table

from texvent._registry import suggest
from texvent.cli.notices import result_console, write_out
from texvent.cli.options import parse_options, refuse_arguments
from texvent.errors import ConfigError

ACTIONS = ("list", "pull")


@dataclass(frozen=True)
class Downloads:
    """A command whose entries are listed and pulled by name."""

    command: str
    """Such as "data"."""
    purpose: str
    """Description of the entries, one sentence."""
    pull_description: str
    """First lines of the help of `pull`."""
    options: Any
    """Config instance of `pull`, with the options `name` and `quiet`."""
    entries: Callable[[], Iterable[tuple[str, bool, int, str]]]
    """Name, whether it is here, bytes to download and description of each."""
    pull: Callable[..., Path]
    """Takes the options by name, `progress` and `announce`; returns the path."""

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
        return self._list(rest) if action == "list" else self._pull(rest)

    def _list(self, arguments: Sequence[str]) -> int:
        refuse_arguments(arguments, prog=f"texvent {self.command} list", description=self.purpose)
        table = Table(box=None, pad_edge=False, header_style="bold")
        for title in ("name", "here", "download", "what it is"):
            table.add_column(title)
        for name, is_here, size, description in self.entries():
            table.add_row(name, "yes" if is_here else "", f"{size / 2**20:.0f} MB", description)
        with result_console() as console:
            console.print(table)
            console.print(
                f"Terms of use are shown before a download: texvent {self.command} pull NAME",
                style="dim",
            )
        return 0

    def _pull(self, arguments: Sequence[str]) -> int:
        values = parse_options(
            arguments,
            {"input": self.options},
            prog=f"texvent {self.command} pull",
            description=self.pull_description,
        )
        is_quiet = values.pop("quiet")
        console = Console(stderr=True, quiet=is_quiet, highlight=False)
        path = self.pull(
            **values,
            progress=show_progress if console.is_terminal and not is_quiet else None,
            announce=lambda line: console.print(line, markup=False),
        )
        write_out(f"{path}\n")
        return 0


@contextlib.contextmanager
def show_progress(total: int | None) -> Iterator[Any]:
    """A bar on standard error, so that results can be piped; total: bytes, if known."""
    columns = (TextColumn("download"), BarColumn(), DownloadColumn(), TransferSpeedColumn())
    with Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task("download", total=total)
        yield SimpleNamespace(update=lambda increment: bar.update(task, advance=increment))
