"""The options that say where a benchmark's result goes, and whether progress is shown."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from rich.console import Console

from texvent.io.atomic import check_output
from texvent_lab.bench.document import write_document


@dataclass(frozen=True, kw_only=True)
class ResultOptions:
    """Where the result goes."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    out: Path | None = None
    """JSON file with every value; a name that ends in .json.gz compresses it."""
    overwrite: bool = False
    """Replace a file that exists already."""
    quiet: bool = False
    """No progress; only the result."""

    def check(self, *more: Path | None) -> None:
        """Refuse files that exist already, before anything is computed.

        Args:
            more: files that the command writes in addition to `out`.

        Raises:
            OutputError: a file cannot be written.
        """
        for path in (self.out, *more):
            if path is not None:
                check_output(path, overwrite=self.overwrite)

    def progress(self, line: str) -> None:
        """Show a step on the terminal, unless `quiet`."""
        console = Console(stderr=True, quiet=self.quiet, highlight=False)
        console.print(line, style="dim", markup=False)

    def write(self, document: Callable[[], Any]) -> None:
        """Write the result, if it is wanted.

        Args:
            document: makes the plain values.

        Raises:
            OutputError: the file cannot be written.
        """
        if self.out is not None:
            write_document(self.out, document(), overwrite=self.overwrite)
