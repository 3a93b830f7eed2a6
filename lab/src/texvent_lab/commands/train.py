"""`texvent train TASK SPECIFICATION`: a network trained, or a training continued."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.extending import require
from texvent.runtime.console_progress import ConsoleProgress
from texvent_lab.registries import TASKS
from texvent_lab.train.schedule import Hardware

DESCRIPTION = """Train a network on events, as a TOML or YAML file says. The same command goes on
where a training was stopped or killed. Needs torch: the extra ./lab[train].

  texvent train classification digits.toml -o digits
  texvent evaluate classification real.toml digits/weights.pt"""


@dataclass(frozen=True, kw_only=True)
class TrainOptions:
    """Network to train, and the folder of its files."""

    positional: ClassVar[tuple[str, ...]] = ("task", "specification")
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}
    outputs: ClassVar[tuple[str, ...]] = ("out",)

    task: str = REQUIRED
    """classification, detection or reconstruction."""
    specification: Path = REQUIRED
    """Data, network and schedule: TOML or YAML."""
    out: Path = REQUIRED
    """Folder of the training: checkpoint.pt, weights.pt, history.json, curves.png."""
    quiet: bool = False
    """Show the result only."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns 0."""
    options, hardware = parse_configs(
        arguments,
        {"training": TrainOptions(), "hardware": Hardware()},
        prog="texvent train",
        description=DESCRIPTION,
    )
    kind = TASKS.load(options.task)
    require("torch", extra=kind.packages)
    from texvent_lab.train.loop import score_text
    from texvent_lab.train.run import train_from_file  # brings torch

    folder = options.out.absolute()
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        state = train_from_file(kind, options.specification, folder, hardware, progress)
    keep = state.tables["schedule"]["keep"]
    number = state.epochs if keep == "last" else state.best_epoch
    scores = f"{keep} epoch {number} of {state.epochs}: {score_text(state.rows[number - 1])}"
    write_out(f"{options.out}: {scores}\n")
    return 0
