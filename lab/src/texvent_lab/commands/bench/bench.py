"""`texvent bench`: one benchmark per file, chosen by its name, and the options that all have."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from rich.console import Console

from texvent.cli.notices import write_out
from texvent.errors import ConfigError, shown
from texvent.extending import suggest
from texvent.io.atomic import check_output
from texvent_lab.bench.document import write_document

BENCHMARKS: Mapping[str, str] = {
    "detection": "whose events teach a detector most?",
    "digits": "do networks trained on simulated events read recorded ones?",
    "fidelity": "which simulator comes closest to true events of exact scenes?",
    "objects": "do detectors trained on simulated events find recorded objects?",
    "page": "a result of fidelity, real, digits, objects or selftest as a page",
    "paper": "the paper's tables, ablations E1-E12, or a folder of configs",
    "real": "which simulator is closest to a real sensor, in events or images?",
    "selftest": "20 perturbations of a recording: which does a metric see?",
}
"""Name, which is its module beside this one → the question that it answers."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        write_out(_usage())
        return 0 if arguments else 2
    name, *rest = arguments
    if name not in BENCHMARKS:
        raise ConfigError(f"unknown benchmark {shown(name)}; {suggest(name, tuple(BENCHMARKS))}")
    importlib.import_module(f"texvent_lab.commands.bench.{name}").run(rest)
    return 0


def _usage() -> str:
    width = max(map(len, BENCHMARKS))
    lines = [f"  {name:<{width}}  {question}" for name, question in BENCHMARKS.items()]
    usage = ["usage: texvent bench NAME [OPTIONS]", "", *lines]
    return "\n".join([*usage, "", "Help: texvent bench NAME --help", ""])


@dataclass(frozen=True, kw_only=True)
class ResultOptions:
    """Output of the result."""

    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    out: Path | None = None
    """JSON file with every value; a name that ends in .json.gz compresses it."""
    overwrite: bool = False
    """Replace a file that exists already."""
    quiet: bool = False
    """No progress; only the result."""

    def check(self) -> None:
        """Refuse a file that exists already, before anything is computed.

        Raises:
            OutputError: it cannot be written.
        """
        if self.out is not None:
            check_output(self.out, overwrite=self.overwrite)

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
