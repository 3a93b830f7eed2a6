"""`texvent bench unpaired`: simulated streams against recorded ones of other scenes."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import ClassVar

from rich.console import Console

from texvent.bench.document import write_document
from texvent.bench.environment import describe_environment
from texvent.bench.unpaired import compare_folders
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_options
from texvent.config import check_range
from texvent.io.atomic import check_output

SCHEMA = "texvent-unpaired-1"


@dataclass(frozen=True, kw_only=True)
class UnpairedOptions:
    """Which folders, and where to keep the result."""

    positional: ClassVar[tuple[str, ...]] = ("simulated", "recorded")
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    simulated: Path = REQUIRED
    """Folder of event files to judge, such as those that texvent batch made of captions."""
    recorded: Path = REQUIRED
    """Folder of recorded event files, such as a class of N-ImageNet."""
    limit: int | None = None
    """Use at most this many files of each folder."""
    out: Path | None = None
    """JSON file for the result."""
    overwrite: bool = False
    """Replace a file that exists already."""
    quiet: bool = False
    """No progress; only the result."""

    def __post_init__(self) -> None:
        if self.limit is not None:
            check_range("limit", self.limit, 1)


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    values = parse_options(
        arguments,
        {"options": UnpairedOptions()},
        prog="texvent bench unpaired",
        description="Statistics of simulated streams and of recorded streams of other "
        "scenes: the Fréchet distance of patches, with its floor and null. docs/real-data.md "
        "explains it.",
    )
    options = UnpairedOptions(**values)
    if options.out is not None:
        check_output(options.out, overwrite=options.overwrite)
    console = Console(stderr=True, quiet=options.quiet, highlight=False)
    report = compare_folders(
        options.simulated,
        options.recorded,
        limit=options.limit,
        progress=lambda line: console.print(line, style="dim"),
    )
    if options.out is not None:
        document = {
            "schema": SCHEMA,
            "environment": describe_environment(),
            **asdict(report),
            "normalised": report.normalised,
        }
        write_document(options.out, document, overwrite=options.overwrite)
    sys.stdout.write(
        f"Fréchet distance {report.simulated:.2f} (floor {report.floor:.2f}, null "
        f"{report.null:.2f}; S* {report.normalised:.2f}), {report.simulated_files} simulated and "
        f"{report.recorded_files} recorded files\n"
    )
