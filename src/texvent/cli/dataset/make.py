"""`texvent dataset make SPECIFICATION`: a data set, or what is still missing of it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import say, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.dataset.generation.make import begin, find_work, remove_dead_parts
from texvent.dataset.generation.recipe import Recipe, load_recipe
from texvent.dataset.generation.shard_files import FAILED, MADE
from texvent.dataset.specification.reading import read_specification
from texvent.dataset.statistics import DatasetStatistics, Statistics, summary_lines
from texvent.dataset.stored.folder import StoredDataset
from texvent.errors import ConfigError, TexventError, shown
from texvent.runtime.console_progress import ConsoleProgress
from texvent.runtime.devices import AUTO, check_device_name
from texvent.runtime.progress import Progress
from texvent.runtime.threads import count_threads
from texvent.runtime.work.engines import Engine, Outcome, Work, local_engine

DESCRIPTION = """Make a data set from a specification (TOML or YAML). What is complete is kept: the
same command resumes where it was stopped or killed, on any machine that sees the folder.

  texvent dataset make cars.toml -o cars --workers 8
  texvent dataset make cars --shards 3/10     the third of ten parts, for job arrays
  texvent dataset make cars --ray auto        on the Ray cluster that this machine belongs to
  texvent dataset make cars --retry-failed"""


@dataclass(frozen=True, kw_only=True)
class MakeOptions:
    """Data set to make, and the machines that make it."""

    positional: ClassVar[tuple[str, ...]] = ("specification",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}
    outputs: ClassVar[tuple[str, ...]] = ("out", "specification")

    specification: Path = REQUIRED
    """The specification, or the folder of a data set that was begun."""
    out: Path | None = None
    """Folder of the data set; default: its name."""
    workers: int | None = None
    """Processes of this machine; default: one per core."""
    ray: str | None = None
    """Ray cluster that makes the shards: its address, such as head:6379; "auto", the one this
    machine belongs to; "local", one of --workers processes for this run."""
    shards: str | None = None
    """K/N: of N parts of all shards, the K-th only, from 1."""
    device: str = AUTO
    """Device that simulates: auto, cpu, cuda or cuda:N, for this run; on a GPU several clips of a
    shard as one batch. auto: the specification's."""
    retry_failed: bool = False
    """Make samples that failed again."""
    allow_failed: bool = False
    """End with exit code 0 although samples failed, such as prompts of which nothing is
    understood."""
    quiet: bool = False
    """Show errors only."""

    def __post_init__(self) -> None:
        check_device_name(self.device)
        check_range("workers", self.workers, 1, 1024)
        if self.workers is not None and self.ray not in (None, "local"):
            raise ConfigError(
                "workers is for this machine; --ray uses all CPUs that the cluster offers"
            )


def run_make(arguments: Sequence[str]) -> int:
    """Run the command; returns 0, or raises if a shard could not be made."""
    (options,) = parse_configs(
        arguments,
        {"data set": MakeOptions()},
        prog="texvent dataset make",
        description=DESCRIPTION,
    )
    part = parse_part(options.shards)
    recipe, folder = _open(options)
    begin(recipe, folder)
    work = find_work(
        recipe, folder, part=part, retry_failed=options.retry_failed, device=options.device
    )
    try:
        with (
            closing(_engine(options, work)) as engine,
            ConsoleProgress(is_quiet=options.quiet) as progress,
        ):
            for outcome in work.make(engine, progress):
                _announce(outcome, progress)
    except KeyboardInterrupt:
        say(f"kept     every finished shard; to go on: texvent dataset make {folder}")
        raise
    finally:
        remove_dead_parts(recipe, folder)
    return _finish(folder, work, options, is_whole=part[1] == 1)


def _announce(outcome: Outcome, progress: Progress) -> None:
    """Print the results of shards."""
    for shard in outcome.task.units if outcome.failure is not None else ():
        progress.announce(f"failed   {shard.path}: {outcome.failure}")
    for shard, record in zip(outcome.task.units, outcome.result or (), strict=False):
        for sample in record.samples:
            if sample.status == FAILED:
                progress.announce(f"failed   {shard.path} {sample.key}: {sample.reason}")
        progress.announce(
            f"made     {shard.path}: {record.count(MADE)} samples, {record.events:,} events, "
            f"{record.seconds:.1f} s"
        )


def parse_part(text: str | None) -> tuple[int, int]:
    """K and N of "K/N".

    Raises:
        ConfigError: it is something else.
    """
    match = re.fullmatch(r"(\d{1,9})/(\d{1,9})", text or "1/1")
    if match is None:
        raise ConfigError(f"shards is {shown(text)}; it must be K/N, such as 3/10")
    which, parts = int(match[1]), int(match[2])
    if not 1 <= which <= parts:
        raise ConfigError(f"shards is {which}/{parts}; it must be K/N with 1 ≤ K ≤ N")
    return which, parts


def _open(options: MakeOptions) -> tuple[Recipe, Path]:
    if options.specification.is_dir():
        if options.out is not None:
            raise ConfigError("-o goes with a specification; a data set goes on in its own folder")
        recipe = load_recipe(options.specification)
        recipe.check_runs(options.device)
        return recipe, options.specification.absolute()
    specification = read_specification(options.specification)
    folder = Path(specification.name) if options.out is None else options.out
    return Recipe.of(specification, options.device), folder.absolute()


def _engine(options: MakeOptions, work: Work) -> Engine:
    shards = work.to_make
    if options.ray is not None and shards:
        from texvent.dataset.generation.ray_cluster import RayEngine

        return RayEngine(options.ray, workers=options.workers)
    workers = count_threads() if options.workers is None else options.workers
    return local_engine(workers if shards > 1 else 1)


def _finish(folder: Path, work: Work, options: MakeOptions, *, is_whole: bool) -> int:
    failed = sum(counts[FAILED] for counts in work.complete.values())
    places = {str(shard.path) for shard in work.complete}
    dataset = StoredDataset.open(folder)
    shards = (one.record for one in dataset.shards() if one.place in places)
    made = Statistics.of(shards)
    write_out(
        f"{folder}: {made.samples:,} samples, {sum(made.events):,} events in "
        f"{made.shards:,} shards\n"
    )
    classes = dataset.box_classes if is_whole else ()
    lines = summary_lines(made, classes)
    if is_whole and dataset.is_shared_out and dataset.box_classes:
        lines += DatasetStatistics.of(dataset).lacking_boxes(dataset.box_classes)
    write_out("".join(f"{line}\n" for line in lines))
    if work.failures:
        shard, reason = next(iter(work.failures.items()))
        raise TexventError(
            f"{len(work.failures)} shards could not be made, such as {shard.path}: {reason}; the "
            "others are kept: run the command again"
        )
    if failed and not options.allow_failed:
        noun = "sample" if failed == 1 else "samples"
        raise TexventError(
            f"{failed:,} {noun} failed: texvent dataset stats {folder} says why; the others are "
            "kept. --retry-failed makes them again, --allow-failed accepts the set as it is"
        )
    if is_whole:
        write_out(f"next: texvent dataset sample {folder}, then verify, stats, export\n")
    return 0
