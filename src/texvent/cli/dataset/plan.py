"""`texvent dataset plan SPECIFICATION`: what a data set will be and take, before it is made."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from rich.table import Table

from texvent.cli.notices import result_console, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.cli.run import size_text
from texvent.config import check_range
from texvent.dataset.generation.dry_run import StageEstimate, try_samples
from texvent.dataset.generation.recipe import VIDEOS, Recipe
from texvent.dataset.generation.shard_files import FILTERED
from texvent.dataset.specification.prompts import tally_prompts
from texvent.dataset.specification.reading import read_specification
from texvent.dataset.statistics import Statistics, class_lines, summary_lines
from texvent.errors import few, shown
from texvent.runtime.console_progress import ConsoleProgress
from texvent.runtime.threads import count_threads

DEFAULT_TRIAL = 8
MOST_READ = 2_000
"""Prompts that are read, drawn by chance from more; 2,000 take a few seconds."""
DESCRIPTION = """Check a specification and say what it gives: prompts, clips, splits, classes, and
from a trial of a few samples the size and the time. Nothing is kept.

  texvent dataset plan cars.toml --workers 8"""


@dataclass(frozen=True, kw_only=True)
class PlanOptions:
    """Specification, and the machines that it would run on."""

    positional: ClassVar[tuple[str, ...]] = ("specification",)
    outputs: ClassVar[tuple[str, ...]] = ()

    specification: Path = REQUIRED
    """The specification: TOML or YAML."""
    trial: int | None = None
    """Clips that are made to measure time and size; 0: none. Default: 8, and none where a learned
    model would have to make their videos."""
    workers: int | None = None
    """Processes that will share this machine's cores; default: one per core."""

    def __post_init__(self) -> None:
        check_range("trial", self.trial, 0, 1000)
        check_range("workers", self.workers, 1, 1024)


def run_plan(arguments: Sequence[str]) -> int:
    """Run the command; returns 0."""
    (options,) = parse_configs(
        arguments, {"plan": PlanOptions()}, prog="texvent dataset plan", description=DESCRIPTION
    )
    recipe = Recipe.of(read_specification(options.specification))
    write_out("\n".join(describe_contents(recipe)) + "\n")
    if not recipe.items.are_videos:
        write_out(_prompts(recipe))
    trial = options.trial
    if trial is None:
        trial = 0 if recipe.stores_videos else DEFAULT_TRIAL
    workers = options.workers or count_threads()
    if trial:
        with ConsoleProgress() as progress:
            stages = try_samples(recipe, trial, progress, workers=workers)
        _print_trial(stages, workers, dict.fromkeys(recipe.specification.class_of.values()))
    else:
        write_out(
            "no trial: give --trial 1 to measure size and time of a sample, and what is left out\n"
        )
    return 0


def _prompts(recipe: Recipe) -> str:
    """Counts of understood prompts, of at most `MOST_READ`; nothing for learned generators."""
    items, drawn = recipe.items.all, ""
    if len(items) > MOST_READ:
        chance = random.Random(recipe.specification.seed)
        items, drawn = tuple(chance.sample(items, MOST_READ)), f", drawn from {len(items):,}"
    tally = tally_prompts([item.subject for item in items], recipe.prompt_settings)
    if tally is None:
        return ""
    untrue = [
        f"warning  make refuses class {shown(label)}: not understood: {few(words)}\n"
        for label, words in recipe.untrue_classes().items()
    ]
    return f"prompts  {tally.line(verb='understood word for word')}{drawn}\n{''.join(untrue)}"


def describe_contents(recipe: Recipe) -> list[str]:
    """Contents of a specification, one line each."""
    specification, items = recipe.specification, recipe.items
    kind = "videos" if items.are_videos else "prompts"
    kind = "scenes" if all(item.scene is not None for item in items.all) else kind
    counts = recipe.clips.counts
    clips = sum(counts.values())
    samples = sum(clips * variant.seeds for variant in specification.variants)
    shards = sum(1 for name in recipe.variants for _ in recipe.shards(name))
    left_out = f" ({items.duplicates:,} equal ones left out)" if items.duplicates else ""
    splits = ", ".join(f"{split} {count:,}" for split, count in counts.items())
    names = [
        f"{one.name} ({one.seeds} seeds)" if one.seeds > 1 else one.name
        for one in specification.variants
    ]
    lines = [
        f"{specification.name}: {len(items.all):,} {kind}{left_out}, {clips:,} clips, "
        f"{samples:,} samples in {shards:,} shards",
        f"splits   {splits}",
        f"variants {', '.join(names)}",
    ]
    if items.labels:
        sizes = Counter(item.label for item in items.all).values()
        each = f"{min(sizes):,}" if min(sizes) == max(sizes) else f"{min(sizes):,}-{max(sizes):,}"
        lines.append(f"classes  {len(items.labels):,}, {each} {kind} each; clips of each:")
        lines += class_lines(recipe.clips.class_counts)
        for split, classes in recipe.clips.lacking().items():
            lines.append(f"warning  {split} has no {few(classes)}")
    if recipe.stores_videos:
        lines.append(
            f"videos   {clips:,}, made and stored first; every variant is simulated from them"
        )
    if not specification.license:
        lines.append("note     no license is named; a set that is published needs one")
    return lines


def _print_trial(stages: Sequence[StageEstimate], workers: int, classes: Iterable[str]) -> None:
    table = Table(box=None, pad_edge=False)
    noun = "worker" if workers == 1 else "workers"
    for name in ("", "samples", "left out", "events each", "size", "s each",
                 f"time, {workers} {noun}"):  # fmt: skip
        table.add_column(name, justify="left" if not name else "right")
    for stage in stages:
        processes = 1 if stage.name == VIDEOS else workers
        table.add_row(
            stage.name,
            f"{stage.samples:,}",
            f"{100 * stage.share(FILTERED):.0f} %",
            f"{stage.events:,.0f}",
            size_text(stage.bytes * stage.samples),
            f"{stage.seconds:.2f}",
            time_text(stage.seconds * stage.samples / processes),
        )
    with result_console() as console:
        console.print(table)
    total = sum(stage.bytes * stage.samples for stage in stages)
    write_out(f"in all   {size_text(total)}, from a trial with {stages[0].tried} of each:\n")
    of_events = (stage for stage in stages if stage.name != VIDEOS)
    tried = Statistics.of(record for stage in of_events for record in stage.records)
    write_out("".join(f"{line}\n" for line in summary_lines(tried, classes)))


def time_text(seconds: float) -> str:
    """A duration for people, such as "2 h 05 min"."""
    minutes = round(seconds / 60)
    if seconds < 100:
        return f"{seconds:.0f} s"
    if minutes < 60:
        return f"{minutes} min"
    return f"{minutes // 60} h {minutes % 60:02} min"
