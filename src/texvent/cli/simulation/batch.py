"""`texvent batch PROMPTS`: events for every prompt of a file, each in files of its own."""

from __future__ import annotations

import dataclasses
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent._registry import GENERATORS
from texvent.cli.command import resolve_command
from texvent.cli.option_types import REQUIRED
from texvent.cli.outputs import OutputOptions
from texvent.cli.run import execute, print_settings
from texvent.cli.simulation.generate import PromptOptions
from texvent.errors import (
    ConfigError,
    InputError,
    MissingDependencyError,
    OutputError,
    TexventError,
)
from texvent.generate.prompts.prompt_files import PromptLine, read_prompts
from texvent.generate.prompts.upsample_config import UpsampleConfig
from texvent.run.prepare import prepare_prompt
from texvent.run.settings import Settings, apply_options
from texvent.runtime.console_progress import ConsoleProgress

DESCRIPTION = """Events for every prompt of a file: .txt (one per line), .csv or .jsonl (prompt, and
perhaps name and seed). Prompts whose event file exists already are skipped, so a batch that was
stopped goes on where it was. A model is loaded once.

  texvent batch prompts.csv --generator wan-1.3b -o events"""


@dataclass(frozen=True, kw_only=True)
class BatchOptions(UpsampleConfig):
    """Which prompts."""

    positional: ClassVar[tuple[str, ...]] = ("prompts",)
    main_options: ClassVar[tuple[str, ...]] = PromptOptions.main_options

    prompts: Path = REQUIRED
    """File of prompts: .txt, .csv or .jsonl."""
    generator: str = next(iter(GENERATORS.builtin))
    """Text-to-video generator, as in texvent generate."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns 0, or 1 if a prompt failed."""
    settings, own, output = resolve_command(
        "generate", arguments, BatchOptions(), description=DESCRIPTION, prog="texvent batch"
    )
    if output.print_config:
        return print_settings(settings)
    folder = output.out or Path(own.prompts.stem)
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder} is a file; -o names the folder for the results of a batch")
    lines = read_prompts(own.prompts)
    targets = _name_results(lines, folder)
    folder.mkdir(parents=True, exist_ok=True)
    failed = 0
    with ConsoleProgress(is_quiet=output.quiet) as progress:
        for line, target in zip(lines, targets, strict=True):
            progress.announce(f"[{line.line}] {line.prompt}")
            if target.exists() and not output.overwrite:
                progress.announce(f"kept     {target}")
                continue
            try:
                one = dataclasses.replace(output, out=target)
                _run_one(line, settings, own, output=one, progress=progress)
            except (ConfigError, OutputError, MissingDependencyError):
                raise
            except TexventError as error:
                # One prompt that a guardrail or filter refuses must not end the others.
                failed += 1
                sys.stderr.write(f"failed   line {line.line}: {' '.join(str(error).split())}\n")
    if failed:
        raise TexventError(f"{failed} of {len(lines)} prompts failed; the others are in {folder}")
    return 0


def _run_one(
    line: PromptLine,
    settings: Settings,
    upsample: UpsampleConfig,
    *,
    output: OutputOptions,
    progress: ConsoleProgress,
) -> None:
    """Events of a line."""
    if line.seed is not None:
        settings = apply_options(settings, {"seed": line.seed}, where=f"line {line.line}")
    output.check(line.prompt)
    simulation = prepare_prompt(line.prompt, settings, upsample=upsample, progress=progress)
    execute(simulation, output, subject=line.prompt)


def _name_results(lines: Sequence[PromptLine], folder: Path) -> list[Path]:
    """An event file per prompt: its own name, or its number and first words.

    Raises:
        InputError: two prompts have one name.
    """
    names: list[Path] = []
    for number, line in enumerate(lines, start=1):
        words = OutputOptions().event_file(line.prompt)
        name = f"{line.name}.h5" if line.name else f"{number:04d}-{words.name}"
        if folder / name in names:
            raise InputError(f"line {line.line}: the name {line.name!r} is there twice")
        names.append(folder / name)
    return names
