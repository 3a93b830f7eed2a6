"""The table that a terminal shows while a data set is made."""

from __future__ import annotations

import time
from pathlib import Path
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.live import Live
from rich.table import Table

from texvent.dataset.generation.engines import Outcome
from texvent.dataset.generation.make import Work
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.generation.shards import FAILED, MADE
from texvent.dataset.generation.status import StageStatus, read_status

REFRESH_S = 1.0
SELDOM = 20
"""The folder is looked at for one part in so many of the time."""


class LiveTable:
    """Samples, events, rates and what is left, for each stage; a line per shard elsewhere."""

    def __init__(self, recipe: Recipe, folder: Path, work: Work, *, is_quiet: bool) -> None:
        self._recipe, self._folder = recipe, folder
        self._console = Console(stderr=True, quiet=is_quiet, highlight=False)
        self._started = time.monotonic()
        self._seen = dict(work.complete)
        self._before: dict[str, int] = {}
        self._stages: list[StageStatus] = []
        self._due = self._started
        self._live: Live | None = None

    def __enter__(self) -> Self:
        if self._console.is_terminal and not self._console.quiet:
            self._look()
            self._before = {stage.name: stage.samples for stage in self._stages}
            self._live = Live(
                console=self._console, get_renderable=self._table, refresh_per_second=1 / REFRESH_S
            )
            self._live.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._live is not None:
            self._live.stop()

    def note(self, outcome: Outcome) -> None:
        """Say what became of a shard."""
        shard, record = outcome.task.shard, outcome.record
        if record is None:
            self._console.print(f"failed   {shard.path}: {outcome.failure}", markup=False)
            return
        self._seen[shard] = record.summary
        for sample in record.samples:
            if sample.status == FAILED:
                self._console.print(
                    f"failed   {shard.path} {sample.key}: {sample.reason}",
                    markup=False,
                    soft_wrap=True,
                )
        if self._live is None:
            self._console.print(
                f"made     {shard.path}: {record.count(MADE)} samples, "
                f"{record.events:,} events, {record.seconds:.1f} s",
                markup=False,
                soft_wrap=True,
            )

    def _table(self) -> Table:
        if time.monotonic() >= self._due:
            self._look()
        seconds = time.monotonic() - self._started
        return status_table(self._stages, seconds=seconds, before=self._before)

    def _look(self) -> None:
        """Read the folder; seldom where that takes long, as with many shards on a shared disk."""
        started = time.monotonic()
        self._stages = read_status(self._recipe, self._folder, self._seen)
        self._due = time.monotonic() + SELDOM * (time.monotonic() - started)


def status_table(
    stages: list[StageStatus], *, seconds: float = 0.0, before: dict[str, int] | None = None
) -> Table:
    """The state of each stage as a table.

    Args:
        stages: the videos, then the variants.
        seconds: how long this run lasts so far.
        before: stage → samples that were there when it began.
    """
    table = Table(box=None, pad_edge=False)
    for name in ("", "samples", "of", "left out", "failed", "events", "samples/s", "events/s",
                 "at work", "left"):  # fmt: skip
        table.add_column(name, justify="left" if not name else "right")
    for stage in stages:
        made = stage.samples - (before or {}).get(stage.name, stage.samples)
        rate = made / seconds if seconds > 0 and made > 0 else 0.0
        left = (stage.total - stage.samples) / rate if rate else None
        table.add_row(
            stage.name,
            f"{stage.samples:,}",
            f"{stage.total:,}",
            f"{stage.filtered:,}",
            f"{stage.failed:,}",
            f"{stage.events:,}",
            f"{rate:.2f}" if rate else "",
            f"{rate * stage.events / stage.samples:,.0f}" if rate and stage.samples else "",
            f"{stage.at_work} shards" if stage.at_work else "",
            time_text(left) if left is not None else "",
        )
    return table


def time_text(seconds: float) -> str:
    """A duration for people, such as "2 h 05 min"."""
    minutes = round(seconds / 60)
    if seconds < 100:
        return f"{seconds:.0f} s"
    if minutes < 60:
        return f"{minutes} min"
    return f"{minutes // 60} h {minutes % 60:02} min"
