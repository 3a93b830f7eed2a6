"""`texvent bench unpaired`: simulated streams against recorded ones of other scenes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent_lab.bench.machine import describe_environment
from texvent_lab.bench.unpaired import compare_folders
from texvent_lab.commands.bench.result_options import ResultOptions

SCHEMA = "texvent-unpaired-1"


@dataclass(frozen=True, kw_only=True)
class UnpairedOptions:
    """Which folders."""

    positional: ClassVar[tuple[str, ...]] = ("simulated", "recorded")

    simulated: Path = REQUIRED
    """Folder of event files to judge, such as those that texvent batch made of captions."""
    recorded: Path = REQUIRED
    """Folder of recorded event files, such as a class of N-ImageNet."""
    limit: int | None = None
    """Use at most this many files of each folder."""

    def __post_init__(self) -> None:
        check_range("limit", self.limit, 1)


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": UnpairedOptions(), "output": ResultOptions()},
        prog="texvent bench unpaired",
        description="Statistics of simulated streams and of recorded streams of other "
        "scenes: the Fréchet distance of patches, with its floor and null. docs/real-data.md "
        "explains it.",
    )
    output.check()
    report = compare_folders(
        options.simulated,
        options.recorded,
        limit=options.limit,
        progress=output.progress,
    )
    output.write(
        lambda: {
            "schema": SCHEMA,
            "environment": describe_environment(),
            **asdict(report),
            "normalised": report.normalised,
        }
    )
    write_out(
        f"Fréchet distance {report.simulated:.2f} (floor {report.floor:.2f}, null "
        f"{report.null:.2f}; S* {report.normalised:.2f}), {report.simulated_files} simulated and "
        f"{report.recorded_files} recorded files\n"
    )
