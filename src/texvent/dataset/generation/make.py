"""A data set made: every incomplete shard, in two stages where videos are stored."""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass, replace
from operator import attrgetter
from pathlib import Path
from typing import Any

from texvent.dataset.generation.make_shard import find_replaced, is_complete, make_together
from texvent.dataset.generation.recipe import (
    SPECIFICATION_FILE,
    VIDEOS,
    Recipe,
    Shard,
    load_recipe_once,
)
from texvent.dataset.generation.shard_files import FAILED, ShardRecord
from texvent.dataset.specification.prompts import refuse_prompts
from texvent.dataset.specification.reading import read_specification
from texvent.dataset.specification.specification import Specification
from texvent.errors import ConfigError, InputError, OutputError, TexventError, few, shown, warn
from texvent.runtime.devices import AUTO
from texvent.runtime.files.hidden_parts import sweep
from texvent.runtime.progress_option import ProgressOption, open_progress
from texvent.runtime.work.engines import Work, local_engine

MOST_NAMED = 5
"""Classes that the error names."""


@dataclass(frozen=True)
class ShardTask:
    """A shard to make, or those of one place in several variants, for an engine."""

    folder: Path
    units: tuple[Shard, ...]
    retry_failed: bool = False
    device: str = AUTO

    @property
    def is_video(self) -> bool:
        """True for a shard of videos."""
        return self.units[0].variant == VIDEOS

    @property
    def after(self) -> Shard | None:
        """The shard of its videos, which are made first where they are stored."""
        return None if self.is_video else replace(self.units[0], variant=VIDEOS)

    def run(self) -> list[ShardRecord]:
        """Make the shards in this process.

        Raises:
            ConfigError, OutputError, MissingDependencyError: what all shards would meet.
        """
        if not self.folder.is_dir():
            raise OutputError(
                f"{self.folder} is not here; all workers need the folder of the data set under the "
                "same path, on a shared file system"
            )
        try:
            recipe = load_recipe_once(self.folder)
        except TexventError as error:
            raise ConfigError(str(error)) from error
        return make_together(
            recipe, self.folder, self.units, retry_failed=self.retry_failed, device=self.device
        )


def find_work(
    recipe: Recipe,
    folder: Path,
    *,
    part: tuple[int, int] = (1, 1),
    retry_failed: bool = False,
    device: str = AUTO,
) -> Work:
    """Complete shards, with their counts of samples by status, and tasks that make the others.

    Shards that show the same rendered clips are made together, those of videos first.

    Args:
        recipe: of the data set.
        folder: of the data set.
        part: (K, N): of N parts of all shards, the K-th, 1 ≤ K ≤ N.
        retry_failed: whether shards with failed samples are made again.
        device: of the pixel model and networks; "auto": that of the specification.

    Raises:
        ConfigError: there is no such part.
        FileFormatError: the record of a shard is damaged.
    """
    which, parts = part
    work = Work(summary=attrgetter("statuses"))
    together: dict[Any, list[Shard]] = {}
    for stage in recipe.stages:
        for number, shard in enumerate(recipe.shards(stage)):
            if number % parts != which - 1:
                continue
            record = is_complete(recipe, folder, shard)
            replaced = None if record is None else find_replaced(recipe, shard, record)
            if replaced is not None:
                warn(f"{replaced} was replaced since; {shard.path}, made of it, is made again")
                record = None
            again = retry_failed and record is not None and record.count(FAILED) > 0
            if record is None or again:
                place = number if recipe.renders else (stage, number)
                together.setdefault((place, again), []).append(shard)
            else:
                work.complete[shard] = record.statuses
    for (_, again), shards in together.items():
        work.todo.append(ShardTask(folder, tuple(shards), retry_failed=again, device=device))
    return work


def begin(recipe: Recipe, folder: Path) -> None:
    """Note in a folder what will be made there, after a look at the prompts of a new data set.

    Raises:
        InputError: prompts that `strict` refuses, classes that prompts do not show, or scenes that
            name files that are not there.
        ConfigError: a field of a scene is wrong, or the folder holds another data set.
        OutputError: the folder is a file or cannot be written.
    """
    if not (folder / SPECIFICATION_FILE).exists():
        if not recipe.items.are_videos:
            subjects = [
                (shown(item.prompt) if item.prompt else "a scene", item.subject)
                for item in recipe.items.all
            ]
            refuse_prompts(subjects, recipe.prompt_settings)
            _refuse_untrue(recipe)
        for split, classes in recipe.clips.lacking().items():
            warn(f"{split} has no {few(classes)}; give more of each class, or other splits")
    recipe.begin(folder)


def _refuse_untrue(recipe: Recipe) -> None:
    untrue = recipe.untrue_classes()
    if untrue:
        faults = [f"{shown(label)}: {few(words)}" for label, words in untrue.items()]
        raise InputError(
            f"{len(untrue)} of {len(recipe.items.labels)} classes would not be shown, for words "
            f"that are not understood ({'; '.join(faults[:MOST_NAMED])}); say them in words of "
            f"`texvent scenes`, or allow them: allow_classes = {[*untrue][:MOST_NAMED]}"
        )


def remove_dead_parts(recipe: Recipe, folder: Path) -> None:
    """Remove what processes that were killed left behind; shards at work elsewhere are kept."""
    for stage in (VIDEOS, *recipe.variants):
        sweep(folder / stage)


def make(
    specification: Specification | str | Path,
    folder: str | Path,
    *,
    workers: int = 1,
    retry_failed: bool = False,
    device: str = AUTO,
    progress: ProgressOption = None,
) -> Work:
    """Make a data set, or what is missing of it; see docs/datasets.md.

    Args:
        specification: an object, or a TOML or YAML file.
        folder: of the data set.
        workers: processes; 1: this one. A program that uses more needs the usual
            `if __name__ == "__main__":`, because they import its main module.
        retry_failed: make samples that failed again.
        device: of the pixel model and networks, as the option of `texvent.simulate`; "auto": that
            of the specification.
        progress: receives every shard.

    Returns:
        The counts of all complete shards, and why others could not be made.

    Raises:
        InputError, ConfigError, OutputError: before any work, what all samples would meet.

    Example:
        >>> import texvent
        >>> sources = (texvent.dataset.SampleSource(prompts=("a red ball bounces",)),)
        >>> options = {"sensor": "64x48", "duration": 0.2}
        >>> balls = texvent.dataset.Specification(name="balls", sources=sources, options=options)
        >>> work = texvent.dataset.make(balls, "balls", progress=False)
        >>> list(work.complete.values()), work.failures
        ([Counter({'made': 1})], {})
    """
    if not isinstance(specification, Specification):
        specification = read_specification(specification)
    recipe, folder = Recipe.of(specification, device), Path(folder).absolute()
    begin(recipe, folder)
    work = find_work(recipe, folder, retry_failed=retry_failed, device=device)
    with open_progress(progress) as display, closing(local_engine(workers)) as engine:
        for _ in work.make(engine, display):
            pass
    return work
