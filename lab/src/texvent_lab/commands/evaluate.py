"""`texvent evaluate TASK SPECIFICATION WEIGHTS`: scores of trained weights."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.extending import require
from texvent.io.atomic import check_output
from texvent_lab.registries import TASKS
from texvent_lab.train.schedule import Hardware

DESCRIPTION = """Score trained weights on the `validation_split` of a training file: the one it
was trained with, or another, such as a test's. Needs torch: the extra ./lab[train].

  texvent evaluate classification real.toml digits/weights.pt"""


@dataclass(frozen=True, kw_only=True)
class EvaluateOptions:
    """Network to score, and its samples."""

    positional: ClassVar[tuple[str, ...]] = ("task", "specification", "weights")
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o"}
    outputs: ClassVar[tuple[str, ...]] = ("out",)

    task: str = REQUIRED
    """classification, detection or reconstruction."""
    specification: Path = REQUIRED
    """As for training; the samples of its `validation_split` are scored."""
    weights: Path = REQUIRED
    """weights.pt of a training, or published weights of the same layout."""
    out: Path | None = None
    """Write the scores too, and what they belong to (.json)."""
    overwrite: bool = False
    """Replace that file if it exists already."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns 0."""
    options, hardware = parse_configs(
        arguments,
        {"evaluation": EvaluateOptions(), "hardware": Hardware()},
        prog="texvent evaluate",
        description=DESCRIPTION,
    )
    kind = TASKS.load(options.task)
    require("torch", extra=kind.packages)
    if options.out is not None:
        check_output(options.out, overwrite=options.overwrite)
    from texvent_lab.train.run import evaluate_from_file  # brings torch

    evaluation = evaluate_from_file(kind, options.specification, options.weights, hardware)
    width = max(map(len, evaluation.scores))
    for name, value in evaluation.scores.items():
        write_out(f"{name:{width}}  {value:.4g}\n")
    if options.out is not None:
        evaluation.write(options.out, overwrite=options.overwrite)
    return 0
