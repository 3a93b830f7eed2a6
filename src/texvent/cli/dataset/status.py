"""`texvent dataset status DIR`: how far a data set is."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.dataset.live_table import status_table
from texvent.cli.notices import result_console, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.dataset.generation.recipe import read_recipe
from texvent.dataset.generation.status import read_status

DESCRIPTION = """How far a data set is, while it is made (here or elsewhere) or afterwards.

Exit code: 0 complete, 1 something is missing or failed."""


@dataclass(frozen=True, kw_only=True)
class StatusOptions:
    """Which data set."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)

    folder: Path = REQUIRED
    """Folder of the data set."""
    json: bool = False
    """Print JSON instead of a table."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments,
        {"data set": StatusOptions()},
        prog="texvent dataset status",
        description=DESCRIPTION,
    )
    recipe = read_recipe(options.folder)
    stages = read_status(recipe, options.folder)
    if options.json:
        facts = [dataclasses.asdict(stage) for stage in stages]
        write_out(json.dumps(facts, indent=1) + "\n")
    else:
        with result_console() as console:
            console.print(status_table(stages))
    is_whole = all(stage.complete == stage.shards and not stage.failed for stage in stages)
    return 0 if is_whole else 1
