"""`texvent.dataset.make`: what the command does, from Python."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

from texvent.dataset.generation.engines.processes import ProcessEngine
from texvent.dataset.generation.engines.protocol import Engine, in_this_process
from texvent.dataset.generation.make import Work, find_work, make_shards
from texvent.dataset.generation.prompt_check import refuse_prompts
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.specification.reading import read_specification
from texvent.dataset.specification.specification import Specification
from texvent.runtime.progress import ProgressOption, open_progress


def make(
    specification: Specification | str | Path,
    folder: str | Path,
    *,
    workers: int = 1,
    retry_failed: bool = False,
    progress: ProgressOption = None,
) -> Work:
    """Make a data set, or what is missing of it; see docs/datasets.md.

    Args:
        specification: an object, or a TOML or YAML file.
        folder: of the data set.
        workers: processes; 1: this one. A program that uses more needs the usual
            `if __name__ == "__main__":`, because they import its main module.
        retry_failed: make samples that failed again.
        progress: told of every shard.

    Returns:
        The counts of all complete shards, and why others could not be made.

    Raises:
        InputError, ConfigError, OutputError: before any work, what all samples would meet.
    """
    if not isinstance(specification, Specification):
        specification = read_specification(specification)
    recipe, folder = Recipe.of(specification), Path(folder).absolute()
    refuse_prompts(recipe, folder)
    recipe.begin(folder)
    work = find_work(recipe, folder, retry_failed=retry_failed)
    total = len(work.complete) + len(work.todo) + len(work.videos_todo)
    engine: Engine = in_this_process() if workers == 1 else ProcessEngine(workers)
    with open_progress(progress) as shown, closing(engine):
        make_shards(
            work, engine, lambda outcome: shown.advance("shards", len(work.complete), total)
        )
    return work
